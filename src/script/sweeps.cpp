// sweep:run: scenes to rows, in parts that survive a kill.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_set>

#include "core/spelling.hpp"
#include "force/lane.hpp"
#include "impact/sweep.hpp"
#include "script/objects.hpp"
#include "script/state.hpp"
#include "script/sweep_store.hpp"

namespace ricochet {

Row row_of(const Scene& scene, const Outcome& outcome, double seconds) {
  Row row;
  for (const auto& [field, value] : Outcome::fields()) row.values.push_back(value(outcome));
  row.status = name_of(outcome.status);
  row.reason = outcome.reason;
  row.hash = scene.hash();
  row.seed = fmt::format("{}", scene.projectile->numbers.seed);
  row.seconds = seconds;
  return row;
}

namespace {

// A misspelt row.name is an error, not nil.
int unknown_column(lua_State* L) {
  std::vector<std::string> names;
  for (lua_pushnil(L); lua_next(L, 1) != 0; lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING) names.push_back(lua_tostring(L, -2));
  const std::string name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : shown(L, 2),
                    nearest = did_you_mean(name, names);
  throw at_line(
      L, fmt::format("a row has no column '{}'{}", name, nearest.empty() ? "; lua/REFERENCE.md lists them" : nearest));
}

}  // namespace

void push_row(lua_State* L, const Row& row) {
  lua_createtable(L, 0, static_cast<int>(row.values.size()) + 5);
  for (std::size_t i = 0; i < row.values.size(); ++i) {
    lua_pushnumber(L, row.values[i]);
    lua_setfield(L, -2, Outcome::fields()[i].first.name.c_str());
  }
  lua_pushstring(L, row.status.c_str());
  lua_setfield(L, -2, "status");
  lua_pushstring(L, row.reason.c_str());
  lua_setfield(L, -2, "reason");
  lua_pushstring(L, row.hash.c_str());
  lua_setfield(L, -2, "scene_hash");
  lua_pushstring(L, row.seed.c_str());
  lua_setfield(L, -2, "seed");
  lua_pushnumber(L, row.seconds);
  lua_setfield(L, -2, "wall_seconds");
  if (luaL_newmetatable(L, "row")) {
    lua_pushcfunction(L, guarded<unknown_column>);
    lua_setfield(L, -2, "__index");
    lua_pushboolean(L, false);
    lua_setfield(L, -2, "__metatable");
  }
  lua_setmetatable(L, -2);
}

namespace {

using Clock = std::chrono::steady_clock;

/// One line on a terminal, plain lines elsewhere, nothing with --quiet.
class Progress {
 public:
  Progress(const Session& session, std::string name, std::size_t total, std::size_t before)
      : name_(std::move(name)),
        total_(total),
        before_(before),
        done_(before),
        quiet_(session.options.quiet),
        terminal_(isatty(STDERR_FILENO)) {}

  void add(std::size_t count, std::size_t failed) {
    done_ += count;
    failed_ += failed;
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    const double rate = static_cast<double>(done_ - before_) / std::max(seconds, 1e-9);
    const std::string line = fmt::format("{}: {}/{}  {:.2f}/s  {:.0f} s left  {} failed", name_, done_, total_, rate,
                                         static_cast<double>(total_ - done_) / rate, failed_);
    if (quiet_) return;
    if (terminal_) {
      fmt::print(stderr, "\r\033[K{}{}", line, done_ == total_ ? "\n" : "");
    } else if (done_ * 10 / total_ > tenth_) {
      tenth_ = done_ * 10 / total_;
      fmt::print(stderr, "{}\n", line);
    }
  }

