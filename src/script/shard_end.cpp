#include "script/shard_end.hpp"

#include <fmt/format.h>

#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

void leave_shard_error(const Session& session, const Error& error) {
  if (session.options.part != Part::shard || session.sharded.empty() || stop_requested) return;
  try {
    make_folder(run_names::shards(session.sharded));
    write_atomically(run_names::shard_error(session.sharded, session.options.shard),
                     fmt::format("{} (on {})", error.what(), host_name()));
  } catch (const FileError&) {
  }
}

void tell_nothing_left(Session& session) {
  if (session.sharded.empty())
    session.inform("nothing is left for a shard: the script has no sweep that was not merged\n");
}

}  // namespace ricochet
