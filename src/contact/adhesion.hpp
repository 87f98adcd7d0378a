#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "contact/exponential_repulsion.hpp"
#include "core/exponential.hpp"
#include "core/field.hpp"

namespace ricochet {

/// An attractive tail: V = -strength exp(-xi d) for the pairs of the contact, d: distance of a rim node from a rim
/// segment, within the contact's reach. With xi half of the repulsion's the sum is Morse's potential, of depth
/// strength^2 / (4 V0) at exp(-xi d) = strength / (2 V0). [Morse 1929, Phys. Rev. 34, 57]
struct Adhesion {
  static constexpr const char* name = "adhesion";
  static constexpr const char* doc =
      "Rims attract each other: -strength exp(-xi d) beside the contact's repulsion. With xi half of the contact's, "
      "each pair has Morse's potential, of depth "
      "strength^2 / (4 V0). A projectile that sticks ends out_of_time.";
  static constexpr const char* example = "ricochet.adhesion { strength = 0.5 }";
  static constexpr const char* energy_doc = "energy after: attraction of the rims";

  double strength = 0;
  double xi = 200;

  static const std::vector<Member<Adhesion>>& fields() {
    static const std::vector<Member<Adhesion>> list{
        {{"strength", "number", "m0 c^2", "of the attraction at distance 0", positive}, &Adhesion::strength},
        {{"xi", "number", "1/R", "inverse range, below that of the contact; xi reach >= 20", positive, "200"},
         &Adhesion::xi},
    };
    return list;
  }

  /// Why it cannot act beside a repulsion; empty if it can.
  std::string conflict_with(const ExponentialRepulsion& contact) const {
    if (xi * contact.reach < 20)
      return fmt::format(
          "xi reach = {:g} cuts the attraction at more than exp(-20); raise contact.reach to {:g} or more",
          xi * contact.reach, 20 / xi);
    if (xi >= contact.xi)
      return fmt::format("xi = {:g} must be below the contact's, {:g}, or the rims would be drawn into one another", xi,
                         contact.xi);
    return "";
  }

  /// Bounded by exp(700), as the repulsion is inside a plane.
  double energy(double distance) const { return -strength * exponential(std::min(-xi * distance, 700.0)); }
  double force(double distance) const { return xi * energy(distance); }  ///< away from the segment: below 0
};

}  // namespace ricochet