 private:
  std::string name_;
  std::size_t total_, before_, done_, failed_ = 0, tenth_ = 0;
  bool quiet_, terminal_;
  Clock::time_point start_ = Clock::now();
};

std::string left_behind(const Store& store, std::size_t total) {
  return fmt::format("{} of {} impacts are stored in {}; --resume goes on from there", store.count(), total,
                     store.folder().string());
}

std::size_t scenes_once(const std::vector<std::string>& hashes) {
  return std::unordered_set<std::string>(hashes.begin(), hashes.end()).size();
}

// Returns what it made of the machine.
SweepUse run_and_store(Session& session, Store& store, const std::string& name, const std::vector<Scene>& scenes,
                       const std::vector<std::string>& hashes) {
  std::vector<bool> todo(scenes.size());
  std::map<std::string, std::size_t> first;  // a scene that occurs twice runs once
  for (std::size_t i = 0; i < scenes.size(); ++i) todo[i] = !store.done()[i] && first.emplace(hashes[i], i).second;
  const std::size_t twins = scenes.size() - scenes_once(hashes);
  if (twins > 0)
    session.warn(
        fmt::format("{}: {} of {} scenes repeat another one exactly, so they are no samples of their own; does every "
                    "name of 'over' reach the scene?",
                    name, twins, scenes.size()));
  const Storing storing;
  Progress progress(session, name, scenes.size(), store.count());
  SweepOptions options;
  options.threads = session.options.threads;
  if (session.options.batch > 0) options.batch = session.options.batch;
  SweepUse use;
  const bool whole = run_sweep(
      scenes, todo, options, stop_requested,
      [&](const std::vector<Result>& results) {
        std::vector<std::pair<std::size_t, Row>> batch;
        std::size_t failed = 0;
        for (const Result& result : results) {
          batch.emplace_back(result.index, row_of(scenes[result.index], result.outcome, result.seconds));
          failed += result.outcome.status != Status::finished;
        }
        const std::size_t before = store.count();
        store.add(batch);
        progress.add(store.count() - before, failed);
      },
      &use);
  if (!whole) {
    store.assemble();
    throw Error(fmt::format("interrupted: {}", left_behind(store, scenes.size())), Exit::interrupted);
  }
  return use;
}

Parameters read_parameters(lua_State* L, int names, int points) {
  Parameters p;
  for (lua_Integer i = 1; i <= length_of(L, names); ++i) {
    lua_rawgeti(L, names, i);
    p.names.push_back(lua_tostring(L, -1));
    lua_pop(L, 1);
  }
  p.numbers.resize(p.names.size());
  p.texts.resize(p.names.size());
  const lua_Integer count = length_of(L, points);
  for (std::size_t k = 0; k < p.names.size(); ++k)
    for (lua_Integer i = 1; i <= count; ++i) {
      lua_rawgeti(L, points, i);
      const int type = lua_getfield(L, -1, p.names[k].c_str());
      if (type == LUA_TNUMBER)
        p.numbers[k].push_back(lua_tonumber(L, -1));
      else
        p.texts[k].push_back(type == LUA_TBOOLEAN ? (lua_toboolean(L, -1) ? "true" : "false") : lua_tostring(L, -1));
      lua_pop(L, 2);
    }
  return p;
}

// "pefrl, time step 0.0052 R/c, theta 1.6 and at most 1.68 (stable below 2.99)" for each method that ran.
std::string steps_text(const std::vector<Scene>& scenes, const std::vector<Row>& rows) {
  struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void take(double x) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
    std::string text() const {
      return low == high ? fmt::format("{:.4g}", low) : fmt::format("{:.4g} to {:.4g}", low, high);
    }
  };
  struct Steps {
    Extent step, theta, most, bound;
  };
  const auto column = [](const std::string& name) {
    std::size_t i = 0;
    while (Outcome::fields()[i].first.name != name) ++i;
    return i;
  };
  const std::size_t step = column("step"), theta = column("theta"), most = column("theta_most");
  std::map<std::string, Steps> methods;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::isnan(rows[i].values[step])) continue;  // passed by
    Steps& of = methods[scenes[i].method().name];
    of.step.take(rows[i].values[step]);
    of.theta.take(rows[i].values[theta]);
    of.most.take(rows[i].values[most]);
    of.bound.take(rows[i].values[theta] / rows[i].values[step]);
  }
  std::string text;
  for (const auto& [name, s] : methods)
    text += fmt::format(
        "  {}, time step {} R/c, theta {} and at most {:.3g} (stable below {:.4g}); frequency bound {} c/R\n", name,
        s.step.text(), s.theta.text(), s.most.high, method_named(name).stability_limit, s.bound.text());
  return text;
}

std::vector<Scene> scenes_at(lua_State* L, int list) {
  std::vector<Scene> scenes;
  for (lua_Integer i = 1; i <= length_of(L, list); ++i) {
    lua_rawgeti(L, list, i);
    scenes.push_back(scene_at(L, -1).scene);
    lua_pop(L, 1);
  }
  return scenes;
}

