#include "script/value_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/spelling.hpp"
#include "script/functions.hpp"
#include "script/lua_values.hpp"
#include "script/report.hpp"

namespace ricochet {
namespace {

/// A value on the stack that is held against a field.
struct Value {
  lua_State* L;
  int index;
  const Field& field;

  std::string must_be(const std::string& what) const {
    return fmt::format("'{}' must be {}, is {}", field.name, what, shown(L, index));
  }
  /// Empty if it is what it must be.
  std::string unless(bool good, const std::string& what) const { return good ? "" : must_be(what); }
  int type() const { return lua_type(L, index); }
};

// Of a number that must be within the field's range.
std::string range_mistake(const Value& value) {
  const double number = lua_tonumber(value.L, value.index);
  if (!std::isfinite(number)) return value.must_be("a finite number");
  return value.unless(value.field.range.contains(number), accepted_range(value.field));
}

std::string number_mistake(const Value& value) {
  if (value.type() == LUA_TNUMBER) return range_mistake(value);
  return value.must_be("a number" + (value.field.unit.empty() ? "" : " [" + value.field.unit + "]"));
}

std::string integer_mistake(const Value& value) {
  if (value.type() != LUA_TNUMBER) return value.must_be("a whole number");
  const double number = lua_tonumber(value.L, value.index);
  if (std::isfinite(number) && number != std::floor(number)) return value.must_be("a whole number");
  return range_mistake(value);
}

std::string number_or_function_mistake(const Value& value) {
  if (value.type() == LUA_TNUMBER) return range_mistake(value);
  return value.unless(value.type() == LUA_TFUNCTION, "a number or a function (x, y)");
}

std::string boolean_mistake(const Value& value) { return value.unless(value.type() == LUA_TBOOLEAN, "true or false"); }

std::string function_mistake(const Value& value) { return value.unless(value.type() == LUA_TFUNCTION, "a function"); }

std::string string_mistake(const Value& value) {
  if (value.type() != LUA_TSTRING) return value.must_be("a string");
  const Field& field = value.field;
  const std::string text = lua_tostring(value.L, value.index);
  if (text.size() != lua_rawlen(value.L, value.index))
    return fmt::format("'{}' holds a byte of 0 after '{:.40}'; names end there for the system", field.name, text);
  if (field.choices.empty() || std::find(field.choices.begin(), field.choices.end(), text) != field.choices.end())
    return "";
  return fmt::format("'{}' must be one of {}, is '{}'{}", field.name, joined(field.choices), text,
                     did_you_mean(text, field.choices));
}

std::string body_mistake(const Value& value) {
  return value.unless(is_object(value.L, value.index, "body"),
                      "a body (from ricochet.disk, ricochet.wall, ricochet.body or another shape)");
}

std::string material_mistake(const Value& value) {
  return value.unless(is_object(value.L, value.index, "material"),
                      "a material (ricochet.materials.steel, or from ricochet.material)");
}

std::string scene_mistake(const Value& value) {
  return value.unless(is_object(value.L, value.index, "scene"), "a scene (from ricochet.scene)");
}

std::string sweep_mistake(const Value& value) {
  return value.unless(lua_istable(value.L, value.index) && kind_name(value.L, value.index) == "sweep",
                      "a sweep (from ricochet.sweep)");
}

// Rows of a sweep, or a list of some of them.
std::string rows_mistake(const Value& value) {
  bool rows = lua_istable(value.L, value.index);
  if (const std::string name = kind_name(value.L, value.index); !name.empty()) {
    rows = rows && name == "rows";
  } else if (rows) {
    rows = lua_rawgeti(value.L, value.index, 1) == LUA_TTABLE;
    lua_pop(value.L, 1);
  }
  return value.unless(rows, "rows (from sweep:run())");
}

std::string table_mistake(const Value& value) { return value.unless(lua_istable(value.L, value.index), "a table"); }

// The mistake in a list that is not to be empty: the first of its elements, which `of_element` finds on top of the
// stack.
template <class OfElement>
std::string list_mistake(const Value& value, const std::string& what, OfElement of_element) {
  if (!lua_istable(value.L, value.index)) return value.must_be(what);
  const lua_Integer count = list_length(value.L, value.index);
  if (count == 0) return fmt::format("'{}' must not be empty", value.field.name);
  std::string mistake;
  for (lua_Integer i = 1; i <= count && mistake.empty(); ++i) {
    lua_rawgeti(value.L, value.index, i);
    mistake = of_element(i);
    lua_pop(value.L, 1);
  }
  return mistake;
}

std::string scenes_mistake(const Value& value) {
  return list_mistake(value, "a list of scenes { ricochet.scene {...}, ... }", [&](lua_Integer i) -> std::string {
    if (is_object(value.L, -1, "scene")) return "";
    return fmt::format("'{}' must be a list of scenes (from ricochet.scene); element {} is {}", value.field.name, i,
                       shown(value.L, -1));
  });
}

std::string tables_mistake(const Value& value) {
  return list_mistake(value, "a list of tables { { ... }, ... }", [&](lua_Integer i) -> std::string {
    if (lua_istable(value.L, -1)) return "";
    return fmt::format("'{}' must be a list of tables; element {} is {}", value.field.name, i, shown(value.L, -1));
  });
}

bool is_finite_number(lua_State* L, int index) {
  return lua_type(L, index) == LUA_TNUMBER && std::isfinite(lua_tonumber(L, index));
}

std::string element_mistake(const Value& value, const char* what, lua_Integer i, const std::string& found) {
  return fmt::format("'{}' must hold {}; element {} {}", value.field.name, what, i, found);
}

std::string strings_mistake(const Value& value) {
  return list_mistake(value, "a list of strings { \"...\", ... }", [&](lua_Integer i) -> std::string {
    if (lua_type(value.L, -1) == LUA_TSTRING) return "";
    return element_mistake(value, "only strings", i, "is " + shown(value.L, -1));
  });
}

std::string string_or_strings_mistake(const Value& value) {
  if (value.type() == LUA_TTABLE) return strings_mistake(value);
  return value.type() == LUA_TSTRING ? string_mistake(value) : value.must_be("a string or a list of strings");
}

std::string numbers_mistake(const Value& value) {
  return list_mistake(value, "a list of numbers { ... }", [&](lua_Integer i) -> std::string {
    if (is_finite_number(value.L, -1)) return "";
    return element_mistake(value, "only numbers", i, "is " + shown(value.L, -1));
  });
}

// What is wrong with the point on top of the stack; empty if nothing is.
std::string wrong_in_point(lua_State* L) {
  if (!lua_istable(L, -1)) return "is " + shown(L, -1);
  std::string wrong;
  for (const int axis : {1, 2}) {
    lua_rawgeti(L, -1, axis);
    if (wrong.empty() && !is_finite_number(L, -1))
      wrong = fmt::format("has {} = {}", axis == 1 ? "x" : "y", shown(L, -1));
    lua_pop(L, 1);
  }
  return wrong;
}

std::string points_mistake(const Value& value) {
  return list_mistake(value, "a list of points { {x, y}, ... }", [&](lua_Integer i) -> std::string {
    const std::string wrong = wrong_in_point(value.L);
    return wrong.empty() ? "" : element_mistake(value, "points {x, y} of finite numbers", i, wrong);
  });
}

std::string outlines_mistake(const Value& value) {
  const char* what = "a list of outlines { { {x, y}, ... }, ... }";
  return list_mistake(value, what, [&](lua_Integer i) -> std::string {
    Field outline = value.field;
    outline.name = fmt::format("{}[{}]", value.field.name, i);
    return points_mistake({value.L, lua_gettop(value.L), outline});
  });
}

// A list of effects may be empty, but holds nothing else, and no holes.
std::string effects_mistake(const Value& value) {
  lua_State* L = value.L;
  const char* what = "a list of effects, e.g. { ricochet.gravity { g = 1e-4 } }";
  if (!lua_istable(L, value.index)) return value.must_be(what);
  for (lua_pushnil(L); lua_next(L, value.index) != 0; lua_pop(L, 1)) {
    if (lua_type(L, -2) == LUA_TNUMBER && is_object(L, -1, "effect")) continue;
    std::string held = shown(L, -1);
    if (lua_type(L, -2) == LUA_TSTRING) held = fmt::format("{} = {}", lua_tostring(L, -2), held);
    lua_pop(L, 2);
    return fmt::format("'{}' must be {}, holds {}", value.field.name, what, held);
  }
  for (lua_Integer i = 1; i <= list_length(L, value.index); ++i) {
    const bool nothing = lua_rawgeti(L, value.index, i) == LUA_TNIL;
    lua_pop(L, 1);
    if (nothing) return fmt::format("'{}' has nothing (nil) at place {}; leave that place out", value.field.name, i);
  }
  return "";
}

struct Type {
  const char* name;
  const char* annotation;
  std::string (*mistake)(const Value& value);  ///< none of what is only returned
};

constexpr Type types[] = {
    {"number", "number", number_mistake},
    {"integer", "integer", integer_mistake},
    {"number|function", "number|fun(x: number, y: number): number", number_or_function_mistake},
    {"boolean", "boolean", boolean_mistake},
    {"string", "string", string_mistake},
    {"function", "function", function_mistake},
    {"table", "table", table_mistake},
    {"numbers", "number[]", numbers_mistake},
    {"strings", "string[]", strings_mistake},
    {"string or strings", "string|string[]", string_or_strings_mistake},
    {"points", "number[][]", points_mistake},
    {"outlines", "number[][][]", outlines_mistake},
    {"body", "ricochet.body", body_mistake},
    {"material", "ricochet.material", material_mistake},
    {"scene", "ricochet.scene", scene_mistake},
    {"scenes", "ricochet.scene[]", scenes_mistake},
    {"effect", "ricochet.effect", nullptr},
    {"effects", "ricochet.effect[]", effects_mistake},
    {"sweep", "ricochet.sweep", sweep_mistake},
    {"rows", "ricochet.rows", rows_mistake},
    {"summary", "ricochet.summary", nullptr},
    {"plan", "ricochet.plan", nullptr},
};

const Type* type_named(const std::string& name) {
  const auto found = std::find_if(std::begin(types), std::end(types), [&](const Type& t) { return t.name == name; });
  return found == std::end(types) ? nullptr : &*found;
}

}  // namespace

std::string mistake_in(lua_State* L, int index, const Field& field) {
  const Value value{L, lua_absindex(L, index), field};
  if (inner_table(field.type)) return table_mistake(value);
  if (element_table(field.type)) return tables_mistake(value);
  const Type* type = type_named(field.type);
  if (!type || !type->mistake) throw std::logic_error("no field can have the type " + field.type);
  return type->mistake(value);
}

std::string annotation_of(const std::string& type) {
  if (inner_table(type)) return "ricochet." + type + "_fields";
  if (element_table(type)) return "ricochet." + type.substr(0, type.size() - 2) + "_fields[]";
  const Type* known = type_named(type);
  return known ? known->annotation : type;
}

std::string accepted_range(const Field& field) {
  const Range& r = field.range;
  const bool low = r.min > any_number.min, high = r.max < any_number.max;
  const std::string unit = field.unit.empty() ? "" : " " + field.unit;
  if (low && high) return fmt::format("between {:g} and {:g}{}", r.min, r.max, unit);
  if (low) return fmt::format("{} {:g}{}", r.min_open ? "greater than" : "at least", r.min, unit);
  return fmt::format("{} {:g}{}", r.max_open ? "less than" : "at most", r.max, unit);
}

}  // namespace ricochet
