#pragma once
#include <string>
#include <vector>

#include "core/field.hpp"
#include "force/lane.hpp"
#include "lattice/lattice.hpp"

namespace ricochet {

/// A dashpot beside every spring of any law (Kelvin-Voigt): the tension gains time * k * dx/dt, k: stiffness of the spring.
///
/// For a pair of nodes and fixed places the speed u along the spring falls as du/dt = -(1/m_i + 1/m_j) time k u. Each spring is solved
/// by the implicit midpoint rule, u -> u (1 - z)/(1 + z) with z = time k (1/m_i + 1/m_j) h/2: for every h it conserves momentum and
/// angular momentum and never gains energy. Springs follow one another; half a step forward through their list and half a step
/// backward make the whole symmetric, so of order 2. [the splitting: Shardlow 2003, SIAM J. Sci. Comput. 24, 1267]
struct Damping {
  static constexpr const char* name = "damping";
  static constexpr const char* doc = "A dashpot beside every spring (Kelvin-Voigt): the material's viscosity.";
  static constexpr const char* example = "ricochet.damping { time = 1e-3 }";
  static constexpr const char* energy_doc = "energy lost to the dashpots";

  double time = 0;
  std::string on = "both";

  static const std::vector<Member<Damping>>& fields() {
    static const std::vector<Member<Damping>> list{
        {{"time", "number", "R/c", "viscosity over stiffness of a spring: the retardation time of the material", not_negative}, &Damping::time},
        {{"on", "string", "", "the bodies it acts in", any_number, "both", false, {"projectile", "target", "both"}}, &Damping::on},
    };
    return list;
  }

  /// All springs for a time h; returns the energy lost. [m0 c^2] whole(s): what is left of spring s, 1 or 0 once it is broken.
  template <int W, class Whole>
  Lane<W> damp(int body, Moving<W>& moving, const Lane<W>& h, bool forward, Whole&& whole) const {
    Lane<W> lost = Lane<W>::Zero();
    if (!acts_on(on, body)) return lost;
    const Lattice& lattice = *moving.lattice;
    const auto pair = [&](int i, int s) {
      const Spring& spring = lattice.spring[s];
      const int j = spring.other;
      const bool both = j < lattice.free;  // an anchor is infinitely heavy
      const Lane<W> dx = moving.position.x(j) - moving.position.x(i), dy = moving.position.y(j) - moving.position.y(i);
      const Lane<W> per_square = 1.0 / (dx * dx + dy * dy);
      const double lightness = (both ? 2.0 : 1.0) / lattice.mass;
      const Lane<W> z = (0.5 * time * spring.stiffness * lightness) * (moving.stiffness * h) * whole(s);
      // u n, with the unit vector n = d/|d|, is (w . d) d / d^2; what is taken off it is 2 z / (1 + z) of it.
      const Lane<W> wx = moving.velocity.x(j) - moving.velocity.x(i), wy = moving.velocity.y(j) - moving.velocity.y(i);
      const Lane<W> along = (wx * dx + wy * dy) * per_square, taken = 2.0 * z / (1.0 + z);
      const Lane<W> ux = taken * along * dx, uy = taken * along * dy;
      const double share = both ? 0.5 : 1.0;
      moving.velocity.x(i) += share * ux, moving.velocity.y(i) += share * uy;
      if (both) moving.velocity.x(j) -= share * ux, moving.velocity.y(j) -= share * uy;
      else moving.force.x(j) -= lattice.mass * ux, moving.force.y(j) -= lattice.mass * uy;  // the impulse, for whoever books the work on moving anchors
      // mu/2 (u^2 - u'^2) with the reduced mass mu and u' = (1 - taken) u.
      lost += (0.5 / lightness) * (along * along / per_square) * taken * (2.0 - taken);
    };
    if (forward) {
      for (int i = 0; i < lattice.free; ++i)
        for (int s = lattice.first[i]; s < lattice.first[i + 1]; ++s) pair(i, s);
    } else {
      for (int i = lattice.free - 1; i >= 0; --i)
        for (int s = lattice.first[i + 1] - 1; s >= lattice.first[i]; --s) pair(i, s);
    }
    return lost;
  }
};

}  // namespace ricochet
