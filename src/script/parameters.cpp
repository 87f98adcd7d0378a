// ricochet.parameters: what a user may set on the command line.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/spelling.hpp"
#include "script/reader.hpp"
#include "script/state.hpp"

namespace ricochet {
namespace {

struct Parameter {
  enum class Kind { number, boolean, string, numbers } kind;
  Field field;
  bool whole = false;
  std::string initial;  // as shown
};

struct Given {
  std::string name, value;
};

std::vector<Given> given_arguments(const Session& session) {
  std::vector<Given> list;
  for (const std::string& argument : session.arguments) {
    const std::size_t equals = argument.find('=');
    const std::string name = argument.substr(0, equals);
    if (std::any_of(list.begin(), list.end(), [&](const Given& g) { return g.name == name; }))
      throw Error(fmt::format("parameter '{}' is given twice", name), Exit::usage);
    list.push_back({argument.substr(0, equals), argument.substr(equals + 1)});
  }
  return list;
}

bool parse_number(const std::string& text, double& value) {
  // A ratio such as 1/100 reads better than 0.01.
  const std::size_t slash = text.find('/');
  const auto plain = [](std::string_view t, double& v) {
    const auto [end, error] = std::from_chars(t.data(), t.data() + t.size(), v);
    return error == std::errc() && end == t.data() + t.size() && std::isfinite(v);
  };
  if (slash == std::string::npos) return plain(text, value);
  double over = 0;
  if (!plain(std::string_view(text).substr(0, slash), value) ||
      !plain(std::string_view(text).substr(slash + 1), over) || over == 0)
    return false;
  value /= over;
  return true;
}

std::string range_of(const Parameter& p) {
  std::string text;
  if (p.field.range.min > any_number.min) text += fmt::format(" at least {:g}", p.field.range.min);
  if (p.field.range.max < any_number.max)
    text += fmt::format("{} at most {:g}", text.empty() ? "" : ",", p.field.range.max);
  for (const std::string& c : p.field.choices)
    text += (text.empty() || &c != &p.field.choices.front() ? " " : " one of ") + c;
  return text;
}

void push_number(lua_State* L, const Parameter& p, const std::string& text) {
  double value = 0;
  const auto wrong = [&](const std::string& what) {
    throw Error(fmt::format("parameter '{}' must be {}, is '{}'{}", p.field.name, what, text,
                            p.field.doc.empty() ? "" : fmt::format(" ({})", p.field.doc)));
  };
  const std::string unit = p.field.unit.empty() ? "" : fmt::format(" [{}]", p.field.unit);
  if (!parse_number(text, value)) wrong((p.whole ? "a whole number" : "a number") + unit);
  if (p.whole && value != std::floor(value)) wrong("a whole number" + unit);
  if (!p.field.range.contains(value)) wrong(fmt::format("a number{},{}", unit, range_of(p)));
  if (p.whole)
    lua_pushinteger(L, static_cast<lua_Integer>(value));
  else
    lua_pushnumber(L, value);
}

// Pushes the value that the text stands for.
void push_given(lua_State* L, const Parameter& p, const std::string& text) {
  switch (p.kind) {
    case Parameter::Kind::number:
      push_number(L, p, text);
      return;
    case Parameter::Kind::boolean:
      if (text != "true" && text != "false")
        throw Error(fmt::format("parameter '{}' must be true or false, is '{}'", p.field.name, text));
      lua_pushboolean(L, text == "true");
      return;
    case Parameter::Kind::string:
      if (!p.field.choices.empty() &&
          std::find(p.field.choices.begin(), p.field.choices.end(), text) == p.field.choices.end())
        throw Error(fmt::format("parameter '{}' must be{}, is '{}'{}", p.field.name, range_of(p), text,
                                did_you_mean(text, p.field.choices)));
      lua_pushstring(L, text.c_str());
      return;
    case Parameter::Kind::numbers: {
      lua_newtable(L);
      lua_Integer n = 0;
      for (std::size_t start = 0; start <= text.size();) {
        const std::size_t comma = std::min(text.find(',', start), text.size());
        push_number(L, p, text.substr(start, comma - start));
        lua_seti(L, -2, ++n);
        start = comma + 1;
      }
      return;
    }
  }
}

std::string text_of(lua_State* L, int index) {
  if (lua_isboolean(L, index)) return lua_toboolean(L, index) ? "true" : "false";
  if (lua_istable(L, index)) {
    std::string text;
    for (lua_Integer i = 1; i <= length_of(L, index); ++i) {  // of numbers
      lua_rawgeti(L, index, i);
      text += (i > 1 ? "," : "") + text_of(L, -1);
      lua_pop(L, 1);
    }
    return text;
  }
  if (lua_type(L, index) == LUA_TNUMBER)
    return lua_isinteger(L, index) ? fmt::format("{}", lua_tointeger(L, index))
                                   : fmt::format("{}", lua_tonumber(L, index));
  return lua_tostring(L, index);
}

// Reads a declaration (value at the top of the stack: a default, or a table with the default first); leaves the default
// there.
Parameter declared(lua_State* L, const std::string& name) {
  const auto wrong = [&](const std::string& message) {
    throw Error(report(session_of(L), call_site(L), {{{name}, fmt::format("'{}': {}", name, message)}}));
  };
  Parameter p{};
  p.field.name = name;
  if (lua_istable(L, -1)) {
    static const std::vector<std::string> known{"choices", "doc", "int", "max", "min", "unit"};
    for (lua_pushnil(L); lua_next(L, -2) != 0; lua_pop(L, 1)) {
      if (lua_type(L, -2) == LUA_TNUMBER && lua_tointeger(L, -2) == 1) continue;
      const std::string key = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "?";
      if (key == "?")
        wrong("takes the default first, then named fields; a list of numbers as default needs its own braces");
      if (std::find(known.begin(), known.end(), key) == known.end())
        wrong(fmt::format("unknown field '{}'{}", key, did_you_mean(key, known)));
    }
    const auto text_field = [&](const char* key, std::string& value) {
      if (lua_getfield(L, -1, key) == LUA_TSTRING)
        value = lua_tostring(L, -1);
      else if (!lua_isnil(L, -1))
        wrong(fmt::format("{} must be a string", key));
      lua_pop(L, 1);
    };
    const auto number_field = [&](const char* key, double& value) {
      if (lua_getfield(L, -1, key) == LUA_TNUMBER)
        value = lua_tonumber(L, -1);
      else if (!lua_isnil(L, -1))
        wrong(fmt::format("{} must be a number", key));
      lua_pop(L, 1);
    };
    text_field("unit", p.field.unit);
    text_field("doc", p.field.doc);
    number_field("min", p.field.range.min);
    number_field("max", p.field.range.max);
    lua_getfield(L, -1, "int");
    p.whole = lua_toboolean(L, -1);
    lua_pop(L, 1);
    if (lua_getfield(L, -1, "choices") == LUA_TTABLE) {
      for (lua_Integer i = 1; i <= length_of(L, -1); ++i) {
        lua_rawgeti(L, -1, i);
        p.field.choices.push_back(lua_tostring(L, -1) ? lua_tostring(L, -1) : "");
        lua_pop(L, 1);
      }
    }
    lua_pop(L, 1);
    lua_rawgeti(L, -1, 1);
    lua_remove(L, -2);
  }
  switch (lua_type(L, -1)) {
    case LUA_TNUMBER:
      p.kind = Parameter::Kind::number;
      break;
    case LUA_TBOOLEAN:
      p.kind = Parameter::Kind::boolean;
      break;
    case LUA_TSTRING:
      p.kind = Parameter::Kind::string;
      break;
    case LUA_TTABLE:
      p.kind = Parameter::Kind::numbers;
      for (lua_Integer i = 1; i <= length_of(L, -1); ++i) {
        if (lua_rawgeti(L, -1, i) != LUA_TNUMBER) wrong("a list as default must hold numbers");
        lua_pop(L, 1);
      }
      break;
    default:
      wrong("needs a default: a number, a string, true, false, or a list of numbers");
  }
  p.initial = text_of(L, -1);
  const auto sound = [&](int index) {
    const double value = lua_tonumber(L, index);
    if (!std::isfinite(value)) wrong("the default must be finite");
    if (p.whole && value != std::floor(value))
      wrong(fmt::format("the default {} is no whole number, but int = true", p.initial));
    if (!p.field.range.contains(value))
      wrong(fmt::format("the default {} is outside its own range,{}", p.initial, range_of(p)));
  };
  if (p.kind == Parameter::Kind::number) sound(-1);
  if (p.kind == Parameter::Kind::numbers)
    for (lua_Integer i = 1; i <= length_of(L, -1); ++i) {
      lua_rawgeti(L, -1, i);
      sound(-1);
      lua_pop(L, 1);
    }
  if (p.kind == Parameter::Kind::string && !p.field.choices.empty() &&
      std::find(p.field.choices.begin(), p.field.choices.end(), p.initial) == p.field.choices.end())
    wrong(fmt::format("the default '{}' is none of its own choices", p.initial));
  return p;
}

// A misspelt p.name is an error, not nil: nil would mean the default of whatever field it is given to.
int unknown_parameter(lua_State* L) {
  std::vector<std::string> names;
  for (lua_pushnil(L); lua_next(L, 1) != 0; lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING)
      names.push_back(lua_tostring(L, -2));  // a conversion of the key would lead lua_next astray
  throw unknown_name(L, "the table of parameters", lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : shown(L, 2),
                     names);
}

int parameters(lua_State* L) {
  Session& session = session_of(L);
  if (!lua_istable(L, 1)) throw Error(report(session, call_site(L), {{{}, "takes one table of parameters"}}));
  if (session.parameters_declared)
    throw Error(report(session, call_site(L), {{{}, "is called twice; declare all parameters in one table"}}));
  session.parameters_declared = true;
  make_plain(L, 1);
  std::vector<std::string> names;
  for (lua_pushnil(L); lua_next(L, 1) != 0; lua_pop(L, 1)) {
    if (lua_type(L, -2) != LUA_TSTRING)
      throw Error(report(session, call_site(L), {{{}, "takes named parameters only"}}));
    names.push_back(lua_tostring(L, -2));
    constexpr std::size_t most = 1000;
    if (names.size() > most)
      throw Error(report(
          session, call_site(L),
          {{{},
            fmt::format("takes at most {} parameters; read long lists from a file with ricochet.file.read", most)}}));
  }
  std::sort(names.begin(), names.end());
  const std::vector<Given> given = given_arguments(session);
  lua_newtable(L);
  const int values = lua_gettop(L);
  std::string help;
  for (const std::string& name : names) {
    lua_getfield(L, 1, name.c_str());
    const Parameter p = declared(L, name);
    for (const Given& argument : given)
      if (argument.name == name) {
        lua_pop(L, 1);
        push_given(L, p, argument.value);
      }
    lua_setfield(L, values, name.c_str());
    help += fmt::format("  {:<22} {}{}{}\n", fmt::format("{}={}", name, p.initial),
                        p.field.unit.empty() ? "" : "[" + p.field.unit + "] ", p.field.doc,
                        range_of(p).empty() ? "" : "; " + range_of(p).substr(1));
  }
  if (session.options.help) {
    session.print(fmt::format("Parameters of {} (name=default):\n{}", session.script.string(), help));
    session.done = true;
    throw Error("the script was only asked for its parameters");
  }
  for (const Given& argument : given)
    if (std::find(names.begin(), names.end(), argument.name) == names.end())
      throw Error(fmt::format("unknown parameter '{}'{}\n  parameters of {}:\n{}", argument.name,
                              did_you_mean(argument.name, names), session.script.string(), help));
  session.refuse_earlier_results(session.own_folder());
  lua_settop(L, values);
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, guarded<unknown_parameter>);
  lua_setfield(L, -2, "__index");
  lua_pushboolean(L, false);
  lua_setfield(L, -2, "__metatable");
  lua_setmetatable(L, values);
  return 1;
}

}  // namespace

void refuse_unused_arguments(const Session& session) {
  if (!session.arguments.empty())
    throw Error(fmt::format("{} declares no parameters, but was given '{}'", session.script.string(),
                            session.arguments.front()));
}

void add_parameters(lua_State* L) {
  lua_pushcfunction(L, guarded<parameters>);
  lua_setfield(L, -2, "parameters");
}

}  // namespace ricochet
