// ricochet.theory: every theory of the catalogue as a function of one table.

#include <fmt/format.h>

#include <cmath>

#include "script/objects.hpp"
#include "script/reader.hpp"
#include "theory/catalogue.hpp"

namespace ricochet {
namespace {

// The value of a checked field on top of the stack.
theory::Value read_value(lua_State* L, const Field& field) {
  if (field.type == "string") return std::string(lua_tostring(L, -1));
  if (field.type != "numbers") return static_cast<double>(lua_tonumber(L, -1));
  return numbers_at(L, -1);
}

void push_value(lua_State* L, const theory::Value& value) {
  if (const double* number = std::get_if<double>(&value)) {
    lua_pushnumber(L, *number);
    return;
  }
  const auto& list = std::get<theory::Numbers>(value);
  lua_createtable(L, static_cast<int>(list.size()), 0);
  for (std::size_t i = 0; i < list.size(); ++i) {
    lua_pushnumber(L, list[i]);
    lua_seti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
}

// Called with the theory's place in the catalogue as upvalue.
int call_theory(lua_State* L) {
  const theory::Theory& called = theory::theories()[static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)))];
  if (lua_gettop(L) > 1)
    throw at_line(L, fmt::format("theory.{0} takes one table and is called with a dot: ricochet.theory.{0} {{ ... }}",
                                 called.name));
  check_table(L, 1, function_named("theory." + called.name));
  std::map<std::string, theory::Value> given;
  for (const Field& field : called.arguments) {
    if (lua_getfield(L, 1, field.name.c_str()) != LUA_TNIL) given[field.name] = read_value(L, field);
    lua_pop(L, 1);
  }
  std::vector<theory::Value> values;
  try {
    values = called.evaluate(given);
  } catch (const FieldError& error) {
    CallSite site = call_site(L);
    if (site.function.empty()) site.function = called.name;
    throw_at(session_of(L), site, error);
  } catch (const Error& error) {
    throw at_line(L, fmt::format("theory.{}: {}", called.name, error.what()));
  }
  if (called.results.size() == 1) {
    push_value(L, values[0]);
    return 1;
  }
  lua_createtable(L, 0, static_cast<int>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double* number = std::get_if<double>(&values[i]);
    if (number && *number != *number) continue;  // an optional result that does not exist here
    push_value(L, values[i]);
    lua_setfield(L, -2, called.results[i].name.c_str());
  }
  push_strict(L, "the table of theory." + called.name);
  return 1;
}

// unknown_theory(table, name)
int unknown_theory(lua_State* L) {
  std::vector<std::string> names;
  for (const theory::Theory& theory : theory::theories()) names.push_back(theory.name);
  throw unknown_name(L, "ricochet.theory", asked_name(L, 2), names);
}

int no_new_theory(lua_State* L) { throw at_line(L, "ricochet.theory takes no new fields"); }

void add_theories(lua_State* L) {
  lua_newtable(L);
  for (std::size_t i = 0; i < theory::theories().size(); ++i) {
    lua_pushinteger(L, static_cast<lua_Integer>(i));
    lua_pushcclosure(L, guarded<call_theory>, 1);
    lua_setfield(L, -2, theory::theories()[i].name.c_str());
  }
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, guarded<unknown_theory>);
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
  // An empty table before it, so that no name can be given another meaning.
  lua_newtable(L);
  lua_createtable(L, 0, 3);
  lua_rotate(L, -3, -1);
  lua_setfield(L, -2, "__index");
  lua_pushcfunction(L, guarded<no_new_theory>);
  lua_setfield(L, -2, "__newindex");
  lua_pushboolean(L, false);
  lua_setfield(L, -2, "__metatable");
  lua_setmetatable(L, -2);
  lua_setfield(L, -2, "theory");
}

Function function_of(const theory::Theory& theory) {
  Function function{
      .name = "theory." + theory.name,
      .doc = fmt::format("{} Valid: {}. Source: {}. Units in any consistent system of mass M, length L and time T.",
                         theory.says, theory.valid, theory.source),
      .fields = theory.arguments,
      .returns = "table",
      .example = theory.example};
  if (theory.results.size() > 1)
    function.results = theory.results;
  else
    function.returns = theory.results[0].type;
  return function;
}

}  // namespace

Group theory_functions() {
  Group group{.functions = {}, .add = add_theories};
  for (const theory::Theory& theory : theory::theories()) group.functions.push_back(function_of(theory));
  return group;
}

}  // namespace ricochet
