// Who is called the projectile is a name: what an impact's row says of the two bodies must not depend on it.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "impact/batch.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

using Columns = std::map<std::string, double>;

Columns columns_of(const Outcome& o) {
  Columns columns;
  for (const auto& [field, value] : Outcome::fields()) columns[field.name] = value(o);
  return columns;
}

std::shared_ptr<const Solid> upside_down(const Solid& solid) {
  Solid turned = solid;
  for (Vec2& p : turned.points) p = -p;
  for (Vec2& p : turned.smooth) p = -p;
  return std::make_shared<Solid>(turned);
}

/// Two unlike disks, the lower of which is free, too.
Scene unlike_disks(double at, double psi1) {
  Scene scene;
  scene.projectile = disk(60, 1e4, 0, 1);
  Body heavy = *disk(90, 2e3, 0, 2);
  heavy.numbers.mass = 3;
  scene.target = std::make_shared<Body>(heavy);
  scene.launch.at = at;
  scene.launch.psi1 = psi1;
  scene.contact = paper_contact();
  scene.contact.sides = "two";
  return scene;
}

struct Both {
  Columns one, exchanged;
  double mass_ratio;  ///< the target's over the projectile's
};

/// A scene's impact, and the same seen from the other body: half a turn puts the target above, and it is launched.
Both impact_and_exchange(const Scene& scene) {
  const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
  Scene exchanged = scene;
  std::swap(exchanged.projectile, exchanged.target);
  exchanged.launch.at -= p->centre().x() + t->centre().x();  // launch.at is of the centre of mass
  const auto above = upside_down(*t), below = upside_down(*p);
  const Outcome a = run_scene({p.get(), t.get()}, scene, go_on);
  const Outcome b = run_scene({above.get(), below.get()}, exchanged, go_on);
  REQUIRE((a.status == Status::finished && b.status == Status::finished));
  return {columns_of(a), columns_of(b), 90 * 3.0 / 60};
}

/// How a column of the exchanged impact follows from the columns of the other.
enum class Follows {
  same,           ///< of relative motion, of forces, of the contact
  of_other_body,  ///< what was the projectile's is the target's
  by_mass_ratio,  ///< of the target's motion, or of an energy, in the frame in which the target was at rest
  of_one_body,    ///< measured at one body's rim, or a share of an energy of that frame, or rounding
};

std::map<std::string, Follows> rule_of_columns() {
  using enum Follows;
  std::map<std::string, Follows> rules;
  const auto add = [&](Follows rule, std::initializer_list<const char*> names) {
    for (const char* name : names) rules[name] = rule;
  };
  add(same, {"e",
             "beta",
             "mu",
             "psi1",
             "psi2",
             "normal_x",
             "normal_y",
             "e_n",
             "beta_n",
             "mu_n",
             "e_first",
             "mu_first",
             "vn",
             "vt",
             "impulse_n",
             "impulse_t",
             "last_vn",
             "last_vt",
             "touches",
             "indentation",
             "overlap",
             "penetration",
             "inverted",
             "inversion_time",
             "folded",
             "xi",
             "V0",
             "certified",
             "time",
             "time_first",
             "step",
             "theta",
             "theta_most",
             "steps",
             "contact_time",
             "contact_time_energy",
             "error_contact_time",
             "over_yield",
             "after_contact",
             "plastic_strain_most"});
  add(of_other_body, {"omega", "target_omega", "inertia", "inertia_target", "after_projectile_rotation",
                      "after_target_rotation", "after_projectile_vibration", "after_target_vibration"});
  add(by_mass_ratio, {"target_vn", "target_vt", "before_total", "before_projectile_translation"});
  add(of_one_body, {"after_projectile_translation",
                    "after_target_translation",
                    "last_energy",
                    "energy_closure",
                    "energy_drift",
                    "contact_length",
                    "centre_offset",
                    "tan_alpha",
                    "e_alpha",
                    "last_omega",
                    "momentum_residual",
                    "before_projectile_rotation",
                    "before_projectile_vibration",
                    "before_target_translation",
                    "before_target_rotation",
                    "before_target_vibration",
                    "error_step",
                    "error_contact",
                    "dent",
                    "dent_target"});
  return rules;
}

std::string others_name(std::string name) {
  const auto replace = [&](const std::string& from, const std::string& to) {
    const auto at = name.find(from);
    if (at == std::string::npos) return false;
    name.replace(at, from.size(), to);
    return true;
  };
  if (name == "omega" || name == "inertia") return name == "omega" ? "target_omega" : "inertia_target";
  if (name == "target_omega" || name == "inertia_target") return name == "target_omega" ? "omega" : "inertia";
  if (!replace("projectile", "target")) replace("target", "projectile");
  return name;
}

/// 0 of two that are undefined alike.
double relative_difference(double one, double other) {
  if (std::isnan(one) && std::isnan(other)) return 0;
  return std::abs(one - other) / std::max({std::abs(one), std::abs(other), 1e-300});
}

}  // namespace

TEST_CASE("who is called the projectile changes no outcome: columns that agree under exchange, and those that cannot") {
  using enum Follows;
  constexpr double rounding = 1e-9;  // 1e-12 was measured
  const auto rules = rule_of_columns();
  struct Case {
    const char* name;
    Scene scene;
  };
  Case by_rule{"off centre, contact by the rule", unlike_disks(0.3, 0)};
  by_rule.scene.contact = {};
  for (const auto& [name, scene] : {Case{"head on", unlike_disks(0, 0)}, Case{"oblique", unlike_disks(0, 1)},
                                    Case{"off centre", unlike_disks(0.5, 0)}, by_rule}) {
    const Both both = impact_and_exchange(scene);
    std::string differ;
    double greatest = 0;
    for (const auto& [column, value] : both.one) {
      const bool of_effect =
          column.ends_with("_energy") || column.ends_with("_springs") || column.ends_with("_elements");
      if (of_effect && rules.count(column) == 0) continue;
      REQUIRE(rules.count(column) == 1);
      const Follows rule = rules.at(column);
      if (rule == of_one_body) {
        differ += fmt::format(" {} ({:.3g}, {:.3g})", column, value, both.exchanged.at(column));
        continue;
      }
      const double other = both.exchanged.at(rule == of_other_body ? others_name(column) : column);
      const double difference = relative_difference(value * (rule == by_mass_ratio ? both.mass_ratio : 1), other);
      CAPTURE(value, other);
      CHECK(difference < rounding);
      greatest = std::max(greatest, difference);
    }
    fmt::print("exchange, {}: greatest relative difference {:.1e}; of one body, or of its frame:{}\n", name, greatest,
               differ);
  }
}
