#include "script/shard_work.hpp"

#include <fmt/format.h>

#include "core/hash.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/row_index.hpp"
#include "script/shard_store.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

void end_script(Session& session) {
  session.done = true;
  throw Error("the script was only asked for a part of its sweep");
}

void refuse_other_number(const Session& session, const ShardPlan& plan) {
  const std::size_t asked = session.options.shards;
  if (asked == 0 || asked == plan.shards) return;
  throw FileError(fmt::format("{} is of {} shards, not of {}; give --shard K/{}, or another --out",
                              run_names::plan(session.sharded).string(), plan.shards, asked, plan.shards));
}

std::size_t strangers_in(const fs::path& folder, const std::vector<HashKey>& scenes) {
  RowIndex stored;
  for (const fs::path& file : run_names::stored(folder)) stored.add(file);
  return stored.strangers(scenes);
}

void refuse_strangers(const fs::path& folder, const std::vector<HashKey>& scenes) {
  const std::size_t strangers = strangers_in(folder, scenes);
  if (strangers > 0)
    throw FileError(fmt::format(
        "{} holds {} rows of other scenes than this sweep's, beside which its shards could not be merged; give "
        "another --out, or the script and the parameters of those",
        folder.string(), strangers));
}

std::string canary_of_first(lua_State* L, int index, const Scene& chosen) {
  try {
    return canary_of(chosen);
  } catch (const FieldError& error) {
    throw_at(session_of(L), scene_at(L, index).site, explained(error, chosen));
  }
}

Provenance facts_of_sweep(lua_State* L, const std::string& over, const Scene& first) {
  Provenance facts = facts_of(session_of(L));
  facts["over"] = hash_text(over);
  facts["first_scene"] = first.hash();
  return facts;
}

std::string shard_name(const Session& session, const std::string& sweep) {
  return fmt::format("{}, shard {}/{}", sweep, session.options.shard, session.options.shards);
}

void tell_shard_end(Session& session, const std::string& name, std::size_t finished, std::size_t all) {
  session.inform(fmt::format("shard {}/{} of '{}' is done: {} of {} impacts finished; {}\n", session.options.shard,
                             session.options.shards, name, finished, all,
                             run_names::shard(session.sharded, session.options.shard).string()));
}

void run_shard_scenes(Session& session, const std::string& name, const std::vector<Scene>& scenes,
                      const Parameters& parameters) {
  const SceneName scene_name = [&](std::size_t scene) { return parameters.place(scene); };
  const std::vector<std::string> hashes = hashes_of(scenes);
  check_steps(session, scenes);
  ShardStore store(session, session.options.shard, hashes, parameters);
  const std::string called = shard_name(session, name);
  SweepUse use;
  const Storing storing;
  try {
    if (!run_rows(session, store, {called, scenes, hashes, scene_name}, use)) {
      store.flush();
      throw Error("interrupted: " + shard_left_behind(session, store.count(), scenes.size()), Exit::interrupted);
    }
  } catch (const SceneError&) {
    store.flush();
    throw;
  }
  store.finish();
  std::size_t finished = 0;
  for (const Row& row : store.rows()) finished += row.finished();
  tell_shard_end(session, name, finished, store.rows().size());
}

}  // namespace ricochet
