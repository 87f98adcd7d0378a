// ricochet.parameters: what a user may set on the command line.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "core/spelling.hpp"
#include "script/objects.hpp"
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
  if (!parse_number(text, value))
    wrong((p.whole ? "a whole number" : "a number") + unit +
          (text.find(',') == std::string::npos ? "" : ", with a point before its decimals"));
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
        const std::string element = text.substr(start, comma - start);
        if (start > 0 && element.size() > 1 && element[0] == '0' &&
            std::isdigit(static_cast<unsigned char>(element[1])))
          throw Error(
              fmt::format("parameter '{}' is a list, in which '{}' has a number of its own after the comma; write "
                          "decimals with a point",
                          p.field.name, text));
        push_number(L, p, element);
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
    each_element(L, index, [&](lua_Integer i) { text += (i > 1 ? "," : "") + text_of(L, -1); });  // of numbers
    return text;
  }
  if (lua_type(L, index) == LUA_TNUMBER)
    return lua_isinteger(L, index) ? fmt::format("{}", lua_tointeger(L, index))
                                   : fmt::format("{}", lua_tonumber(L, index));
  return lua_tostring(L, index);
}

[[noreturn]] void refuse(lua_State* L, const std::string& name, const std::string& message) {
  throw Error(report(session_of(L), call_site(L), {{{name}, fmt::format("'{}': {}", name, message)}}));
}

// The keys of a declaration, which is on top of the stack.
void check_keys(lua_State* L, const std::string& name) {
  static const std::vector<std::string> known{"choices", "doc", "int", "max", "min", "unit"};
  for (lua_pushnil(L); lua_next(L, -2) != 0; lua_pop(L, 1)) {
    if (lua_type(L, -2) == LUA_TNUMBER && lua_tointeger(L, -2) == 1) continue;
    if (lua_type(L, -2) != LUA_TSTRING)
      refuse(L, name, "takes the default first, then named fields; a list of numbers as default needs its own braces");
    const std::string key = lua_tostring(L, -2);
    if (std::find(known.begin(), known.end(), key) == known.end())
      refuse(L, name, fmt::format("unknown field '{}'{}", key, did_you_mean(key, known)));
  }
}

// Reads a text, or a number, of a declaration; keeps the value if there is none.
void read_value(lua_State* L, const std::string& name, const char* key, std::string& value) {
  if (lua_getfield(L, -1, key) == LUA_TSTRING)
    value = lua_tostring(L, -1);
  else if (!lua_isnil(L, -1))
    refuse(L, name, fmt::format("{} must be a string", key));
  lua_pop(L, 1);
}

void read_value(lua_State* L, const std::string& name, const char* key, double& value) {
  if (lua_getfield(L, -1, key) == LUA_TNUMBER)
    value = lua_tonumber(L, -1);
  else if (!lua_isnil(L, -1))
    refuse(L, name, fmt::format("{} must be a number", key));
  lua_pop(L, 1);
}

// Reads a declaration in the form of a table, on top of the stack; leaves its default in its place.
void read_declaration(lua_State* L, Parameter& p) {
  const std::string& name = p.field.name;
  check_keys(L, name);
  read_value(L, name, "unit", p.field.unit);
  read_value(L, name, "doc", p.field.doc);
  read_value(L, name, "min", p.field.range.min);
  read_value(L, name, "max", p.field.range.max);
  lua_getfield(L, -1, "int");
  p.whole = lua_toboolean(L, -1);
  lua_pop(L, 1);
  each_in_field(L, -1, "choices",
                [&](lua_Integer) { p.field.choices.push_back(lua_tostring(L, -1) ? lua_tostring(L, -1) : ""); });
  lua_rawgeti(L, -1, 1);
  lua_remove(L, -2);
}

// The kind of the default on top of the stack.
Parameter::Kind kind_of_default(lua_State* L, const std::string& name) {
  switch (lua_type(L, -1)) {
    case LUA_TNUMBER:
      return Parameter::Kind::number;
    case LUA_TBOOLEAN:
      return Parameter::Kind::boolean;
    case LUA_TSTRING:
      return Parameter::Kind::string;
    case LUA_TTABLE:
      each_element(L, -1, [&](lua_Integer) {
        if (lua_type(L, -1) != LUA_TNUMBER) refuse(L, name, "a list as default must hold numbers");
      });
      return Parameter::Kind::numbers;
    default:
      refuse(L, name, "needs a default: a number, a string, true, false, or a list of numbers");
  }
}

