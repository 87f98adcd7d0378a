// ricochet.series (lua/ricochet/series.lua) and scene:bounces (lua/ricochet/bounces.lua): one run as tables of numbers.

#include <fmt/format.h>
#include <unistd.h>

#include "impact/bounces.hpp"
#include "script/fields.hpp"
#include "script/filmed.hpp"
#include "script/objects.hpp"
#include "script/run_files.hpp"
#include "script/series_times.hpp"
#include "script/step_choice.hpp"
#include "script/sweep_report.hpp"
#include "store/sinks.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// Sets a field of the table on top of the stack to a list of points { x, y }.
void set_points(lua_State* L, const char* name, const Points& points, double length) {
  lua_createtable(L, static_cast<int>(points.size()), 0);
  for (const Vec2& point : points) {
    lua_createtable(L, 2, 0);
    for (int k = 0; k < 2; ++k) {
      lua_pushnumber(L, length * point[k]);
      lua_seti(L, -2, k + 1);
    }
    lua_seti(L, -2, list_length(L, -2) + 1);
  }
  lua_setfield(L, -2, name);
}

// Sets a field of the table on top of the stack to what a function sees of a body.
void set_body(lua_State* L, const char* name, const BodySample& body, const Units& units, bool outlines) {
  const double length = units.worth("R"), speed = units.worth("c"), energy = units.worth("m0 c^2");
  lua_createtable(L, 0, 9);
  set_number(L, "x", length * body.centre.x());
  set_number(L, "y", length * body.centre.y());
  set_number(L, "vx", speed * body.velocity.x());
  set_number(L, "vy", speed * body.velocity.y());
  set_number(L, "angle", body.angle);
  set_number(L, "spin", units.worth("c/R") * body.spin);
  set_number(L, "translation", energy * body.energy.translation);
  set_number(L, "rotation", energy * body.energy.rotation);
  set_number(L, "vibration", energy * body.energy.vibration);
  if (outlines) set_points(L, "outline", body.outline, length);
  push_strict(L, fmt::format("the {} of a state", name));
  lua_setfield(L, -2, name);
}

void push_state(lua_State* L, const Sample& sample, const Units& units, bool outlines) {
  lua_createtable(L, 0, static_cast<int>(Sample::fields().size()) + 2);
  for (const auto& [field, value] : Sample::fields())
    set_number(L, field.name.c_str(), units.worth(field.unit) * value(sample));
  set_body(L, "projectile", sample.projectile, units, outlines);
  set_body(L, "target", sample.target, units, outlines);
  push_strict(L, "a state");
}

// The files of a series: FILE.h5, FILE.csv ...
std::string file_of(const std::string& name) { return name + rows_sinks().front().extension; }

// sample(series): the state at each of its times; with --check that at the start alone.
int sample(lua_State* L) {
  Session& session = session_of(L);
  std::vector<FilmedScene> scenes = filmed_scenes(L);
  const FilmedScene& filmed = scenes[0];
  const SeriesTimes wanted = members_of_call<SeriesTimes>(L, {}, filmed.scene.units);
  lua_getfield(L, 1, "outlines");
  const bool outlines = lua_toboolean(L, -1);
  lua_pop(L, 1);
  std::vector<double> times{0};
  if (!session.options.check) {
    lua_getfield(L, 1, "name");
    claimed_files(L, "name", lua_tostring(L, -1), rows_sinks());
    follow(L, scenes);
    times = series_times(L, filmed, wanted);
  }
  lua_createtable(L, static_cast<int>(times.size()), 0);
  std::vector<Sample> samples;
  RunProgress progress(session.options.quiet, isatty(STDERR_FILENO), times.back(), filmed.scene.units);
  const Sampling sampling{times, [&](const Sample& now) {
                            progress.tell(now.time);
                            samples.push_back(now);
                          }};
  at_scene(session, call_site(L), filmed, [&] {
    if (!film_scene(filmed.solids, filmed.scene, {}, stop_requested, {}, sampling))
      throw Error("interrupted", Exit::interrupted);
  });
  settle_overlaps(samples);
  for (const Sample& now : samples) {
    push_state(L, now, filmed.scene.units, outlines);
    lua_seti(L, -2, list_length(L, -2) + 1);
  }
  return 1;
}

