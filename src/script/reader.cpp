#include "script/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/spelling.hpp"

namespace ricochet {
namespace {

std::vector<std::string> names_of(const std::vector<Field>& fields) {
  std::vector<std::string> names;
  for (const Field& f : fields) names.push_back(f.name);
  std::sort(names.begin(), names.end());
  return names;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

std::string accepted_range(const Field& field) {
  const Range& r = field.range;
  const bool low = r.min > any_number.min, high = r.max < any_number.max;
  const std::string unit = field.unit.empty() ? "" : " " + field.unit;
  if (low && high) return fmt::format("between {:g} and {:g}{}", r.min, r.max, unit);
  if (low) return fmt::format("{} {:g}{}", r.min_open ? "greater than" : "at least", r.min, unit);
  return fmt::format("{} {:g}{}", r.max_open ? "less than" : "at most", r.max, unit);
}

namespace {

bool is_userdata(lua_State* L, int index, const char* type) {
  return luaL_testudata(L, index, ("ricochet." + std::string(type)).c_str()) != nullptr;
}

// Rows of a sweep, or a list of some of them.
bool is_rows(lua_State* L, int index) {
  if (!lua_istable(L, index)) return false;
  if (luaL_getmetafield(L, index, "__name") == LUA_TSTRING) {
    const bool rows = std::string(lua_tostring(L, -1)) == "rows";
    lua_pop(L, 1);
    return rows;
  }
  const bool list = lua_rawgeti(L, index, 1) == LUA_TTABLE;
  lua_pop(L, 1);
  return list;
}

// The mistake in a value, or nothing.
std::string mistake_in(lua_State* L, int index, const Field& field) {
  const std::string& type = field.type;
  const auto must_be = [&](const std::string& what) {
    return fmt::format("'{}' must be {}, is {}", field.name, what, shown(L, index));
  };
  if ((type == "number" || type == "integer" || type == "number|function") && lua_type(L, index) == LUA_TNUMBER) {
    const double value = lua_tonumber(L, index);
    if (!std::isfinite(value)) return must_be("a finite number");
    if (type == "integer" && !lua_isinteger(L, index) && value != std::floor(value)) return must_be("a whole number");
    if (!field.range.contains(value)) return must_be(accepted_range(field));
    return "";
  }
  if (type == "number") return must_be("a number" + (field.unit.empty() ? "" : " [" + field.unit + "]"));
  if (type == "integer") return must_be("a whole number");
  if (type == "number|function") return lua_isfunction(L, index) ? "" : must_be("a number or a function (x, y)");
  if (type == "boolean") return lua_isboolean(L, index) ? "" : must_be("true or false");
  if (type == "string") {
    if (lua_type(L, index) != LUA_TSTRING) return must_be("a string");
    const std::string text = lua_tostring(L, index);
    if (text.size() != lua_rawlen(L, index))
      return fmt::format("'{}' holds a byte of 0 after '{:.40}'; names end there for the system", field.name, text);
    if (!field.choices.empty() && std::find(field.choices.begin(), field.choices.end(), text) == field.choices.end())
      return fmt::format("'{}' must be one of {}, is '{}'{}", field.name, joined(field.choices), text,
                         did_you_mean(text, field.choices));
    return "";
  }
  if (type == "function") return lua_isfunction(L, index) ? "" : must_be("a function");
  if (type == "body" || type == "scene") {
    const char* makers = type == "body" ? "a body (from ricochet.disk, ricochet.wall or ricochet.body)"
                                        : "a scene (from ricochet.scene)";
    return is_userdata(L, index, type.c_str()) ? "" : must_be(makers);
  }
  if (type == "sweep") {
    const bool sweep = lua_istable(L, index) && luaL_getmetafield(L, index, "__name") == LUA_TSTRING;
    const bool good = sweep && std::string(lua_tostring(L, -1)) == "sweep";
    if (sweep) lua_pop(L, 1);
    return good ? "" : must_be("a sweep (from ricochet.sweep)");
  }
  if (type == "rows") return is_rows(L, index) ? "" : must_be("rows (from sweep:run())");
  if (!lua_istable(L, index))
    return must_be(type == "scenes"    ? "a list of scenes { ricochet.scene {...}, ... }"
                   : type == "effects" ? "a list of effects, e.g. { ricochet.gravity { g = 1e-4 } }"
                   : type == "points"  ? "a list of points { {x, y}, ... }"
                   : type == "strings" ? "a list of strings { \"...\", ... }"
                   : type == "numbers" ? "a list of numbers { ... }"
                                       : "a table");
  if (type == "scenes") {
    const lua_Integer n = length_of(L, index);
    for (lua_Integer i = 1; i <= n; ++i) {
      lua_rawgeti(L, index, i);
      const std::string found = is_userdata(L, -1, "scene") ? "" : shown(L, -1);
      lua_pop(L, 1);
      if (!found.empty())
        return fmt::format("'{}' must be a list of scenes (from ricochet.scene); element {} is {}", field.name, i,
                           found);
    }
    return n == 0 ? fmt::format("'{}' must not be empty", field.name) : "";
  }
  if (type == "effects") {
    for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
      if (lua_type(L, -2) == LUA_TNUMBER && is_userdata(L, -1, "effect")) continue;
      const std::string what =
          lua_type(L, -2) == LUA_TSTRING ? fmt::format("{} = {}", lua_tostring(L, -2), shown(L, -1)) : shown(L, -1);
      lua_pop(L, 2);
      return fmt::format("'{}' must be a list of effects, e.g. {{ ricochet.gravity {{ g = 1e-4 }} }}, holds {}",
                         field.name, what);
    }
    for (lua_Integer i = 1; i <= length_of(L, index); ++i) {
      const bool nothing = lua_rawgeti(L, index, i) == LUA_TNIL;
      lua_pop(L, 1);
      if (nothing) return fmt::format("'{}' has nothing (nil) at place {}; leave that place out", field.name, i);
    }
    return "";
  }
  if (type == "numbers" || type == "strings" || type == "points") {
    const lua_Integer n = length_of(L, index);
    if (n == 0) return fmt::format("'{}' must not be empty", field.name);
    for (lua_Integer i = 1; i <= n; ++i) {
      lua_rawgeti(L, index, i);
      bool good = type == "strings"   ? lua_type(L, -1) == LUA_TSTRING
                  : type == "numbers" ? lua_type(L, -1) == LUA_TNUMBER && std::isfinite(lua_tonumber(L, -1))
                                      : lua_istable(L, -1);
      std::string found = "is " + shown(L, -1);
      if (good && type == "points") {
        for (int axis : {1, 2}) {
          lua_rawgeti(L, -1, axis);
          if (good && !(lua_type(L, -1) == LUA_TNUMBER && std::isfinite(lua_tonumber(L, -1)))) {
            good = false;
            found = fmt::format("has {} = {}", axis == 1 ? "x" : "y", shown(L, -1));
          }
          lua_pop(L, 1);
        }
      }
      const std::string element =
          good ? ""
               : fmt::format("'{}' must hold {}; element {} {}", field.name,
                             type == "points" ? "points {x, y} of finite numbers" : "only " + type, i, found);
      lua_pop(L, 1);
      if (!good) return element;
    }
  }
  return "";
}

// A table of named fields inside another, specified like a function of its own.
bool is_table_type(const std::string& type) { return type == "launch" || type == "contact" || type == "show"; }

bool has_field(const std::vector<Field>& fields, const std::string& name) {
  return std::any_of(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
}

// Where an unknown field belongs: in a table inside this one, or in the scene around it; else the nearest spelling.
std::string belongs_elsewhere(const std::string& name, const std::vector<Field>& fields,
                              const std::vector<std::string>& path, const std::string& nearest) {
  for (const Field& field : fields)
    if (is_table_type(field.type) && has_field(function_named(field.type).fields, name))
      return fmt::format(" (it belongs in {} = {{ {} = ... }})", field.name, name);
  if (nearest.empty() && has_field(fields, "over"))
    return fmt::format(" (what varies belongs in over = {{ {} = {{ ... }} }})", name);
  if (!path.empty() && path.back() != "show" && has_field(function_named("scene").fields, name))
    return " (it belongs in the scene itself, beside this table)";
  return nearest;
}

void collect(lua_State* L, int index, const std::vector<Field>& fields, const std::vector<std::string>& path,
             std::vector<Mistake>& mistakes, std::string& valid) {
  index = lua_absindex(L, index);
  const std::vector<std::string> names = names_of(fields);
  const auto below = [&](const std::string& name) {
    std::vector<std::string> full = path;
    full.push_back(name);
    return full;
  };
  const std::string where = path.empty() ? "" : path.back() + ": ";
  constexpr std::size_t most_shown = 20;
  std::vector<std::string> unknown;
  std::size_t nameless = 0;
  for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
    if (lua_type(L, -2) != LUA_TSTRING) {
      if (nameless++ < most_shown)
        mistakes.push_back(
            {path, fmt::format("{}takes named fields only, has the value {} without a name", where, shown(L, -1))});
      continue;
    }
    const std::string name = lua_tostring(L, -2);
    if (std::find(names.begin(), names.end(), name) == names.end()) unknown.push_back(name);
  }
  std::sort(unknown.begin(), unknown.end());
  for (std::size_t i = 0; i < std::min(unknown.size(), most_shown); ++i)
    mistakes.push_back(
        {below(unknown[i]), fmt::format("{}unknown field '{}'{}", where, unknown[i],
                                        belongs_elsewhere(unknown[i], fields, path, did_you_mean(unknown[i], names)))});
  if (unknown.size() > most_shown)
    mistakes.push_back({path, fmt::format("{}and {} more unknown fields", where, unknown.size() - most_shown)});
  if (!unknown.empty()) valid = joined(names);
  for (const Field& field : fields) {
    lua_getfield(L, index, field.name.c_str());
    if (lua_isnil(L, -1)) {
      if (field.initial.empty() && !field.optional)
        mistakes.push_back({path, fmt::format("{}'{}' is missing: {}", where, field.name, field.doc)});
    } else if (const std::string mistake = mistake_in(L, lua_gettop(L), field); !mistake.empty()) {
      mistakes.push_back({below(field.name), where + mistake});
    } else if (is_table_type(field.type)) {
      collect(L, -1, function_named(field.type).fields, below(field.name), mistakes, valid);
    }
    lua_pop(L, 1);
  }
}

// Pushes a plain copy of a value: tables without their metatables, the same ones once (`copies`, at an absolute index,
// remembers them), all else as it is. Of an object's kind its name stays, for messages.
void push_plain(lua_State* L, int index, int copies, int depth = 0) {
  constexpr int deepest = 100;
  if (depth > deepest)
    throw at_line(L, fmt::format("a table holds tables that hold tables, more than {} deep", deepest));
  index = lua_absindex(L, index);
  luaL_checkstack(L, 8, "tables in tables");
  lua_pushvalue(L, index);
  if (!lua_istable(L, index)) return;
  if (lua_rawget(L, copies) != LUA_TNIL) return;
  lua_pop(L, 1);
  // A list with a hole in it stays as long as it is. (A table that is no list may have any length.)
  constexpr lua_Unsigned longest_list = 10'000'000;
  const lua_Unsigned length = lua_rawlen(L, index);
  lua_createtable(L, length <= longest_list ? static_cast<int>(length) : 0, 0);
  const int copy = lua_gettop(L);
  lua_pushvalue(L, index);
  lua_pushvalue(L, copy);
  lua_rawset(L, copies);
  for (lua_pushnil(L); lua_next(L, index) != 0;) {
    lua_pushvalue(L, -2);
    push_plain(L, -2, copies, depth + 1);
    lua_rawset(L, copy);
    lua_pop(L, 1);
  }
  if (luaL_getmetafield(L, index, "__name") == LUA_TSTRING) {
    lua_createtable(L, 0, 1);
    lua_insert(L, -2);
    lua_setfield(L, -2, "__name");
    lua_setmetatable(L, copy);
  } else if (lua_gettop(L) > copy) {
    lua_pop(L, 1);
  }
}

// The same of a table of named fields. Fields that a metatable has for it (a table of defaults, say) are asked for,
// once.
void push_plain_fields(lua_State* L, int index, const std::vector<Field>& fields, int copies) {
  index = lua_absindex(L, index);
  lua_newtable(L);
  const int copy = lua_gettop(L);
  const auto put = [&](int key, int value, const Field* field) {
    value = lua_absindex(L, value);
    lua_pushvalue(L, key);
    if (field && (field->type == "sweep" || field->type == "rows"))
      lua_pushvalue(L, value);  // long, and read with care
    else if (field && is_table_type(field->type) && lua_istable(L, value))
      push_plain_fields(L, value, function_named(field->type).fields, copies);
    else
      push_plain(L, value, copies);
    lua_rawset(L, copy);
  };
  const auto field_named = [&](const char* name) {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
    return found == fields.end() ? nullptr : &*found;
  };
  for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1))
    put(lua_absindex(L, -2), -1, lua_type(L, -2) == LUA_TSTRING ? field_named(lua_tostring(L, -2)) : nullptr);
  if (!lua_getmetatable(L, index)) return;
  lua_pop(L, 1);
  for (const Field& field : fields) {
    lua_pushstring(L, field.name.c_str());
    lua_pushvalue(L, -1);
    if (lua_rawget(L, copy) == LUA_TNIL) {
      lua_pop(L, 1);
      lua_getfield(L, index, field.name.c_str());
      if (!lua_isnil(L, -1)) put(lua_absindex(L, -2), -1, &field);
    }
    lua_pop(L, 2);
  }
}

}  // namespace

