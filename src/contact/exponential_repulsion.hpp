#pragma once
#include <string>
#include <vector>

#include "core/exponential.hpp"
#include "core/field.hpp"

namespace ricochet {

/// V = V0 exp(-xi d), F = xi V0 exp(-xi d), d: distance of a rim node from a rim segment of the other body, never
/// signed. Summed over every segment within `reach`; the sum has a continuous gradient off the rim, while a
/// nearest-segment rule has kinks that cap the order of every integrator. [Hayakawa & Kuninaka 2003, section V A; the
/// sum is ours]
struct ExponentialRepulsion {
  double V0 = 150;
  double xi = 300;
  double reach = 0.1;
  std::string sides = "one";

  bool two_sided() const { return sides == "two"; }
  double energy(double distance) const { return V0 * exponential(-xi * distance); }
  double force(double distance) const { return xi * energy(distance); }

  static const std::vector<Member<ExponentialRepulsion>>& fields() {
    static const std::vector<Member<ExponentialRepulsion>> list{
        {{"V0", "number", "m0 c^2",
          "energy of a rim node that touches a segment: a total energy below it cannot tunnel", positive, "150"},
         &ExponentialRepulsion::V0},
        {{"xi", "number", "1/R", "inverse range of the repulsion", positive, "300"}, &ExponentialRepulsion::xi},
        {{"reach", "number", "R",
          "segments farther than this from a node are left out; 20 <= xi reach <= 700; it widens by itself where an "
          "impact is so slow that what is left out would show",
          positive, "0.1"},
         &ExponentialRepulsion::reach},
        {{"sides",
          "string",
          "",
          "one: projectile nodes are pushed off target segments (the paper); two: and the other way round",
          any_number,
          "one",
          false,
          {"one", "two"}},
         &ExponentialRepulsion::sides},
    };
    return list;
  }
};

}  // namespace ricochet
