#pragma once
#include <string>
#include <vector>

#include "core/field.hpp"
#include "force/lane.hpp"
#include "lattice/lattice.hpp"

namespace ricochet {

/// F = -m g on every free node of a body, along -y; V = m g (y - y0), y0: its place at rest in the lattice's own frame.
/// The free flight before the bodies come within reach is straight: g acts from then on.
struct Gravity {
  static constexpr const char* name = "gravity";
  static constexpr const char* doc = "A constant acceleration along -y, from the first approach of the rims on.";
  static constexpr const char* example = "ricochet.gravity { g = 1e-4 }";
  static constexpr const char* energy_doc = "energy after: gained in height against gravity";

  double g = 0;
  std::string on = "projectile";

  static const std::vector<Member<Gravity>>& fields() {
    static const std::vector<Member<Gravity>> list{
        {{"g", "number", "c^2/R", "acceleration", not_negative}, &Gravity::g},
        {{"on",
          "string",
          "",
          "the bodies it acts on",
          any_number,
          "projectile",
          false,
          {"projectile", "target", "both"}},
         &Gravity::on},
    };
    return list;
  }

  /// Acceleration of a body that touches nothing. [c^2/R]
  Vec2 fall(int body) const { return acts_on(on, body) ? Vec2(0, -g) : Vec2(0, 0); }

  template <int W>
  void add_forces(int body, Moving<W>& moving) const {
    if (!acts_on(on, body)) return;
    const double weight = moving.lattice->mass * g;
    for (int i = 0; i < moving.lattice->free; ++i) moving.force.y(i) -= weight;
  }

  template <int W>
  Lane<W> energy(int body, const Moving<W>& moving) const {
    Lane<W> sum = Lane<W>::Zero();
    if (!acts_on(on, body)) return sum;
    for (int i = 0; i < moving.lattice->free; ++i) sum += moving.position.y(i) - moving.lattice->points[i].y();
    return Lane<W>(moving.lattice->mass * g * sum);
  }
};

}  // namespace ricochet
