#pragma once
#include <string>

#include "script/session.hpp"

namespace ricochet {

/// Which shard `--shard K/N`, `auto` or `auto/N` means, into `options`. `auto` asks what Open MPI, other MPIs, Slurm's
/// arrays and srun, PBS and Grid Engine tell a process of itself, in this order. Throws Error.
void choose_shard(RunOptions& options, const std::string& given);

}  // namespace ricochet
