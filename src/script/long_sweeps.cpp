// Long sweeps and their rows, from lua/ricochet/long_sweep.lua and long_rows.lua.

#include <fmt/format.h>

#include "script/fields.hpp"
#include "script/long_rows.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "script/shard_work.hpp"
#include "script/sweep_read.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace {

constexpr const char* sweep_type = "ricochet.long_sweep";
constexpr const char* rows_type = "ricochet.long_rows";

using SharedSweep = std::shared_ptr<LongSweep>;

LongSweep& sweep_at(lua_State* L, int index) {
  return **static_cast<SharedSweep*>(luaL_checkudata(L, index, sweep_type));
}
LongRows& rows_at(lua_State* L, int index) { return *static_cast<LongRows*>(luaL_checkudata(L, index, rows_type)); }

template <class Object>
void push_held(lua_State* L, const char* type, Object object) {
  new (lua_newuserdatauv(L, sizeof(Object), 0)) Object(std::move(object));
  luaL_setmetatable(L, type);
}

std::vector<std::size_t> point_numbers_at(lua_State* L, int list) {
  std::vector<std::size_t> points;
  each_element(L, list, [&](lua_Integer) { points.push_back(static_cast<std::size_t>(lua_tointeger(L, -1))); });
  return points;
}

// A list of { name =, unit =, stride =, values = }.
std::vector<SweptAxis> axes_at(lua_State* L, int list) {
  std::vector<SweptAxis> axes;
  each_element(L, list, [&](lua_Integer) {
    lua_getfield(L, -1, "name");
    lua_getfield(L, -2, "unit");
    lua_getfield(L, -3, "stride");
    SweptAxis axis{lua_tostring(L, -3), lua_tostring(L, -2), static_cast<std::size_t>(lua_tointeger(L, -1)), {}, {}};
    lua_getfield(L, -4, "values");
    each_element(L, -1, [&](lua_Integer) {
      if (lua_type(L, -1) == LUA_TNUMBER)
        axis.numbers.push_back(lua_tonumber(L, -1));
      else
        axis.texts.emplace_back(lua_isboolean(L, -1) ? (lua_toboolean(L, -1) ? "true" : "false") : lua_tostring(L, -1));
    });
    lua_pop(L, 4);
    axes.push_back(std::move(axis));
  });
  return axes;
}

// at_once(): how many scenes of a sweep are kept together.
int at_once(lua_State* L) {
  lua_pushinteger(L, session_of(L).options.at_once);
  return 1;
}

// long_sweep(name, axes, points, own): `own` of the points are run here, all if it is not given.
int long_sweep(lua_State* L) {
  Session& session = session_of(L);
  const std::string name = luaL_checkstring(L, 1);
  if (!session.first_sweep_named(name)) throw at_this_call(L, ran_already(name));
  const auto points = static_cast<std::size_t>(lua_tointeger(L, 3));
  const auto own = static_cast<std::size_t>(luaL_optinteger(L, 4, lua_tointeger(L, 3)));
  push_held(L, sweep_type, std::make_shared<LongSweep>(session, name, axes_at(L, 2), points, own));
  return 1;
}

// long_merged(name, axes, points, first): the rows of a sweep whose shards were merged, for a shard of a later one.
int long_merged(lua_State* L) {
  Session& session = session_of(L);
  const std::string name = luaL_checkstring(L, 1);
  if (!session.first_sweep_named(name)) throw at_this_call(L, ran_already(name));
  push_held(L, rows_type,
            LongRows(run_names::readable_results(session.folders.named(name)), axes_at(L, 2),
                     static_cast<std::size_t>(lua_tointeger(L, 3)), scene_at(L, 4).scene));
  return 1;
}

int chooses(lua_State* L) {
  lua_pushboolean(L, sweep_at(L, 1).chooses());
  return 1;
}

int looks_first(lua_State* L) {
  lua_pushboolean(L, sweep_at(L, 1).looks_first());
  return 1;
}

int lacks(lua_State* L) {
  lua_pushboolean(L, sweep_at(L, 1).lacks(point_numbers_at(L, 2)));
  return 1;
}

// Calls do(points, scenes) of a chunk: arguments are the sweep, points from 0, scenes.
template <class Do>
int of_chunk(lua_State* L, Do work) {
  const LongSweep& sweep = sweep_at(L, 1);
  const std::vector<std::size_t> points = point_numbers_at(L, 2);
  try {
    work(points, scenes_at(L, 3));
  } catch (const SceneError& error) {
    throw_at_scene(L, 3, error, fmt::format(" (at {}){}", sweep.place(points[error.scene]), sweep.stored()));
  }
  lua_settop(L, 0);
  session_of(L).forget_plans();
  return 0;
}

int choose(lua_State* L) {
  return of_chunk(
      L, [&](const auto& points, std::vector<Scene> scenes) { sweep_at(L, 1).choose(points, std::move(scenes)); });
}

