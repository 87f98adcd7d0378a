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
/// What a scene leaves out (NaN), impact/launch/contact_rule.hpp fills in.
struct ExponentialRepulsion {
  double V0 = not_given;
  double xi = not_given;
  double reach = not_given;
  std::string sides = "two";
  double deepest = not_given;
  /// V0 is that of a length R of rim, of which a node has its share (Mesh::weight). Otherwise each node has all of it.
  bool by_length = false;
  std::string rule = "sum";

  bool sums() const { return rule == "sum"; }
  bool two_sided() const { return sides == "two"; }
  double energy(double distance) const { return V0 * exponential(-xi * distance); }
  double force(double distance) const { return xi * energy(distance); }

  static const std::vector<Member<ExponentialRepulsion>>& fields() {
    static const std::vector<Member<ExponentialRepulsion>> list{
        {{"V0", "number", "m0 c^2",
          "energy of a rim node that touches a segment; unless given, a length R of rim has 1000 times the impact's "
          "energy, and a node its share",
          positive, "", true},
         &ExponentialRepulsion::V0},
        {{"xi", "number", "1/R",
          "inverse range of the repulsion; unless given, 1/xi is a 200th of the indentation to be expected, of rough "
          "rims a fiftieth",
          positive, "", true},
         &ExponentialRepulsion::xi},
        {{"reach", "number", "R",
          "segments farther than this from a node are left out; 20 <= xi reach <= 700; it widens by itself where an "
          "impact is so slow that what is left out would show; 30/xi unless given",
          positive, "", true},
         &ExponentialRepulsion::reach},
        {{"sides",
          "string",
          "",
          "two: nodes of either body are pushed off segments of the other; one: the projectile's alone (the paper), "
          "between which a tip of the target may stand inside",
          any_number,
          "two",
          false,
          {"one", "two"}},
         &ExponentialRepulsion::sides},
        {{"deepest", "number", "R",
          "how deep a node that a one-sided contact does not push may stand inside, beyond which the impact ends "
          "tunnelled: the mean cell of the projectile's surface unless given. The paper's rough scenes finish from "
          "0.86 of the mean cell on: 0.053 R of 800 nodes, 0.076 R of 400. A node that is pushed may not be inside at "
          "all",
          positive, "", true},
         &ExponentialRepulsion::deepest},
        {{"rule",
          "string",
          "",
          "which segments push a node. sum: all within reach, which conserves energy. What not to do, for comparison: "
          "nearest: the nearest alone, whose force jumps where another becomes it, so that the order of a method is "
          "lost; spring_normal: the nearest, along its normal wherever the node stands (the words of the paper), which "
          "beside a vertex is no gradient of any energy: impacts gain or lose some, and need an energy_tolerance",
          any_number,
          "sum",
          false,
          {"sum", "nearest", "spring_normal"}},
         &ExponentialRepulsion::rule},
    };
    return list;
  }
};

}  // namespace ricochet
