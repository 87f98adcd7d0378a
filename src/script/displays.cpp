#include "script/displays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "effect/catalogue.hpp"
#include "impact/outcome.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

int push(lua_State* L, const std::string& text) {
  lua_pushlstring(L, text.data(), text.size());
  return 1;
}

std::string text_of(const Body& body) {
  if (body.plane) return "the rigid half-plane y <= 0";
  const Box box = bounding_box(body.outline);
  const Vec2 size = box.high - box.low;
  const BodyNumbers& n = body.numbers;
  std::string text = fmt::format("a body of {}, {:.4g} x {:.4g}", body.rigid() ? "nothing that moves" : n.interior,
                                 size.x(), size.y());
  if (n.axisymmetric()) text += ", the right half of a section through its axis";
  if (!body.rigid()) text += fmt::format(", {} nodes", n.nodes);
  if (!body.holes.empty()) text += fmt::format(", {} holes", body.holes.size());
  const auto held = std::count(body.anchored.begin(), body.anchored.end(), true);
  if (held > 0) text += fmt::format(", {} of them held", held);
  return text;
}

// "  e                    0.984\n"
std::string line(const std::string& name, const std::string& value, const std::string& unit = "") {
  return fmt::format("  {:<28} {}{}\n", name, value, unit.empty() ? "" : " [" + unit + "]");
}

// The value on top of the stack; "" for what is undefined.
std::string value_text(lua_State* L) {
  if (lua_isinteger(L, -1)) return fmt::format("{}", lua_tointeger(L, -1));
  if (lua_type(L, -1) == LUA_TNUMBER) {
    const double value = lua_tonumber(L, -1);
    return std::isnan(value) ? "" : fmt::format("{:.6g}", value);
  }
  if (lua_type(L, -1) == LUA_TSTRING) return lua_tostring(L, -1);
  return lua_isboolean(L, -1) ? (lua_toboolean(L, -1) ? "true" : "false") : luaL_typename(L, -1);
}

// The units of outcomes in the system of the row at index 1; of nothing if it has none.
std::optional<Units> units_of_row(lua_State* L) {
  lua_pushliteral(L, "units");
  const bool known = lua_rawget(L, 1) == LUA_TSTRING;
  const std::string name = known ? lua_tostring(L, -1) : "";
  lua_pop(L, 1);
  return name == "paper" || name == "SI" ? std::optional(Units::named(name)) : std::nullopt;
}

}  // namespace

int body_shown(lua_State* L) { return push(L, text_of(*body_at(L, 1).body)); }

int material_shown(lua_State* L) {
  const Material& of = material_at(L, 1).material;
  return push(L, fmt::format("a material: E = {:g} Pa, nu = {:g}, density = {:g} kg/m^3", of.E, of.nu, of.density));
}

int effect_shown(lua_State* L) { return push(L, "the effect " + name_of(effect_at(L, 1).effect)); }

int scene_shown(lua_State* L) {
  const Scene& scene = scene_at(L, 1).scene;
  std::string text =
      fmt::format("a scene\n  projectile: {}\n  target: {}\n", text_of(*scene.projectile), text_of(*scene.target));
  for (const Effect& effect : scene.effects) text += fmt::format("  with {}\n", name_of(effect));
  return push(L, text + "  scene:run() runs it, scene:text() tells all of it");
}

int values_shown(lua_State* L) {
  std::vector<std::string> names = names_in(L, 1);
  std::sort(names.begin(), names.end());
  const std::optional<Units> units = units_of_row(L);
  std::string text = kind_name(L, 1).empty() ? "a row\n" : kind_name(L, 1) + "\n";
  const auto add = [&](const std::string& name, const std::string& unit) {
    const auto place = std::find(names.begin(), names.end(), name);
    if (place == names.end()) return;
    names.erase(place);
    lua_pushstring(L, name.c_str());
    lua_rawget(L, 1);
    if (const std::string value = value_text(L); !value.empty()) text += line(name, value, unit);
    lua_pop(L, 1);
  };
  if (units) {
    add("status", "");
    add("reason", "");
    for (const auto& [field, value] : Outcome::fields()) add(field.name, units->name(field.unit));
  }
  for (const std::string& name : std::vector(names)) add(name, "");
  text.pop_back();
  return push(L, text);
}

}  // namespace ricochet
