#pragma once
// Coaxial impact of two rods of one material and cross-section, one of them at rest. [Saint-Venant 1867; Goldsmith
// 1960; Hayakawa & Kuninaka 2003, section II A]

#include <algorithm>

#include "theory/argument.hpp"

namespace ricochet::theory {

struct Rods {
  double L = 1, L2 = 1, c = 1, v = 1;
  static Arguments<Rods> fields() {
    return {{{"L", "number", "L", "length of the rod that moves", positive}, &Rods::L},
            {{"L2", "number", "L", "length of the rod at rest", positive}, &Rods::L2},
            {{"c", "number", "L T^-1", "speed of sound in them, sqrt(E/rho)", positive}, &Rods::c},
            {{"v", "number", "L T^-1", "impact speed; far below c", positive}, &Rods::v}};
  }
};

struct RodRebound {
  double e, t_c, v1, v2;
  static Arguments<RodRebound> fields() {
    return {{{"e", "number", "",
              "restitution coefficient of the centres of mass: the ratio of lengths, whatever the speed"},
             &RodRebound::e},
            {{"t_c", "number", "T", "contact time"}, &RodRebound::t_c},
            {{"v1", "number", "L T^-1", "velocity of the first rod afterwards"}, &RodRebound::v1},
            {{"v2", "number", "L T^-1", "velocity of the second, its centre of mass"}, &RodRebound::v2}};
  }
};

/// A wave of particle speed v/2 enters both rods; when it has run up and down the shorter one, t_c = 2 L_short/c, that
/// rod is left at its other's former velocity. With momentum conserved e = L_short/L_long. [here]
inline RodRebound rods(const Rods& given) {
  checked(given);
  const double shorter = std::min(given.L, given.L2), e = shorter / std::max(given.L, given.L2);
  // L v1 + L2 v2 = L v and v2 - v1 = e v: v1 = v (L - e L2)/(L + L2), which is 0 if the first rod is the shorter one.
  const double v1 = given.L > given.L2 ? given.v * (given.L - given.L2) / given.L : 0;
  return {e, 2 * shorter / given.c, v1, v1 + e * given.v};
}

}  // namespace ricochet::theory
