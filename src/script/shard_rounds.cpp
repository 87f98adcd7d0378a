// A sweep in shards that takes as many samples of every point as an error needs, round after round, from
// lua/ricochet/rounds.lua.

#include <fmt/format.h>

#include "core/hash.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "script/shard_merge.hpp"
#include "script/shard_store.hpp"
#include "script/shard_work.hpp"
#include "script/stored_rows.hpp"
#include "script/sweep_read.hpp"
#include "script/sweep_store.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

/// All scenes so far, with their steps.
struct Round {
  std::string name, text;  ///< of the sweep; what decides which scenes it has
  Parameters parameters;
  std::vector<Scene> scenes = {};
  std::vector<std::string> hashes = {};
  std::vector<std::size_t> places = {};  ///< of the scenes in the plan: lattices by their number, and their points
  std::size_t lattices = 0, points = 0;  ///< at most, of a point; of the sweep

  SceneName scene_name() const {
    return [this](std::size_t scene) { return parameters.place(scene); };
  }
};

// Throws an error of a scene of a round at the place that made it.
[[noreturn]] void throw_at_round(lua_State* L, const Round& round, const SceneError& error) {
  throw_at_scene(L, 4, error, fmt::format(" (at {})", round.parameters.place(error.scene)));
}

Round round_at(lua_State* L) {
  Session& session = session_of(L);
  Round round{luaL_checkstring(L, 1), luaL_checkstring(L, 6), read_parameters(L, 2, 3, 5)};
  round.lattices = static_cast<std::size_t>(luaL_checkinteger(L, 7));
  round.points = static_cast<std::size_t>(luaL_checkinteger(L, 8));
  try {
    round.scenes = with_steps_of_rounds(session, round.name, scenes_at(L, 4), printed(session, round.scene_name()));
  } catch (const SceneError& error) {
    throw_at_round(L, round, error);
  }
  round.hashes = hashes_of(round.scenes);
  const std::vector<std::string>& names = round.parameters.names;
  const auto pair = std::find(names.begin(), names.end(), "pair") - names.begin();
  for (const double number : round.parameters.numbers[static_cast<std::size_t>(pair)])
    round.places.push_back(static_cast<std::size_t>(number) - 1);
  return round;
}

// How many of a round's rows are there: merged ones, and where they are to be merged, those of shards.
std::size_t known_of(const Session& session, const Round& round, const fs::path& folder) {
  KnownRows known(round.hashes);
  const bool merges = session.options.part == Part::merge;
  load_while_they_change(known, [&] { return merges ? run_names::all_stored(folder) : run_names::merged(folder); });
  return known.count();
}

// Of a round whose shards are not all there, says so; of one that none has run yet, makes results of those before.
void merge_round(Session& session, const Round& round) {
  if (session.options.partial)
    throw Error(
        "merge --partial: samples = \"by_error\" decides by all rows how many samples to run; run the shards that are "
        "missing",
        Exit::usage);
  const fs::path folder = session.folders.named(round.name);
  std::error_code error;
  const bool has_plan = fs::exists(run_names::plan(folder), error);
  if (has_plan) refuse_other(read_plan(folder), facts_of(session), folder);
  Store store(session, round.name, round.hashes, round.parameters,
              {true, fs::exists(run_names::earlier(folder), error)});
  if (store.count() == 0 || (has_plan && read_plan(folder).facts.at("over") == hash_text(round.text)))
    refuse_missing(session, round.name, store.done(), round.places);
  store.assemble();
  run_names::remove_shards(folder);
}

// Keeps all rows of a larger error: not every round asks for all of them.
void keep_earlier(const fs::path& folder) {
  const fs::path own = folder / own_name("earlier", ".h5");
  write_table(own, stored_rows(folder), read_provenance(run_names::readable_results(folder)));
  rename_over(own, run_names::earlier(folder));
}

// Plans a round, unless another process does so first.
void plan_round(lua_State* L, const Round& round, std::size_t known, const Provenance& facts) {
  Session& session = session_of(L);
  ShardPlan plan{.over = {{"sample", round.lattices, true}, {"point", round.points, false}}};
  plan.shards = session.options.shards;
  if (plan.shards == 0) plan.shards = std::max<std::size_t>(1, (round.scenes.size() - known) / usual_impacts);
  std::vector<HashKey> scenes;
  for (const std::string& hash : round.hashes) scenes.push_back(HashKey::of(hash));
  if (known == 0)
    refuse_strangers(session.sharded, scenes);
  else if (strangers_in(session.sharded, scenes) > 0)
    keep_earlier(session.sharded);
  plan.facts = facts;
  plan.facts["impacts"] = fmt::format("{}", round.scenes.size());
  if (write_plan(session.sharded, plan, session.provenance())) session.steps.write(session.steps_file());
}

// Runs what of a round is this process's shard.
void run_round(lua_State* L, const Round& round, const ShardPlan& plan) {
  Session& session = session_of(L);
  std::vector<std::size_t> own;
  std::vector<Scene> scenes;
  for (std::size_t i = 0; i < round.scenes.size(); ++i) {
    if (plan.shard_of(round.places[i]) != session.options.shard) continue;
    own.push_back(i);
    scenes.push_back(round.scenes[i]);
  }
  try {
    run_shard_scenes(session, round.name, scenes, round.parameters.of(own));
  } catch (const SceneError& error) {
    throw_at_round(L, round, SceneError(error, own[error.scene]));
  }
}

// round_is_there(name, names, points, scenes, units, text, lattices, count): true if all rows of a round are there;
// false where it was merged and no shard has run it yet. Else plans the round or runs this process's shard of it, and
// ends the script. `text`: what decides which scenes it has; `lattices`, `count`: at most, of a point; of points.
int round_is_there(lua_State* L) {
  Session& session = session_of(L);
  const Round round = round_at(L);
  const fs::path folder = session.folders.named(round.name);
  const std::size_t known = known_of(session, round, folder);
  lua_pushboolean(L, known == round.hashes.size());
  if (known == round.hashes.size()) return 1;
  if (session.options.part == Part::merge) {
    merge_round(session, round);
    return 1;
  }
  session.sharded = folder;
  lua_rawgeti(L, 4, 1);
  Provenance facts = facts_of_sweep(L, round.text, round.scenes.front());
  facts["canary"] = canary_of_first(L, -1, round.scenes.front());
  std::error_code error;
  if (!fs::exists(run_names::plan(folder), error)) plan_round(L, round, known, facts);
  const ShardPlan plan = read_plan(folder);
  refuse_other_number(session, plan);
  refuse_other(plan, facts, folder);
  if (session.options.part == Part::shard) run_round(L, round, plan);
  end_script(session);
}

// end_round(name, round): ends the merging of a round after which another one is needed.
int end_round(lua_State* L) {
  const Session& session = session_of(L);
  throw Error(fmt::format("round {} of '{}' is to be run: its wanted error is not reached; ricochet submit does so, or "
                          "run its shards: {}",
                          luaL_checkinteger(L, 2), luaL_checkstring(L, 1), command_of(session, "run", "--shard K/N")),
              Exit::numerical);
}

}  // namespace

Group shard_round_functions() {
  return {.natives = {{"round_is_there", guarded<round_is_there>}, {"end_round", guarded<end_round>}}};
}

}  // namespace ricochet