void make_plain(lua_State* L, int index) {
  index = lua_absindex(L, index);
  lua_newtable(L);
  push_plain(L, index, lua_gettop(L));
  lua_replace(L, index);
  lua_pop(L, 1);
}

Session& session_of(lua_State* L) { return **static_cast<Session**>(lua_getextraspace(L)); }

CallSite call_site(lua_State* L) {
  constexpr int most_levels = 1000;  // each costs as many steps as it is deep
  const Session& session = session_of(L);
  CallSite site;
  lua_Debug frame;
  for (int level = 0; level < most_levels && lua_getstack(L, level, &frame); ++level) {
    lua_getinfo(L, "Sl", &frame);
    const std::string source = frame.source[0] == '@' ? frame.source + 1 : "";
    if (frame.currentline <= 0 || source.starts_with(session.library.string())) {
      // Called through pcall, a function has no name here: that of the one it called will do.
      lua_getinfo(L, "n", &frame);
      const std::string name = frame.name ? frame.name : "";
      if (!name.empty() && name != "pcall" && name != "xpcall" && name != "fail") site.function = name;
      continue;
    }
    if (source.empty()) continue;  // text that was loaded: the line that calls it
    site.file = source;
    site.line = frame.currentline;
    return site;
  }
  return site;
}

std::string report(const Session& session, const CallSite& site, const std::vector<Mistake>& mistakes,
                   const std::string& valid) {
  const auto text = session.sources.find(site.file);
  std::string result;
  for (const Mistake& mistake : mistakes) {
    Place place{site.line, 1, 0};
    if (text != session.sources.end()) {
      // A field that is not written there (the table was made elsewhere) is reported at the call.
      for (std::vector<std::string> path = mistake.path; !path.empty(); path.pop_back())
        if (const auto found = find_field(text->second, site.line, site.function, path)) {
          place = *found;
          break;
        }
    }
    if (!result.empty()) result += "error: ";
    if (!site.file.empty()) result += fmt::format("{}:{}: ", site.file, place.line);
    if (!site.function.empty()) result += site.function + ": ";
    result += mistake.message + "\n";
    if (text != session.sources.end()) result += excerpt(text->second, place);
  }
  if (!valid.empty()) result += "  valid fields: " + valid + "\n";
  result.pop_back();
  return result;
}

