#pragma once
#include "core/error.hpp"
#include "script/session.hpp"

namespace ricochet {

/// Leaves what a shard ended by beside the rows of all, for whoever merges them; nothing of one that was interrupted,
/// or of another process. What cannot be written is lost in silence: the error itself is the one to report.
void leave_shard_error(const Session& session, const Error& error);

/// A script's shard whose sweeps were all merged, or are none, has nothing to do, and says so.
void tell_nothing_left(Session& session);

}  // namespace ricochet
