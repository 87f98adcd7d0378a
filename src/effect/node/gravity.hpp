#pragma once
#include <string>
#include <vector>

#include "body/motion.hpp"
#include "core/field.hpp"
#include "core/vec3.hpp"

namespace ricochet {

/// F = -m g on every free node of a body, along -y; V = m g (y - y0), y0: its place at rest in the lattice's own frame.
/// From a given launch.height the projectile falls; else its flight before the bodies come within reach is straight,
/// and g acts from then on.
struct Gravity {
  static constexpr const char* name = "gravity";
  static constexpr const char* doc =
      "A constant acceleration along -y: from the start where launch.height is given, else from the first approach of "
      "the rims on.";
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
  Vec3 fall() const { return {0, -g, 0}; }

  template <int W>
  void add_forces(Motion<W>& body) const {
    const Masses& mass = body.solid->mass;
    for (int i = 0; i < body.solid->free; ++i) body.f[2 * i + 1] -= mass[i] * g;
  }

  template <int W>
  Lane<W> energy(const Motion<W>& body) const {
    const Solid& solid = *body.solid;
    const bool uniform = solid.mass.uniform();
    Lane<W> sum = Lane<W>::Zero();
    for (int i = 0; i < solid.free; ++i) {
      const Lane<W> height = body.q[2 * i + 1] - solid.points[static_cast<std::size_t>(i)].y();
      sum += uniform ? height : Lane<W>(solid.mass[i] * height);
    }
    return (uniform ? solid.mass.each() : 1.0) * g * sum;
  }
};

}  // namespace ricochet
