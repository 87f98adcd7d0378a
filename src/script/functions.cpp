#include "script/functions.hpp"

#include <stdexcept>

namespace ricochet {
namespace {

const std::vector<Group>& groups() {
  static const std::vector<Group> list{
      parameter_functions(), material_functions(),    body_functions(),       point_functions(),
      scene_functions(),     estimate_functions(),    sweep_functions(),      long_sweep_functions(),
      shard_functions(),     shard_round_functions(), resampling_functions(), series_functions(),
      wave_functions(),      plot_functions(),        picture_functions(),    record_functions(),
      report_functions(),    lesson_functions(),      accuracy_functions(),   elasticity_functions(),
      mesh_functions(),      dem_functions(),         compare_functions(),    mode_functions(),
      ringing_functions(),   file_functions(),        theory_functions(),
  };
  return list;
}

}  // namespace

std::span<const Function> functions() {
  static const std::vector<Function> list = [] {
    std::vector<Function> all;
    for (const Group& group : groups()) all.insert(all.end(), group.functions.begin(), group.functions.end());
    return all;
  }();
  return list;
}

const Function& function_named(const std::string& name) {
  for (const Function& f : functions())
    if (f.name == name) return f;
  throw std::logic_error("no function is called " + name);
}

const Function* inner_table(const std::string& type) {
  static const std::vector<const Function*> tables = [] {  // few: every field that is read is looked up here
    std::vector<const Function*> list;
    for (const Function& f : functions())
      if (f.is_table) list.push_back(&f);
    return list;
  }();
  for (const Function* table : tables)
    if (table->name == type) return table;
  return nullptr;
}

const Function* element_table(const std::string& type) {
  return type.ends_with("[]") ? inner_table(type.substr(0, type.size() - 2)) : nullptr;
}

void add_functions(lua_State* L) {
  for (const Group& group : groups()) {
    for (const luaL_Reg& native : group.natives) {
      lua_pushcfunction(L, native.func);
      lua_setfield(L, -2, native.name);
    }
    if (group.add) group.add(L);
  }
  lua_newtable(L);
  for (const Function& f : functions()) {
    if (!f.call) continue;
    lua_pushcfunction(L, f.call);
    lua_setfield(L, -2, f.name.c_str());
  }
  lua_setfield(L, -2, "functions");
}

}  // namespace ricochet