int look_at(lua_State* L) {
  return of_chunk(
      L, [&](const auto& points, std::vector<Scene> scenes) { sweep_at(L, 1).look(points, std::move(scenes)); });
}

int run_chunk(lua_State* L) {
  return of_chunk(
      L, [&](const auto& points, std::vector<Scene> scenes) { sweep_at(L, 1).run(points, std::move(scenes)); });
}

int end_look(lua_State* L) {
  sweep_at(L, 1).end_look();
  return 0;
}

// The scene of a point, made again by the function of Lua in the registry; none if it makes another one now.
std::optional<Scene> made_again(lua_State* L, int make, const LongSweep& sweep, const std::string& hash) {
  const std::optional<std::size_t> point = sweep.point_of(hash);
  if (!point) return std::nullopt;
  const int top = lua_gettop(L);
  lua_rawgeti(L, LUA_REGISTRYINDEX, make);
  lua_pushinteger(L, static_cast<lua_Integer>(*point));
  std::optional<Scene> scene;
  if (lua_pcall(L, 1, 1, 0) == LUA_OK && is_object(L, -1, "scene")) {
    scene = scene_at(L, -1).scene;
    sweep.give_step(*scene, *point);
    if (scene->hash() != hash) scene.reset();
  }
  lua_settop(L, top);
  return scene;
}

// long_end_shard(sweep): writes the file of a shard, and ends the script.
int end_shard(lua_State* L) {
  sweep_at(L, 1).end_shard();
  end_script(session_of(L));
}

// long_end(sweep, make): writes the results; the rows of all points. `make`: the scene of a point, from 0.
int long_end(lua_State* L) {
  Session& session = session_of(L);
  const SharedSweep sweep = *static_cast<SharedSweep*>(luaL_checkudata(L, 1, sweep_type));
  sweep->end();
  lua_settop(L, 2);
  const int make = luaL_ref(L, LUA_REGISTRYINDEX);
  if (!session.options.check)
    session.swept.push_back({sweep->name(), sweep->results().parent_path(),
                             [L, make, sweep](const std::string& hash) { return made_again(L, make, *sweep, hash); }});
  push_held(L, rows_type, LongRows(sweep));
  return 1;
}

// long_value(rows, point, column): nil if there is no such column.
int long_value(lua_State* L) {
  LongRows& rows = rows_at(L, 1);
  const auto point = static_cast<std::size_t>(lua_tointeger(L, 2));
  const std::string column = luaL_checkstring(L, 3);
  if (const auto number = rows.number(point, column))
    lua_pushnumber(L, *number);
  else if (const std::string* text = rows.text(point, column))
    lua_pushstring(L, text->c_str());
  else
    lua_pushnil(L);
  return 1;
}

// long_row(rows, point): a table with every column.
int long_row(lua_State* L) {
  push_row(L, rows_at(L, 1).row(static_cast<std::size_t>(lua_tointeger(L, 2))));
  return 1;
}

// peek(row, name): the value of a column; nil, and no error, if the row has none.
int peek(lua_State* L) {
  lua_settop(L, 2);
  if (!lua_istable(L, 1)) return 0;
  lua_pushvalue(L, 2);
  if (lua_rawget(L, 1) != LUA_TNIL) return 1;
  if (luaL_getmetafield(L, 1, "peek") == LUA_TNIL) return 1;
  lua_insert(L, 1);
  lua_settop(L, 3);
  lua_call(L, 2, 1);
  return 1;
}

template <class Object>
void make_held(lua_State* L, const char* type) {
  luaL_newmetatable(L, type);
  lua_pushcfunction(L, collect_object<Object>);
  lua_setfield(L, -2, "__gc");
  lua_pushboolean(L, false);
  lua_setfield(L, -2, "__metatable");
  lua_pop(L, 1);
}

void make_long_types(lua_State* L) {
  make_held<SharedSweep>(L, sweep_type);
  make_held<LongRows>(L, rows_type);
}

}  // namespace

Group long_sweep_functions() {
  return {.natives = {{"at_once", at_once},
                      {"long_sweep", guarded<long_sweep>},
                      {"long_merged", guarded<long_merged>},
                      {"long_chooses", chooses},
                      {"long_choose", guarded<choose>},
                      {"long_looks_first", looks_first},
                      {"long_look", guarded<look_at>},
                      {"long_end_look", guarded<end_look>},
                      {"long_lacks", lacks},
                      {"long_run", guarded<run_chunk>},
                      {"long_end_shard", guarded<end_shard>},
                      {"long_end", guarded<long_end>},
                      {"long_value", guarded<long_value>},
                      {"long_row", guarded<long_row>},
                      {"peek", peek}},
          .add = make_long_types};
}

}  // namespace ricochet