// Of a default, or an element of one.
void check_number(lua_State* L, const Parameter& p, double value) {
  const std::string& name = p.field.name;
  if (!std::isfinite(value)) refuse(L, name, "the default must be finite");
  if (p.whole && value != std::floor(value))
    refuse(L, name, fmt::format("the default {} is no whole number, but int = true", p.initial));
  if (!p.field.range.contains(value))
    refuse(L, name, fmt::format("the default {} is outside its own range,{}", p.initial, range_of(p)));
}

// The default, on top of the stack, must be one of the values that the parameter takes.
void check_default(lua_State* L, const Parameter& p) {
  if (p.kind == Parameter::Kind::number) check_number(L, p, lua_tonumber(L, -1));
  if (p.kind == Parameter::Kind::numbers)
    for (const double value : numbers_at(L, -1)) check_number(L, p, value);
  const std::vector<std::string>& choices = p.field.choices;
  if (p.kind == Parameter::Kind::string && !choices.empty() &&
      std::find(choices.begin(), choices.end(), p.initial) == choices.end())
    refuse(L, p.field.name, fmt::format("the default '{}' is none of its own choices", p.initial));
}

// Reads a declaration (value at the top of the stack: a default, or a table with the default first); leaves the default
// there.
Parameter declared(lua_State* L, const std::string& name) {
  Parameter p{};
  p.field.name = name;
  if (lua_istable(L, -1)) read_declaration(L, p);
  p.kind = kind_of_default(L, name);
  p.initial = text_of(L, -1);
  check_default(L, p);
  return p;
}

// A misspelt p.name is an error, not nil: nil would mean the default of whatever field it is given to.
int unknown_parameter(lua_State* L) {
  throw unknown_name(L, "the table of parameters", asked_name(L, 2), names_in(L, 1));
}

// The names that are declared, in order.
std::vector<std::string> declared_names(lua_State* L) {
  if (!lua_istable(L, 1)) throw at_this_call(L, "takes one table of parameters");
  Session& session = session_of(L);
  if (session.parameters_declared) throw at_this_call(L, "is called twice; declare all parameters in one table");
  session.parameters_declared = true;
  make_plain(L, 1);
  std::vector<std::string> names;
  for (lua_pushnil(L); lua_next(L, 1) != 0; lua_pop(L, 1)) {
    if (lua_type(L, -2) != LUA_TSTRING) throw at_this_call(L, "takes named parameters only");
    names.push_back(lua_tostring(L, -2));
    constexpr std::size_t most = 1000;
    if (names.size() > most)
      throw at_this_call(
          L, fmt::format("takes at most {} parameters; read long lists from a file with ricochet.file.read", most));
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string help_line(const Parameter& p) {
  const std::string range = range_of(p);
  return fmt::format("  {:<22} {}{}{}\n", fmt::format("{}={}", p.field.name, p.initial),
                     p.field.unit.empty() ? "" : "[" + p.field.unit + "] ", p.field.doc,
                     range.empty() ? "" : "; " + range.substr(1));
}

void refuse_unknown_arguments(const Session& session, const std::vector<Given>& given,
                              const std::vector<std::string>& names, const std::string& help) {
  for (const Given& argument : given)
    if (std::find(names.begin(), names.end(), argument.name) == names.end())
      throw Error(fmt::format("unknown parameter '{}'{}\n  parameters of {}:\n{}", argument.name,
                              did_you_mean(argument.name, names), session.script.string(), help));
}

int parameters(lua_State* L) {
  const std::vector<std::string> names = declared_names(L);
  Session& session = session_of(L);
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
    help += help_line(p);
  }
  if (session.options.help) {
    session.print(fmt::format("Parameters of {} (name=default):\n{}", session.script.string(), help));
    session.done = true;
    throw Error("the script was only asked for its parameters");
  }
  refuse_unknown_arguments(session, given, names, help);
  session.folders.refuse_earlier(session.own_folder());
  lua_settop(L, values);
  lua_createtable(L, 0, 2);
  close_metatable(L, guarded<unknown_parameter>);
  lua_setmetatable(L, values);
  return 1;
}

}  // namespace

void refuse_unused_arguments(const Session& session) {
  if (!session.arguments.empty())
    throw Error(fmt::format("{} declares no parameters, but was given '{}'", session.script.string(),
                            session.arguments.front()));
}

Group parameter_functions() {
  return {.functions = {
              {.name = "parameters",
               .doc = "Declares what a user may set on the command line as `name=value` and reads it. Each parameter "
                      "is a default, or a table with the default "
                      "first and any of unit, doc, min, max, int, choices. Returns the values.",
               .returns = "table",
               .example =
                   "local p = ricochet.parameters { speed = { 0.1, unit = \"c\", min = 0, doc = \"impact speed\" } }",
               .call = guarded<parameters>}}};
}

}  // namespace ricochet
