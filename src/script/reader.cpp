#include "script/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/spelling.hpp"
#include "script/objects.hpp"
#include "script/value_types.hpp"

namespace ricochet {
namespace {

bool names_field(const std::vector<Field>& fields, const std::string& name) {
  return std::any_of(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
}

std::vector<std::string> names_of(const std::vector<Field>& fields) {
  std::vector<std::string> names;
  for (const Field& f : fields) names.push_back(f.name);
  std::sort(names.begin(), names.end());
  return names;
}

// Where an unknown field belongs: in a table inside this one, or in the scene around it; else the nearest spelling.
std::string belongs_elsewhere(const std::string& name, const std::vector<Field>& fields,
                              const std::vector<std::string>& path, const std::string& nearest) {
  for (const Field& field : fields)
    if (const Function* inner = inner_table(field.type); inner && names_field(inner->fields, name))
      return fmt::format(" (it belongs in {} = {{ {} = ... }})", field.name, name);
  if (nearest.empty() && names_field(fields, "over"))
    return fmt::format(" (what varies belongs in over = {{ {} = {{ ... }} }})", name);
  if (!path.empty() && path.back() != "show" && names_field(function_named("scene").fields, name))
    return " (it belongs in the scene itself, beside this table)";
  return nearest;
}

/// Gathers the mistakes in a table and in the tables of named fields inside it.
class Check {
 public:
  /// `units`: those of the numbers.
  Check(lua_State* L, const Units& units) : L_(L), units_(units) {}

  void table(int index, const std::vector<Field>& fields, const std::vector<std::string>& path) {
    index = lua_absindex(L_, index);
    const std::string where = path.empty() ? "" : path.back() + ": ";
    report_unknown(unknown_names(index, fields, path, where), fields, path, where);
    for (const Field& field : fields) {
      lua_getfield(L_, index, field.name.c_str());
      value(field, path, where);
      lua_pop(L_, 1);
    }
  }

  std::vector<Mistake> mistakes;
  std::string valid;  ///< the names of the fields, if an unknown one was given

 private:
  static constexpr std::size_t most_shown = 20;

  static std::vector<std::string> below(std::vector<std::string> path, const std::string& name) {
    path.push_back(name);
    return path;
  }

  // In order; what has no name is reported at once.
  std::vector<std::string> unknown_names(int index, const std::vector<Field>& fields,
                                         const std::vector<std::string>& path, const std::string& where) {
    std::vector<std::string> unknown;
    std::size_t nameless = 0;
    for (lua_pushnil(L_); lua_next(L_, index) != 0; lua_pop(L_, 1)) {
      if (lua_type(L_, -2) == LUA_TSTRING) {
        const std::string name = lua_tostring(L_, -2);
        if (!names_field(fields, name)) unknown.push_back(name);
      } else if (nameless++ < most_shown) {
        mistakes.push_back(
            {path, fmt::format("{}takes named fields only, has the value {} without a name", where, shown(L_, -1))});
      }
    }
    std::sort(unknown.begin(), unknown.end());
    return unknown;
  }

  void report_unknown(const std::vector<std::string>& unknown, const std::vector<Field>& fields,
                      const std::vector<std::string>& path, const std::string& where) {
    if (unknown.empty()) return;
    const std::vector<std::string> names = names_of(fields);
    for (std::size_t i = 0; i < std::min(unknown.size(), most_shown); ++i) {
      const std::string remedy = belongs_elsewhere(unknown[i], fields, path, did_you_mean(unknown[i], names));
      mistakes.push_back({below(path, unknown[i]), fmt::format("{}unknown field '{}'{}", where, unknown[i], remedy)});
    }
    if (unknown.size() > most_shown)
      mistakes.push_back({path, fmt::format("{}and {} more unknown fields", where, unknown.size() - most_shown)});
    valid = joined(names);
  }

  // The value of a field is on top of the stack.
  void value(const Field& given, const std::vector<std::string>& path, const std::string& where) {
    Field field = given;
    field.unit = units_.name(given.unit);
    if (lua_isnil(L_, -1)) {
      if (field.initial.empty() && !field.optional)
        mistakes.push_back({path, fmt::format("{}'{}' is missing: {}", where, field.name, field.doc)});
      return;
    }
    if (field.unit == "degrees" && lua_type(L_, -1) == LUA_TNUMBER) warn_of_radians(field, lua_tonumber(L_, -1));
    if (const std::string mistake = mistake_in(L_, -1, field); !mistake.empty())
      mistakes.push_back({below(path, field.name), where + mistake});
    else if (const Function* inner = inner_table(field.type))
      table(-1, inner->fields, below(path, field.name));
    else if (const Function* element = element_table(field.type))
      each_element(L_, -1, [&](lua_Integer i) {
        table(-1, element->fields, below(below(path, field.name), fmt::format("{}[{}]", field.name, i)));
      });
  }

  // math.pi/3 is no angle in degrees that anybody means.
  void warn_of_radians(const Field& field, double value) {
    for (int part = 1; part <= 12; ++part)
      for (int k = 1; k <= 2 * part; ++k)
        if (value != 0 && std::abs(std::abs(value) - k * std::numbers::pi / part) < 1e-12)
          return session_of(L_).warn(fmt::format("'{}' is in degrees, and {:.6g} are given; for math.pi{}{} write {:g}",
                                                 field.name, value, k > 1 ? fmt::format("*{}", k) : "",
                                                 part > 1 ? fmt::format("/{}", part) : "",
                                                 std::copysign(180.0 * k / part, value)));
  }

  lua_State* L_;
  Units units_;
};

// The units of a table's numbers: SI of a scene that says so, of a body of a material, and of what a function is asked
// about a scene in SI.
Units units_of_table(lua_State* L, int index) {
  Units units;
  lua_getfield(L, index, "units");
  lua_getfield(L, index, "material");
  lua_getfield(L, index, "scene");
  units.si = (lua_type(L, -3) == LUA_TSTRING && lua_tostring(L, -3) == std::string("SI")) ||
             is_object(L, -2, "material") || (is_object(L, -1, "scene") && scene_at(L, -1).scene.units.si);
  lua_pop(L, 3);
  return units;
}

// True if the value is the module itself: a function was called with a colon instead of a dot.
bool is_module(lua_State* L, int index) {
  lua_getfield(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  lua_getfield(L, -1, "ricochet");
  const bool same = lua_rawequal(L, index, -1);
  lua_pop(L, 2);
  return same;
}

}  // namespace

void check_table(lua_State* L, int index, const Function& function, bool ours) {
  CallSite site = call_site(L);
  const Session& session = session_of(L);
  if (site.function.empty() || site.function == "check") site.function = function.name;
  const auto refuse = [&](const std::string& message) { throw Error(report(session, site, {{{}, message}})); };
  if (!lua_istable(L, index)) refuse(fmt::format("takes one table of named fields, e.g. {}", function.example));
  if (is_module(L, index))
    refuse(fmt::format("is called with a dot, not a colon: ricochet.{} {{ ... }}", function.name));
  if (!ours) make_plain(L, index, function.fields);
  Check check(L, units_of_table(L, index));
  check.table(index, function.fields, {});
  if (!check.mistakes.empty()) throw Error(report(session, site, check.mistakes, check.valid));
}

}  // namespace ricochet