// pilot(scenes): a row for each, and the wall seconds that all of them took on the run's threads, steps chosen for an
// accuracy and lattices planned before. Nothing is stored.
int pilot(lua_State* L) {
  Session& session = session_of(L);
  std::vector<Scene> scenes = scenes_at(L, 1);
  std::vector<Row> rows(scenes.size());
  double seconds = 0;
  try {
    scenes = with_quietly_chosen_steps(session, scenes);
    SweepOptions options;
    options.threads = session.options.threads;
    if (session.options.batch > 0) options.batch = session.options.batch;
    const auto began = Clock::now();
    const bool whole = run_sweep(scenes, std::vector<bool>(scenes.size(), true), options, stop_requested,
                                 [&](const std::vector<Result>& results) {
                                   for (const Result& result : results)
                                     rows[result.index] = row_of(scenes[result.index], result.outcome, result.seconds);
                                 });
    seconds = std::chrono::duration<double>(Clock::now() - began).count();
    if (!whole) throw Error("interrupted", Exit::interrupted);
  } catch (const SceneError& error) {
    lua_rawgeti(L, 1, static_cast<lua_Integer>(error.scene) + 1);
    throw_at(session, scene_at(L, -1).site, error);
  }
  lua_createtable(L, static_cast<int>(rows.size()), 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    push_row(L, rows[i]);
    lua_pushstring(L, scenes[i].method().name.c_str());
    lua_setfield(L, -2, "method");
    lua_seti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_pushnumber(L, seconds);
  return 2;
}

// run_sweep(name, names, points, scenes): the rows, in the order of the scenes.
int run_sweep_from_lua(lua_State* L) {
  Session& session = session_of(L);
  const std::string name = luaL_checkstring(L, 1);
  if (!session.first_sweep_named(name))
    throw Error(report(
        session, call_site(L),
        {{{},
          fmt::format(
              "a sweep called '{}' has run already and its results would be replaced; give this one another name",
              name)}}));
  const Parameters parameters = read_parameters(L, 2, 3);
  std::vector<Scene> scenes = scenes_at(L, 4);
  std::vector<std::string> hashes;
  std::vector<Row> rows;
  std::string stored;
  try {
    if (!session.options.check) scenes = with_chosen_steps(session, scenes);
    for (const Scene& scene : scenes) hashes.push_back(scene.hash());
    SweepOptions options;
    options.threads = session.options.threads;
    if (session.options.check) {
      check_scenes(scenes, std::vector<bool>(scenes.size(), true), options, stop_requested);
      for (const Scene& scene : scenes) rows.push_back(row_of(scene, Outcome{}, 0));
      session.print(fmt::format("{}: {} scenes are sound\n", name, scenes.size()));
    } else {
      // A step that some lattice refuses is refused before anything is written.
      std::vector<bool> by_step(scenes.size());
      for (std::size_t i = 0; i < scenes.size(); ++i) by_step[i] = i == 0 || !std::isnan(scenes[i].integration.step);
      check_scenes(scenes, by_step, options, stop_requested);
      Store store(session, name, hashes, parameters);
      const std::size_t before = store.count();
      SweepUse use;
      try {
        use = run_and_store(session, store, name, scenes, hashes);
      } catch (const FileError& error) {
        throw FileError(fmt::format("{}\n  {}", error.what(), left_behind(store, scenes.size())));
      } catch (const SceneError&) {
        store.assemble();
        stored = "\n  " + left_behind(store, scenes.size());
        throw;
      }
      store.assemble();
      rows = store.rows();
      std::size_t finished = 0;
      for (const Row& row : rows) finished += row.status == "finished";
      std::string line = fmt::format("{}: {} of {} impacts finished; {}\n{}", name, finished, rows.size(),
                                     (store.folder() / "results.h5").string(), steps_text(scenes, rows));
      if (store.count() > before)
        line += fmt::format(
            "  {:.3g} s on {} thread{}, {:.2g} % of their time idle, {:.2g} % of the lanes' steps idle\n", use.seconds,
            use.threads, use.threads == 1 ? "" : "s", 100 * use.idle_threads, 100 * use.idle_lanes);
      for (const Row& row : rows) session.count(row.status == "finished", row.status + ": " + row.reason);
      session.print(line);
    }
  } catch (const SceneError& error) {
    lua_rawgeti(L, 4, static_cast<lua_Integer>(error.scene) + 1);
    throw_at(session, scene_at(L, -1).site,
             FieldError(error.field, fmt::format("{} (at {}){}", error.what(), parameters.place(error.scene), stored)));
  }
  lua_createtable(L, static_cast<int>(rows.size()), 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    push_row(L, rows[i]);
    // The sweep's own values, over an outcome of the same name.
    lua_rawgeti(L, 3, static_cast<lua_Integer>(i) + 1);
    for (const std::string& parameter : parameters.names) {
      lua_getfield(L, -1, parameter.c_str());
      lua_setfield(L, -3, parameter.c_str());
    }
    lua_pop(L, 1);
    lua_seti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  return 1;
}

// clock(): wall seconds since some moment.
int clock_seconds(lua_State* L) {
  lua_pushnumber(L, std::chrono::duration<double>(Clock::now().time_since_epoch()).count());
  return 1;
}

// columns(): name -> unit of every outcome, for labels and for checking names.
int columns(lua_State* L) {
  lua_newtable(L);
  for (const auto& [field, value] : Outcome::fields()) {
    lua_pushstring(L, field.unit.c_str());
    lua_setfield(L, -2, field.name.c_str());
  }
  return 1;
}

}  // namespace

void add_sweeps(lua_State* L) {
  const luaL_Reg list[] = {{"run_sweep", guarded<run_sweep_from_lua>},
                           {"columns", columns},
                           {"pilot", guarded<pilot>},
                           {"clock", clock_seconds}};
  for (const luaL_Reg& f : list) {
    lua_pushcfunction(L, f.func);
    lua_setfield(L, -2, f.name);
  }
}

}  // namespace ricochet
