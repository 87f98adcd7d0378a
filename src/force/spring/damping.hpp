#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "core/field.hpp"
#include "force/lane.hpp"
#include "lattice/lattice.hpp"

namespace ricochet {

/// A dashpot beside every spring of any law (Kelvin-Voigt): the tension gains time * k * dx/dt, k: stiffness of the
/// spring.
///
/// For a pair of nodes and fixed places the speed u along the spring falls as du/dt = -(1/m_i + 1/m_j) time k u, so by
/// exp(-2z) in h with z = time k (1/m_i + 1/m_j) h/2: for every h that conserves momentum and angular momentum and
/// never gains energy. Springs follow one another; half a step forward through their list and half a step backward make
/// the whole symmetric, so of order 2. With z far above 1, which only a step far too long for the material has, springs
/// stick in turn. [the splitting: Shardlow 2003, SIAM J. Sci. Comput. 24, 1267]
struct Damping {
  static constexpr const char* name = "damping";
  static constexpr const char* doc = "A dashpot beside every spring (Kelvin-Voigt): the material's viscosity.";
  static constexpr const char* example = "ricochet.damping { time = 1e-3 }";
  static constexpr const char* energy_doc = "energy lost to the dashpots";

  double time = 0;
  std::string on = "both";

  static const std::vector<Member<Damping>>& fields() {
    static const std::vector<Member<Damping>> list{
        {{"time", "number", "R/c", "viscosity over stiffness of a spring: the retardation time of the material",
          not_negative},
         &Damping::time},
        {{"on", "string", "", "the bodies it acts in", any_number, "both", false, {"projectile", "target", "both"}},
         &Damping::on},
    };
    return list;
  }

  /// 1 - exp(-2 z)
  static double taken(double z) { return -std::expm1(-2 * z); }

  /// All springs for a time h; returns the energy lost. [m0 c^2] whole(s): what is left of spring s, 1 or 0 once it is
  /// broken.
  template <int W, class Whole>
  Lane<W> damp(int body, Moving<W>& moving, const Lane<W>& h, bool forward, Whole&& whole) const {
    Lane<W> lost = Lane<W>::Zero();
    if (!acts_on(on, body) || time == 0) return lost;
    const Lattice& lattice = *moving.lattice;
    const Lane<W>* position = moving.position.data();
    Lane<W>*velocity = moving.velocity.data(), *impulse = moving.force.data();
    const double mass = lattice.mass;
    const Lane<W> strength =
        (0.5 * time / mass) *
        (moving.stiffness * h);  // z of a spring of unit stiffness to an anchor, which is infinitely heavy
    double known = -1;
    Lane<W> to_free = strength,
            to_anchor = strength;  // 1 - exp(-2 z): the share of the relative velocity that is taken, for `known`
    for (int row = 0; row < lattice.free; ++row) {
      const int i = forward ? row : lattice.free - 1 - row, first = lattice.first[i],
                count = lattice.first[i + 1] - first;
      Lane<W> xi, yi, vx, vy;
      xi = position[2 * i];
      yi = position[2 * i + 1];
      vx = velocity[2 * i];
      vy = velocity[2 * i + 1];
      for (int k = 0; k < count; ++k) {
        const int s = forward ? first + k : first + count - 1 - k;
        const Spring spring = lattice.spring[s];
        if (spring.stiffness != known) {
          known = spring.stiffness;
          for (int lane = 0; lane < W; ++lane) {
            to_free[lane] = taken(2 * known * strength[lane]);
            to_anchor[lane] = taken(known * strength[lane]);
          }
        }
        const int j = 2 * spring.other;
        const Lane<W> dx = position[j] - xi, dy = position[j + 1] - yi;
        const bool both = spring.other < lattice.free;
        // u n = (w . d) d / d^2. What does not depend on v_i stands apart: the next spring of the row waits for that
        // alone.
        const double share = both ? 0.5 : 1.0;
        const Lane<W> share_taken = (both ? to_free : to_anchor) * whole(s),
                      per_square = share_taken / (dx * dx + dy * dy), sx = share * dx, sy = share * dy;
        const Lane<W> along = (velocity[j] - vx) * dx + (velocity[j + 1] - vy) * dy,
                      part = along * per_square;  // taken u / d
        vx += part * sx;
        vy += part * sy;
        if (both) {
          velocity[j] -= part * sx;
          velocity[j + 1] -= part * sy;
        } else {
          impulse[j] -= mass * part * dx;
          impulse[j + 1] -= mass * part * dy;
        }  // for whoever books the work on moving anchors
        // mu/2 (u^2 - u'^2) with the reduced mass mu and u' = (1 - taken) u
        lost += (0.5 * mass * share) * (part * along) * (2.0 - share_taken);
      }
      velocity[2 * i] = vx;
      velocity[2 * i + 1] = vy;
    }
    return lost;
  }
};

}  // namespace ricochet