// quantities([system]): { { name =, unit =, doc = }, ... } of what a series can tell, the time first.
int quantities(lua_State* L) {
  const Units units = Units::named(luaL_optstring(L, 1, "paper"));
  lua_newtable(L);
  for (const auto& [field, value] : Sample::fields()) {
    lua_createtable(L, 0, 3);
    lua_pushstring(L, field.name.c_str());
    lua_setfield(L, -2, "name");
    lua_pushstring(L, units.name(field.unit).c_str());
    lua_setfield(L, -2, "unit");
    lua_pushstring(L, field.doc.c_str());
    lua_setfield(L, -2, "doc");
    lua_seti(L, -2, list_length(L, -2) + 1);
  }
  return 1;
}

std::string text_in(lua_State* L, const char* field) {
  lua_getfield(L, -1, field);
  const std::string text = lua_tostring(L, -1);
  lua_pop(L, 1);
  return text;
}

// store_series(scene, name, columns, rows): as files of every format; columns as in quantities().
int store_series(lua_State* L) {
  Session& session = session_of(L);
  const Scene& scene = scene_at(L, 1).scene;
  const fs::path path = below_folder(L, file_of(luaL_checkstring(L, 2)));
  Table table;
  each_element(L, 3, [&](lua_Integer) {
    const std::string name = text_in(L, "name");
    NumberColumn& column =
        table.numbers.emplace_back(NumberColumn{{name, "number", text_in(L, "unit"), text_in(L, "doc")}, {}});
    each_element(L, 4, [&](lua_Integer) {
      lua_getfield(L, -1, name.c_str());
      column.values.push_back(lua_tonumber(L, -1));
      lua_pop(L, 1);
    });
  });
  Provenance provenance = session.provenance();
  provenance["scene"] = scene.text();
  provenance["scene_hash"] = scene.hash();
  write_everywhere(fs::path(path).replace_extension(), table, provenance);
  session.inform(fmt::format("series: {} points in {}\n", table.rows(), path.string()));
  return 0;
}

void push_bounce(lua_State* L, int number, const Bounce& bounce, const Units& units) {
  lua_createtable(L, 0, 6);
  lua_pushinteger(L, number);
  lua_setfield(L, -2, "bounce");
  set_number(L, "speed", units.worth("c") * bounce.speed);
  set_number(L, "e", bounce.e);
  set_number(L, "height", units.worth("R") * bounce.height);
  set_number(L, "time", units.worth("R/c") * bounce.time);
  lua_pushliteral(L, "finished");
  lua_setfield(L, -2, "status");
  push_strict(L, "a row of bounces");
}

// With --check: bounces of an elastic ball, with which a script can go on.
Bounces bounces_of(Session& session, const Scene& asked, int count, double least_height) {
  const Scene scene = with_chosen_step(session, asked);
  const BuiltSolids solids(scene);
  if (!session.options.check) return follow_bounces(solids, scene, count, least_height, stop_requested);
  check_start(solids, scene);
  check_bounces(scene);
  Bounces bounces;
  for (int k = 1; k <= count; ++k) bounces.list.push_back({.speed = 0.1, .e = 1, .height = 1, .time = 20.0 * k});
  return bounces;
}

// bounces(scene, count, least_height): a list of rows, and why they are fewer than `count`, or nil.
int bounces(lua_State* L) {
  Session& session = session_of(L);
  const SceneObject& object = scene_at(L, 1);
  const int count = static_cast<int>(luaL_checkinteger(L, 2));
  const double least_height = lua_isnil(L, 3) ? not_given : lua_tonumber(L, 3) / object.scene.units.worth("R");
  Bounces result;
  try {
    result = bounces_of(session, object.scene, count, least_height);
  } catch (const FieldError& error) {
    throw_at(session, object.site, explained(error, object.scene));
  }
  if (stop_requested) throw Error("interrupted", Exit::interrupted);
  result.reason = object.scene.units.explained(result.reason);
  if (!result.reason.empty())
    session.inform(fmt::format("{} of {} bounces: {}\n", result.list.size(), count, result.reason));
  lua_createtable(L, static_cast<int>(result.list.size()), 0);
  for (std::size_t k = 0; k < result.list.size(); ++k) {
    push_bounce(L, static_cast<int>(k) + 1, result.list[k], object.scene.units);
    lua_seti(L, -2, static_cast<lua_Integer>(k) + 1);
  }
  if (result.reason.empty()) return 1;
  lua_pushstring(L, result.reason.c_str());
  return 2;
}

