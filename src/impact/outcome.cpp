#include "impact/outcome.hpp"

#include <set>

#include "effect/catalogue.hpp"
#include "impact/roles.hpp"

namespace ricochet {
namespace {

using O = const Outcome&;
using Columns = std::vector<std::pair<Field, std::function<double(O)>>>;

const Columns& of_paper() {
  static const Columns columns{
      {{"e", "number", "",
        "normal restitution of the centre of mass, relative to the target's, along y: -v_n' / v_n; undefined where "
        "|normal_x| > 0.1, as beta, mu, psi1 and psi2 are"},
       [](O o) { return o.e; }},
      {{"beta", "number", "", "tangential restitution of the contact point, -v_ct' / v_ct; undefined if v_ct = 0"},
       [](O o) { return o.beta; }},
      {{"mu", "number", "", "impulse ratio |n x J| / (n . J); effects that act on the projectile count in J"},
       [](O o) { return o.mu; }},
      {{"psi1", "number", "", "v_ct / v_cn before impact"}, [](O o) { return o.psi1; }},
      {{"psi2", "number", "", "v_ct' / v_cn: tangential velocity after over normal speed before"},
       [](O o) { return o.psi2; }},
  };
  return columns;
}

const Columns& of_normal() {
  static const Columns columns{
      {{"normal_x", "number", "",
        "of the contact's normal, from target to projectile: that of the two smooth outlines, carried along rigidly, "
        "where they touch; at a corner that of the other body's side; mean over all touches, weighed by force"},
       [](O o) { return o.normal_x; }},
      {{"normal_y", "number", "", "of the contact's normal"}, [](O o) { return o.normal_y; }},
      {{"e_n", "number", "",
        "restitution of the contact points along the contact's normal, -v_cn' / v_cn, with spin and the target's "
        "motion; a round body touches below its centre of mass: on a flat wall its e_n is e. Undefined, and beta_n "
        "too, where touches at several places of a body that is not round, or a normal that turns meanwhile, leave "
        "v_cn uncertain by more than a tenth; e_n alone, where the sides that stand for a smooth outline do, as the "
        "contact moves along them: where two bodies slide or turn much faster than they meet. A rough rim's sides are "
        "the surface. `reason` says which"},
       [](O o) { return o.e_n; }},
      {{"beta_n", "number", "", "the same across the normal, -v_ct' / v_ct; undefined if v_ct is below 1e-3 of v_cn"},
       [](O o) { return o.beta_n; }},
      {{"mu_n", "number", "", "impulse ratio |n x J| / (n . J) with the contact's normal"}, [](O o) { return o.mu_n; }},
      {{"e_first", "number", "",
        "e at the first parting: when a touch had ended and the bodies moved apart, whatever followed"},
       [](O o) { return o.e_first; }},
      {{"mu_first", "number", "", "mu at the first parting"}, [](O o) { return o.mu_first; }},
      {{"time_first", "number", "R/c", "when the touch before the first parting ended"},
       [](O o) { return o.time_first; }},
  };
  return columns;
}

const Columns& of_motion() {
  static const Columns columns{
      {{"vn", "number", "c", "normal velocity after impact, relative to the target's"}, [](O o) { return o.vn; }},
      {{"vt", "number", "c", "tangential velocity after impact, relative to the target's"}, [](O o) { return o.vt; }},
      {{"omega", "number", "c/R",
        "spin after impact: angular momentum over the moment of inertia of the undeformed body, which does not "
        "change while it vibrates on"},
       [](O o) { return o.omega; }},
      {{"target_vn", "number", "c", "normal velocity of the target after impact; 0 if it is held"},
       [](O o) { return o.target_vn; }},
      {{"target_vt", "number", "c", "tangential velocity of the target after impact; 0 if it is held"},
       [](O o) { return o.target_vt; }},
      {{"target_omega", "number", "c/R", "spin of the target after impact; 0 if it is held"},
       [](O o) { return o.target_omega; }},
      {{"impulse_n", "number", "m0 c",
        "normal part of J = M (v' - v), of all that acts on the projectile up to the end of contact"},
       [](O o) { return o.impulse_n; }},
      {{"impulse_t", "number", "m0 c", "tangential part of J"}, [](O o) { return o.impulse_t; }},
      {{"last_vn", "number", "c",
        "normal velocity, relative to the target's, when the run ended, whether the impact finished or not"},
       [](O o) { return o.last_vn; }},
      {{"last_vt", "number", "c", "tangential velocity, relative to the target's, when the run ended"},
       [](O o) { return o.last_vt; }},
      {{"last_omega", "number", "c/R", "spin when the run ended"}, [](O o) { return o.last_omega; }},
      {{"last_energy", "number", "m0 c^2", "energy when the run ended: all"}, [](O o) { return o.last_energy; }},
  };
  return columns;
}

const Columns& of_contact() {
  static const Columns columns{
      {{"contact_time", "number", "R/c",
        "from the beginning of the first touch to the end of the last; a touch lasts while the normal force exceeds "
        "1e-3 (ending.force) of its greatest in that touch"},
       [](O o) { return o.contact_time; }},
      {{"contact_time_energy", "number", "R/c",
        "from the first to the last moment at which the contact's energy is 1e-6 of that of the bodies' motion along "
        "y towards each other, at their reduced mass (and 1e-8 of all energy)"},
       [](O o) { return o.contact_time_energy; }},
      {{"touches", "number", "", "how many separate touches; one of less than 1e-3 of the greatest force is none"},
       [](O o) { return o.touches; }},
      {{"indentation", "number", "R",
        "greatest overlap along the normal of the smooth outlines, undeformed, unrotated, above the landing point "
        "launch.at"},
       [](O o) { return o.indentation; }},
      {{"overlap", "number", "R",
        "how far the bodies' centres came closer to each other along the contact's normal since the first touch began, "
        "at most"},
       [](O o) { return o.overlap; }},
      {{"penetration", "number", "R",
        "how deep the deepest node of a rim stood inside another body, or below a plane, as seen in looks at the "
        "contact"},
       [](O o) { return o.penetration; }},
      {{"contact_length", "number", "R", "|x_b - x_a| of the contact at the greatest indentation"},
       [](O o) { return o.contact_length; }},
      {{"centre_offset", "number", "R", "|x_c - x_a|: from the trailing end of the contact to the projectile's centre"},
       [](O o) { return o.centre_offset; }},
      {{"tan_alpha", "number", "", "slope of the chord between the ends of the contact, up in the direction of motion"},
       [](O o) { return o.tan_alpha; }},
      {{"e_alpha", "number", "",
        "restitution of the contact point against the normal turned by alpha; at grazing angles the speed along that "
        "normal passes 0, and the mean over lattices is undefined: take a median"},
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
      {{"before_target_translation", "number", "m0 c^2", "energy before: target, centre of mass (0 if anchored)"},
       [](O o) { return o.before.of(role::target).translation; }},
      {{"before_target_rotation", "number", "m0 c^2", "energy before: target, spin (0 if anchored)"},
       [](O o) { return o.before.of(role::target).rotation; }},
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
      {{"inversion_time", "number", "R/c", "when that share first exceeded 0.002; undefined if it never did"},
       [](O o) { return o.inversion_time; }},
      {{"folded", "number", "", "1 if that share exceeded 0.002: springs that are turned over resist no more"},
       [](O o) { return o.folded; }},
      {{"inertia", "number", "",
        "I/(M R^2) of the projectile at rest about its centre, R the unit of length, in SI half of the projectile's "
        "largest extent: 0.5 for a disk of radius R"},
       [](O o) { return o.inertia; }},
      {{"inertia_target", "number", "", "I/(M R^2) of the target; undefined if it is anchored"},
       [](O o) { return o.inertia_target; }},
      {{"xi", "number", "1/R", "inverse range of the repulsion that acted"}, [](O o) { return o.xi; }},
      {{"V0", "number", "m0 c^2",
        "energy of the repulsion that acted, of a rim node on a segment; where the scene gave none, of a length R of "
        "rim"},
       [](O o) { return o.V0; }},
      {{"certified", "number", "",
        "1 if no node can come inside the other body: every rim node of both is pushed, and the energy is below that "
        "of one on a segment; never 1 of a one-sided contact, of one along springs' normals, or beside effects that "
        "bring energy"},
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
      {{"error_step", "number", "",
        "estimated error of the scene's accuracy_of from the time step; undefined unless accuracy was asked for"},
       [](O o) { return o.error_step; }},
      {{"error_contact", "number", "",
        "estimated error of the scene's accuracy_of from the softness of the contact, 2 |e(xi) - e(2 xi)| of trial "
        "scenes; undefined where the scene gives xi, which is part of the model then, or asks for no accuracy"},
       [](O o) { return o.error_contact; }},
      {{"error_contact_time", "number", "R/c",
        "by how much contact_time may exceed that of a hard contact, 2 ln(1000)/(xi v): the force counts that long "
        "before the outlines meet and after; undefined where the scene gives xi"},
       [](O o) { return o.error_contact_time; }},
      {{"over_yield", "number", "",
        "1 if the greatest pressure that ricochet.estimate gives passes 1.67 times the yield stress of a body's "
        "material (1.60 times it between axisymmetric bodies), 0 if not: nothing yields here; undefined without a "
        "yield stress, or a law"},
       [](O o) { return o.over_yield; }},
      {{"plastic_strain_most", "number", "",
        "greatest plastic strain of an element; undefined without ricochet.yielding"},
       [](O o) { return o.plastic_strain_most; }},
      {{"dent", "number", "R",
        "of the projectile: by how much less far it reaches from its centre of mass towards the target at the end than "
        "at rest, as it vibrates then; undefined without ricochet.yielding"},
       [](O o) { return o.dent; }},
      {{"dent_target", "number", "R",
        "how far the deepest node of the target's upper surface lies below where it was before the impact, as it "
        "vibrates at the end; of a target that is free, seen from its centre of mass; undefined without "
        "ricochet.yielding, and of a target that is rigid, or free in the plane, where it may have turned"},
       [](O o) { return o.dent_target; }},
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
  if constexpr (ElementFlow<E>)
    add("_elements", "", E::count_doc, [kind](O o) { return of_kind(o.effect_count, kind); });
  if constexpr (SpringChange<E>)
    add("_springs", "", E::count_doc, [kind](O o) { return of_kind(o.effect_count, kind); });
}

}  // namespace

const std::vector<std::pair<Field, std::function<double(const Outcome&)>>>& Outcome::fields() {
  static const Columns list = [] {
    Columns columns;
    for (const Columns* some : {&of_paper(), &of_normal(), &of_motion(), &of_contact(), &of_energy(), &of_run()})
      columns.insert(columns.end(), some->begin(), some->end());
    each_effect_kind([&](const auto& effect) { add_effect(effect, columns); });
    return columns;
  }();
  return list;
}

bool turns_in_mirror(const std::string& column) {
  static const std::set<std::string> turning{"psi1",      "psi2",         "normal_x",  "vt",      "omega",
                                             "target_vt", "target_omega", "impulse_t", "last_vt", "last_omega"};
  return turning.contains(column);
}

}  // namespace ricochet
