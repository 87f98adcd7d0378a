#pragma once
// The functions of the Lua module. Each is described beside its code, one file a group. From the descriptions come the
// reading and checking of tables, the messages, the editor stubs and the reference page.
//
// A new function is an entry in its group's file; one that is written in Lua is described there too, and named in
// lua/ricochet/init.lua. A new group is its file, its name below and its place in functions.cpp.

#include <lua.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/field.hpp"

namespace ricochet {

struct Function {
  std::string name;  ///< as a script writes it: "disk", "file.write", "rows:summary" (a method)
  std::string doc;
  std::vector<Field> fields;
  std::string returns;
  std::string example;
  lua_CFunction call = nullptr;       ///< none if it is written in Lua
  std::vector<Field> results = {};    ///< what the returned table holds, where that is listed
  std::vector<Field> arguments = {};  ///< if they are not one table of named fields
  bool is_adaptive = false;           ///< decides by what it runs, so that no shard can call it
  bool is_table = false;              ///< no function, but a table of named fields inside another: `launch`

  bool is_method() const { return name.find(':') != std::string::npos; }
};

struct Group {
  std::vector<Function> functions;
  std::vector<luaL_Reg> natives = {};   ///< for the Lua library alone, as core.NAME
  void (*add)(lua_State* L) = nullptr;  ///< what else it puts into the table of those, which is on top of the stack
};

// Each group in its own file.
Group parameter_functions();
Group material_functions();
Group body_functions();
Group point_functions();
Group scene_functions();
Group estimate_functions();
Group sweep_functions();
Group resampling_functions();
Group long_sweep_functions();
Group shard_functions();
Group shard_round_functions();
Group series_functions();
Group wave_functions();
Group plot_functions();
Group picture_functions();
Group record_functions();
Group report_functions();
Group lesson_functions();
Group accuracy_functions();
Group elasticity_functions();
Group mesh_functions();
Group dem_functions();
Group compare_functions();
Group mode_functions();
Group ringing_functions();
Group file_functions();
Group theory_functions();

/// Every function, in the order of the reference page.
std::span<const Function> functions();

/// The function of that name; a programming mistake if there is none.
const Function& function_named(const std::string& name);

/// The table of named fields that a field of this type holds ("launch"); nullptr if it holds something else.
const Function* inner_table(const std::string& type);
/// The same of a list of such tables ("slider[]").
const Function* element_table(const std::string& type);

/// Puts the natives of all groups into the table on top of the stack, and under `functions` those of the module.
void add_functions(lua_State* L);

}  // namespace ricochet