bool is_module(lua_State* L, int index) {
  lua_getfield(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  lua_getfield(L, -1, "ricochet");
  const bool same = lua_rawequal(L, index, -1);
  lua_pop(L, 2);
  return same;
}

void check_table(lua_State* L, int index, const Function& function, bool ours) {
  CallSite site = call_site(L);
  const Session& session = session_of(L);
  if (site.function.empty() || site.function == "check") site.function = function.name;
  if (!lua_istable(L, index))
    throw Error(
        report(session, site, {{{}, fmt::format("takes one table of named fields, e.g. {}", function.example)}}));
  if (is_module(L, index))
    throw Error(report(session, site,
                       {{{}, fmt::format("is called with a dot, not a colon: ricochet.{} {{ ... }}", function.name)}}));
  if (!ours) {
    index = lua_absindex(L, index);
    lua_newtable(L);
    push_plain_fields(L, index, function.fields, lua_gettop(L));
    lua_replace(L, index);
    lua_pop(L, 1);
  }
  std::vector<Mistake> mistakes;
  std::string valid;
  collect(L, index, function.fields, {}, mistakes, valid);
  if (!mistakes.empty()) throw Error(report(session, site, mistakes, valid));
}

std::string shown(lua_State* L, int index) {
  switch (lua_type(L, index)) {
    case LUA_TNIL:
      return "nil";
    case LUA_TBOOLEAN:
      return lua_toboolean(L, index) ? "true" : "false";
    case LUA_TNUMBER:
      return lua_isinteger(L, index)
                 ? fmt::format("{}", lua_tointeger(L, index))
                 : (lua_tonumber(L, index) != lua_tonumber(L, index) ? "nan"
                                                                     : fmt::format("{}", lua_tonumber(L, index)));
    case LUA_TSTRING:
      return fmt::format("a string ('{:.40}')", lua_tostring(L, index));
    case LUA_TUSERDATA:
      return luaL_getmetafield(L, index, "__name") == LUA_TSTRING
                 ? (lua_pop(L, 1), std::string(is_userdata(L, index, "body")     ? "a body"
                                               : is_userdata(L, index, "effect") ? "an effect"
                                                                                 : "a scene"))
                 : "an object";
    default:
      if (luaL_getmetafield(L, index, "__name") == LUA_TSTRING) {
        const std::string name = lua_tostring(L, -1);
        lua_pop(L, 1);
        return name == "sweep" ? "a sweep; run it first" : name;
      }
      return fmt::format("a {}", luaL_typename(L, index));
  }
}

Error at_line(lua_State* L, const std::string& message) {
  const CallSite site = call_site(L);
  const Session& session = session_of(L);
  const auto text = session.sources.find(site.file);
  std::string shown =
      fmt::format("{}\n{}", site.file.empty() ? message : fmt::format("{}:{}: {}", site.file, site.line, message),
                  text == session.sources.end() ? "" : excerpt(text->second, {site.line, 1, 0}));
  shown.pop_back();
  return Error(shown);
}

Error unknown_name(lua_State* L, const std::string& what, const std::string& name, std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  const std::string nearest = did_you_mean(name, names);
  return at_line(L, fmt::format("{} has no '{}'{}", what, name,
                                nearest.empty() ? (names.empty() ? "" : "; it has " + joined(names)) : nearest));
}

void throw_at(const Session& session, const CallSite& site, const FieldError& error) {
  Mistake mistake{{error.field}, fmt::format("'{}': {}", error.field, error.what())};
  const auto text = session.sources.find(site.file);
  for (const char* table : {"launch", "contact", "show"})
    if (text != session.sources.end() && find_field(text->second, site.line, site.function, {table, error.field}))
      mistake.path = {table, error.field};
  throw Error(report(session, site, {mistake}));
}

}  // namespace ricochet
