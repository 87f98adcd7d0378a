#include "impact/outcome.hpp"

#include "effect/catalogue.hpp"
#include "impact/roles.hpp"

namespace ricochet {
namespace {

using O = const Outcome&;
using Columns = std::vector<std::pair<Field, std::function<double(O)>>>;

const Columns& of_motion() {
  static const Columns columns{
      {{"e", "number", "", "normal restitution of the centre of mass, -v_n' / v_n"}, [](O o) { return o.e; }},
      {{"beta", "number", "", "tangential restitution of the contact point, -v_ct' / v_ct; undefined if v_ct = 0"},
       [](O o) { return o.beta; }},
      {{"mu", "number", "", "impulse ratio |n x J| / (n . J); effects that act on the projectile count in J"},
       [](O o) { return o.mu; }},
      {{"psi1", "number", "", "v_ct / v_cn before impact"}, [](O o) { return o.psi1; }},
      {{"psi2", "number", "", "v_ct' / v_cn: tangential velocity after over normal speed before"},
       [](O o) { return o.psi2; }},
      {{"vn", "number", "c", "normal velocity after impact"}, [](O o) { return o.vn; }},
      {{"vt", "number", "c", "tangential velocity after impact"}, [](O o) { return o.vt; }},
      {{"omega", "number", "c/R",
        "spin after impact: angular momentum over the moment of inertia of the undeformed body, which does not "
        "change while it vibrates on"},
       [](O o) { return o.omega; }},
      {{"impulse_n", "number", "m0 c",
        "normal part of J = M (v' - v), of all that acts on the projectile up to the end of contact"},
       [](O o) { return o.impulse_n; }},
      {{"impulse_t", "number", "m0 c", "tangential part of J"}, [](O o) { return o.impulse_t; }},
      {{"contact_time", "number", "R/c",
        "from the first touch to the end of the last (contact energy above 1e-6 of the kinetic energy)"},
       [](O o) { return o.contact_time; }},
      {{"touches", "number", "", "how many separate touches"}, [](O o) { return o.touches; }},
      {{"indentation", "number", "R",
        "greatest overlap along the normal of the smooth outlines, undeformed, unrotated, above the landing point "
        "launch.at"},
       [](O o) { return o.indentation; }},
      {{"contact_length", "number", "R", "|x_b - x_a| of the contact at the greatest indentation"},
       [](O o) { return o.contact_length; }},
      {{"centre_offset", "number", "R", "|x_c - x_a|: from the trailing end of the contact to the projectile's centre"},
       [](O o) { return o.centre_offset; }},
      {{"tan_alpha", "number", "", "slope of the chord between the ends of the contact, up in the direction of motion"},
       [](O o) { return o.tan_alpha; }},
      {{"e_alpha", "number", "", "restitution of the contact point against the normal turned by alpha"},
       [](O o) { return o.e_alpha; }},
  };
  return columns;
}

const Columns& of_energy() {
  static const Columns columns{
      {{"before_projectile_translation", "number", "m0 c^2", "energy before: projectile, centre of mass"},
       [](O o) { return o.before.of(role::projectile).translation; }},
      {{"before_projectile_rotation", "number", "m0 c^2", "energy before: projectile, spin"},
       [](O o) { return o.before.of(role::projectile).rotation; }},
      {{"before_projectile_vibration", "number", "m0 c^2", "energy before: projectile, vibration"},
       [](O o) { return o.before.of(role::projectile).vibration; }},
      {{"before_target_vibration", "number", "m0 c^2", "energy before: target, vibration"},
       [](O o) { return o.before.of(role::target).vibration; }},
      {{"before_total", "number", "m0 c^2", "energy before: all"}, [](O o) { return o.before.total(); }},
      {{"after_projectile_translation", "number", "m0 c^2", "energy after: projectile, centre of mass"},
       [](O o) { return o.after.of(role::projectile).translation; }},
      {{"after_projectile_rotation", "number", "m0 c^2", "energy after: projectile, spin"},
       [](O o) { return o.after.of(role::projectile).rotation; }},
      {{"after_projectile_vibration", "number", "m0 c^2", "energy after: projectile, vibration"},
       [](O o) { return o.after.of(role::projectile).vibration; }},
      {{"after_target_translation", "number", "m0 c^2", "energy after: target, centre of mass (0 if anchored)"},
       [](O o) { return o.after.of(role::target).translation; }},
      {{"after_target_rotation", "number", "m0 c^2", "energy after: target, spin (0 if anchored)"},
       [](O o) { return o.after.of(role::target).rotation; }},
      {{"after_target_vibration", "number", "m0 c^2", "energy after: target, vibration"},
       [](O o) { return o.after.of(role::target).vibration; }},
      {{"after_contact", "number", "m0 c^2", "energy after: contact"}, [](O o) { return o.after.contact; }},
  };
  return columns;
}

const Columns& of_run() {
  static const Columns columns{
      {{"energy_closure", "number", "",
        "|total after - before| / before; after an impact without effects by a method that is conjugate to order 4, "
        "with the vibration's energy that it keeps at that order"},
       [](O o) { return o.energy_closure; }},
      {{"energy_drift", "number", "",
        "greatest |total - before| / before seen during the impact, of the nodes as they are moved"},
       [](O o) { return o.energy_drift; }},
      {{"inverted", "number", "",
        "greatest share of a body's area in triangles turned over, as seen with the ledger; beyond that of slivers "
        "it is no elastic solid any more"},
       [](O o) { return o.inverted; }},
      {{"inversion_time", "number", "R/c", "when that share first exceeded 0.01; undefined if it never did"},
       [](O o) { return o.inversion_time; }},
      {{"inertia", "number", "",
        "I/(M R^2) of the projectile at rest about its centre, R the unit of length: 0.5 for a disk of radius R"},
       [](O o) { return o.inertia; }},
      {{"inertia_target", "number", "", "I/(M R^2) of the target; undefined if it is anchored"},
       [](O o) { return o.inertia_target; }},
      {{"certified", "number", "",
        "1 if the total energy is below V0, so that no projectile node can cross a target segment (nor the reverse, "
        "if two-sided)"},
       [](O o) { return o.certified; }},
      {{"time", "number", "R/c", "simulated time, from the rims' coming within reach to the end"},
       [](O o) { return o.time; }},
      {{"step", "number", "R/c", "time step"}, [](O o) { return o.step; }},
      {{"theta", "number", "", "step times the bound of the highest frequency"}, [](O o) { return o.theta; }},
      {{"theta_most", "number", "", "the greatest it became, springs as stretched and contact included"},
       [](O o) { return o.theta_most; }},
      {{"steps", "number", "", "number of steps"}, [](O o) { return o.steps; }},
      {{"momentum_residual", "number", "",
        "|total momentum after - before| / before; undefined if the target is anchored; drag and gravity bring "
        "momentum"},
       [](O o) { return o.momentum_residual; }},
      {{"error_estimate", "number", "",
        "estimated error of the scene's accuracy_of from the time step; undefined unless accuracy was asked for"},
       [](O o) { return o.error_estimate; }},
      {{"over_yield", "number", "",
        "1 if the greatest pressure that ricochet.estimate gives passes 1.67 times the yield stress of a body's "
        "material, "
        "0 if not: nothing yields here; undefined without a yield stress, or a law"},
       [](O o) { return o.over_yield; }},
  };
  return columns;
}

double of_kind(const std::vector<double>& values, std::size_t kind) {
  return kind < values.size() ? values[kind] : Outcome::undefined;
}

template <class E>
void add_effect(const E&, Columns& columns) {
  const std::size_t kind = Effect(E{}).index();
  const auto add = [&](const char* ending, const char* unit, const char* doc, std::function<double(O)> value) {
    columns.push_back(
        {{E::name + std::string(ending), "number", unit, std::string(doc) + "; undefined in scenes without it"},
         std::move(value)});
  };
  if (E::energy_doc) add("_energy", "m0 c^2", E::energy_doc, [kind](O o) { return of_kind(o.effect_energy, kind); });
  if constexpr (SpringChange<E>)
    add("_springs", "", E::count_doc, [kind](O o) { return of_kind(o.effect_count, kind); });
}

}  // namespace

const std::vector<std::pair<Field, std::function<double(const Outcome&)>>>& Outcome::fields() {
  static const Columns list = [] {
    Columns columns;
    for (const Columns* some : {&of_motion(), &of_energy(), &of_run()})
      columns.insert(columns.end(), some->begin(), some->end());
    each_effect_kind([&](const auto& effect) { add_effect(effect, columns); });
    return columns;
  }();
  return list;
}

}  // namespace ricochet
