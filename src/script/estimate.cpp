// ricochet.estimate: what a law says of a scene before it runs.

#include "impact/estimate.hpp"

#include <fmt/format.h>

#include <cmath>

#include "body/elasticity.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "theory/disk.hpp"

namespace ricochet {
namespace {

constexpr const char* line_law = "line contact of smooth outlines, quasi-static [Johnson 1985, section 5.6]";
constexpr const char* line_range =
    "round, smooth outlines; contact narrower than the bodies; normal speed up to 0.1 of the least c_P (0.05 beside an "
    "elastic wall, a block held at its depth): then within 20 % of fine lattices";

constexpr const char* point_law =
    "Hertz: point contact of smooth bodies of revolution on their axis, quasi-static [Johnson 1985, sections 4.2, "
    "11.4]";
constexpr const char* point_range =
    "round, smooth outlines; contact narrower than half of the radius; normal speed up to 0.1 of the least c_P (0.05 "
    "beside an elastic block that is held)";

/// One number of the table.
struct ToldNumber {
  const char* name;
  double value;
  const char* unit;
  const char* law = line_law;
  const char* range = line_range;
};

// Of the dashpots alone, if the scene has them and a disk falls on what is rigid.
double viscous_e(const Scene& scene, const Estimate& e) {
  const auto* damping = [&]() -> const Damping* {
    for (const Effect& effect : scene.effects)
      if (const auto* found = std::get_if<Damping>(&effect); found && found->on != "target") return found;
    return nullptr;
  }();
  if (!damping || !scene.target->rigid() || !e.no_law.empty()) return not_given;
  const PlaneModuli moduli = usual_moduli(scene.projectile->numbers);
  const double stretch_speed = e.wave_speed * std::sqrt(1 - moduli.poisson_ratio * moduli.poisson_ratio);
  try {
    return theory::disk_log_law({.R = e.radius,
                                 .E = stretch_speed * stretch_speed,
                                 .nu = 0,
                                 .rho = 1,
                                 .v = e.normal_speed,
                                 .tau0 = damping->time})
        .e;
  } catch (const FieldError&) {
    return not_given;  // beyond the law's range
  }
}

// print(estimate.force): "2.1e+03 N", or that no law holds here.
int told_text(lua_State* L) {
  lua_getfield(L, 1, "value");
  lua_getfield(L, 1, "unit");
  lua_getfield(L, 1, "in_range");
  const double value = lua_tonumber(L, 2);
  const std::string unit = lua_tostring(L, 3);
  const char* doubt = std::isnan(value)     ? " (no law holds here)"
                      : lua_toboolean(L, 4) ? ""
                                            : " (beyond the law's range)";
  lua_pushstring(L, fmt::format("{:.4g}{}{}{}", value, unit.empty() ? "" : " ", unit, doubt).c_str());
  return 1;
}

void push_told(lua_State* L, const ToldNumber& told, const Units& units, bool in_range) {
  lua_createtable(L, 0, 5);
  lua_pushnumber(L, told.value * units.worth(told.unit));
  lua_setfield(L, -2, "value");
  lua_pushboolean(L, in_range && !std::isnan(told.value));
  lua_setfield(L, -2, "in_range");
  const std::pair<const char*, std::string> texts[] = {
      {"unit", units.name(told.unit)}, {"law", told.law}, {"range", told.range}};
  for (const auto& [name, text] : texts) {
    lua_pushstring(L, text.c_str());
    lua_setfield(L, -2, name);
  }
  push_strict(L, "a number of an estimate");
  lua_getmetatable(L, -1);
  lua_pushcfunction(L, guarded<told_text>);
  lua_setfield(L, -2, "__tostring");
  lua_pop(L, 1);
}

void push_warnings(lua_State* L, const Estimate& e) {
  lua_newtable(L);
  for (const Doubt& doubt : e.doubts) {
    lua_createtable(L, 0, 2);
    lua_pushstring(L, doubt.kind.c_str());
    lua_setfield(L, -2, "kind");
    lua_pushstring(L, doubt.reason.c_str());
    lua_setfield(L, -2, "reason");
    lua_seti(L, -2, list_length(L, -2) + 1);
  }
}

// A force per length as a stress, in Pa; in the paper's units, which know no thickness, as it is.
ToldNumber pressure_of(const Scene& scene, double pressure) {
  constexpr const char *name = "pressure", *law = "greatest pressure of a line contact, 2 F/(pi a)";
  if (scene.projectile->numbers.axisymmetric())
    return {name, pressure, "m0 c^2/R^3", "greatest pressure of Hertz, 3 F/(2 pi a^2)"};
  if (!scene.units.si) return {name, pressure, "m0 c^2/R^2", law};
  return {name, pressure * scene.units.length / scene.projectile->material->thickness, "m0 c^2/R^3", law};
}

int estimate_from_lua(lua_State* L) {
  const Scene& scene = scene_at(L, 1).scene;
  const Estimate e = estimate(scene);
  ToldNumber numbers[] = {
      {"force", e.impact.force, "m0 c^2/R"},
      {"overlap", e.impact.approach, "R"},
      {"contact_time", e.impact.time, "R/c"},
      {"contact_length", 2 * e.impact.half_width, "R"},
      pressure_of(scene, e.pressure),
      {"e", viscous_e(scene, e), "", "dashpots of a disk on a rigid plane: 1 - (pi/2) (tau c/R)/sqrt(ln(4c/v))",
       "an effect ricochet.damping, a rigid target, e above 0.5; waves left in the disk take some 0.02 more"},
      {"wave_speed", e.wave_speed, "c", "c_P = sqrt(E2/(rho (1 - nu2^2))) of the projectile", "small strains"}};
  lua_newtable(L);
  const bool revolved = scene.projectile->numbers.axisymmetric();
  for (ToldNumber& told : numbers) {
    if (revolved && told.law == line_law) told.law = point_law;
    if (revolved && told.range == line_range) told.range = point_range;
    push_told(L, told, scene.units, e.in_range);
    lua_setfield(L, -2, told.name);
  }
  push_warnings(L, e);
  lua_setfield(L, -2, "warnings");
  lua_pushstring(L, e.no_law.c_str());
  lua_setfield(L, -2, "no_law");
  push_strict(L, "an estimate");
  return 1;
}

}  // namespace

Group estimate_functions() {
  return {
      .functions = {
          {.name = "estimate",
           .doc = "What laws say of a scene before it runs. A table of force, overlap, contact_time, contact_length, "
                  "pressure, e and wave_speed; each is a table of value (NaN where no law holds), unit, law, range "
                  "and in_range. `no_law` says why none holds, or is empty. `warnings` is a list of { kind =, reason "
                  "= }: coarse_contact (a mesh has less than 8 sides along half of the contact, a lattice less than 4 "
                  "nodes along it), coarse_rim, folding, fast_modes, few_modes, corner, over_yield, "
                  "small_half_space, supersonic.",
           .returns = "table",
           .example = "ricochet.estimate(scene).contact_time.value",
           .call = guarded<estimate_from_lua>,
           .arguments = {{"scene", "ricochet.scene"}}}}};
}

}  // namespace ricochet