// add_scene_method(name, function): one that is written in Lua.
int add_scene_method(lua_State* L) {
  luaL_getmetatable(L, "ricochet.scene");
  lua_getfield(L, -1, "methods");
  lua_pushvalue(L, 2);
  lua_setfield(L, -2, luaL_checkstring(L, 1));
  return 0;
}

// What a function of the state sees, and what `of` can name.
Function state_table() {
  const std::string body =
      "centre x, y [R], its velocity vx, vy [c], angle it has turned by [rad], spin [c/R], and the energies "
      "translation, rotation, vibration [m0 c^2]; if the series has `outlines`, its outline, a list of the places { x, "
      "y } [R] of the nodes of its surface, along it, those of holes after a place of NaN each, of a body of "
      "revolution those at x >= 0, of a plane none";
  std::vector<Field> fields;
  for (const auto& [field, value] : Sample::fields()) fields.push_back(field);
  fields.push_back({"projectile", "table", "", "of the projectile: " + body});
  fields.push_back({"target", "table", "", "of the target: " + body});
  return {.name = "state",
          .doc =
              "An impact at a moment, as functions of a `series` see it. Its numbers are the quantities that a series "
              "can name.",
          .fields = fields,
          .is_table = true};
}

Function series_function() {
  return {
      .name = "series",
      .doc =
          "An impact as columns of numbers over time, sampled between the engine's steps: returns rows, and leaves "
          "them as NAME.h5 and NAME.csv in the run's folder. `ricochet.plot` draws them as lines, in their order. The "
          "first column is the time.",
      .fields = std::vector<Field>{scene_field(),
                                   {"of", "table", "",
                                    "list of quantities of the `state`, and name = function (state) that returns a "
                                    "number"}} +
                fields_of<SeriesTimes>() +
                std::vector<Field>{{"outlines", "boolean", "",
                                    "whether the projectile and the target of a state hold an `outline`, for functions "
                                    "of the state",
                                    any_number, "false"},
                                   {"name", "string", "", "file name without extension", any_number, "series"}},
      .returns = "rows",
      .example =
          "local rows = ricochet.series { scene = scene, of = { \"force_n\", \"overlap\", lever = function(state) "
          "return state.projectile.x - state.target.x end } }\n"
          "ricochet.plot { rows = rows, x = \"time\", y = { \"force_n\", \"lever\" }, name = \"force\" }"};
}

Function bounces_method() {
  return {
      .name = "scene:bounces",
      .doc =
          "Lets gravity bring the projectile back, in one run in which the bodies vibrate on. Returns rows, one a "
          "bounce: `bounce`; `speed` [c], the normal speed at the first touch; `e`, that at parting over it; "
          "`height` [R], to which the centre then rises above where it was at that touch; `time` [R/c] of the first "
          "touch, since the rims first came within reach. Where there are fewer than `count`, a second result tells "
          "why. Only a time_limit that the scene names limits the whole run.",
      .fields = {{"count", "integer", "", "how many", {1, 1e6}, "8"},
                 {"least_height", "number", "R",
                  "a bounce that rises less is the last one; the reach of the contact unless given, below which "
                  "bodies do not part",
                  positive, "", true}},
      .returns = "rows",
      .example =
          "local rows, reason = ricochet.scene { projectile = ricochet.disk {}, target = ricochet.plane {}, launch "
          "= { height = 1, speed = 0 }, effects = { ricochet.gravity { g = 1e-3 } } }:bounces { count = 4 }"};
}

}  // namespace

Group series_functions() {
  return {.functions = {series_function(), state_table(), bounces_method()},
          .natives = {{"sample", guarded<sample>},
                      {"quantities", quantities},
                      {"store_series", guarded<store_series>},
                      {"bounces", guarded<bounces>},
                      {"add_scene_method", add_scene_method}}};
}

}  // namespace ricochet
