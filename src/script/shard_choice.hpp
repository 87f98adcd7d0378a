#pragma once
#include <string>

#include "script/session.hpp"

namespace ricochet {

/// Which shard `--shard K/N`, `auto` or `auto/N` means, into `options`. `auto` asks what arrays of Slurm, PBS
/// and Grid Engine, and Open MPI, other MPIs and srun within them tell a process of itself. Throws Error.
void choose_shard(RunOptions& options, const std::string& given);

}  // namespace ricochet
