#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "body/elements/viscosity.hpp"
#include "body/motion.hpp"
#include "core/field.hpp"

namespace ricochet {

/// What a dashpot takes of the relative velocity of a spring's ends in a time h, in W lanes.
template <int W>
class Dashpots {
 public:
  /// `time`: of retardation; `stiffness_time`: stiffness of a spring of unit stiffness times h.
  Dashpots(const Solid& solid, double time, const Lane<W>& stiffness_time)
      : solid_(solid),
        strength_((solid.mass.uniform() ? 0.5 * time / solid.mass.each() : 0.5 * time) * stiffness_time) {}

  /// 1 - exp(-2 z) with z = strength k (1/m_i + 1/m_j) / 2; a held node is infinitely heavy.
  const Lane<W>& taken(const Spring& spring) {
    const bool both = spring.other < solid_.free;
    const Masses& mass = solid_.mass;
    if (!mass.uniform()) {
      set(own_, spring.stiffness * (1 / mass[spring.node] + (both ? 1 / mass[spring.other] : 0)));
      return own_;
    }
    if (spring.stiffness != known_) {
      known_ = spring.stiffness;
      set(to_free_, 2 * known_);
      set(to_held_, known_);
    }
    return both ? to_free_ : to_held_;
  }

  /// Which share of the velocity that is taken a spring's end takes.
  double share(const Spring& spring, int end) const {
    if (spring.other >= solid_.free) return end == spring.node ? 1 : 0;
    if (solid_.mass.uniform()) return 0.5;
    const double m = solid_.mass[spring.node], other = solid_.mass[spring.other];
    return (end == spring.node ? other : m) / (m + other);
  }

 private:
  void set(Lane<W>& taken, double by) const {
    for (int lane = 0; lane < W; ++lane) taken[lane] = -std::expm1(-2 * (by * strength_[lane]));
  }

  const Solid& solid_;
  Lane<W> strength_;   // z of a spring of unit stiffness to a held node; times the mass where nodes have their own
  double known_ = -1;  // stiffness of the spring that to_free_ and to_held_ are of
  Lane<W> to_free_, to_held_, own_;
};

/// A dashpot beside every spring of any law (Kelvin-Voigt): the tension gains time * k * dx/dt, k: stiffness of the
/// spring. Of elements, the viscosity of their material (body/elements/viscosity.hpp).
///
/// For a pair of nodes and fixed places the speed u along the spring falls as du/dt = -(1/m_i + 1/m_j) time k u, so by
/// exp(-2z) in h with z = time k (1/m_i + 1/m_j) h/2: for every h that conserves momentum and angular momentum and
/// never gains energy. Springs follow one another; half a step forward through their list and half a step backward make
/// the whole symmetric, so of order 2. With z far above 1, which only a step far too long for the material has, springs
/// stick in turn. [the splitting: Shardlow 2003, SIAM J. Sci. Comput. 24, 1267]
struct Damping {
  static constexpr const char* name = "damping";
  static constexpr const char* doc =
      "The material's viscosity (Kelvin-Voigt): a dashpot beside every spring, and in every element.";
  static constexpr const char* example = "ricochet.damping { time = 1e-3 }";
  static constexpr const char* energy_doc = "energy lost to the dashpots";

  double time = 0;
  std::string on = "both";

  static const std::vector<Member<Damping>>& fields() {
    static const std::vector<Member<Damping>> list{
        {{"time", "number", "R/c", "viscosity over stiffness: the retardation time of the material", not_negative},
         &Damping::time},
        {{"on", "string", "", "the bodies it acts in", any_number, "both", false, {"projectile", "target", "both"}},
         &Damping::on},
    };
    return list;
  }

  /// All springs for a time h; returns the energy lost. [m0 c^2] whole(s): what is left of spring s, 1 or 0 once it is
  /// broken. What held nodes are pulled with is left in `f`, as an impulse, for whoever books the work on them.
  template <int W, class Whole>
  Lane<W> damp(Motion<W>& body, const Springs& springs, const Lane<W>& h, bool forward, Whole&& whole) const {
    Lane<W> lost = Lane<W>::Zero();
    if (time == 0) return lost;
    const Solid& solid = *body.solid;
    Dashpots<W> dashpots(solid, time, Lane<W>(body.stiffness * h));
    const Place<W, 2>* position = body.q.template places<2>();
    Place<W, 2>*velocity = body.v.template places<2>(), *impulse = body.f.template places<2>();
    for (int row = 0; row < solid.free; ++row) {
      const int i = forward ? row : solid.free - 1 - row;
      const int first = springs.first[static_cast<std::size_t>(i)];
      const int count = springs.first[static_cast<std::size_t>(i) + 1] - first;
      Place<W, 2> at, v;
      at = position[i];
      v = velocity[i];
      for (int k = 0; k < count; ++k) {
        const int s = forward ? first + k : first + count - 1 - k;
        const Spring spring = springs.list[static_cast<std::size_t>(s)];
        const int j = spring.other;
        const Place<W, 2> d = position[j] - at;
        // u n = (w . d) d / d^2. What does not depend on v_i stands apart: the next spring of the row waits for that
        // alone.
        const double share = dashpots.share(spring, i);
        const Lane<W> taken = dashpots.taken(spring) * whole(s), per_square = taken / dot(d, d);
        const Lane<W> along = dot(velocity[j] - v, d), part = along * per_square;  // taken u / d
        v += part * (share * d);
        if (j < solid.free)
          velocity[j] -= part * (dashpots.share(spring, j) * d);
        else
          impulse[j] -= Lane<W>(solid.mass[i] * part) * d;
        // mu/2 (u^2 - u'^2) with the reduced mass mu and u' = (1 - taken) u
        lost += (0.5 * solid.mass[i] * share) * (part * along) * (2.0 - taken);
      }
      velocity[i] = v;
    }
    return lost;
  }

  /// The same in a body of elements.
  template <int W>
  Lane<W> damp(Motion<W>& body, const Elements& elements, const Lane<W>& h, bool forward) const {
    return time == 0 ? Lane<W>(Lane<W>::Zero()) : damp_elements<W>(body, elements, time, h, forward);
  }
};

}  // namespace ricochet
