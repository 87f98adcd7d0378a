#pragma once
#include <vector>

#include "body/solid.hpp"
#include "core/field.hpp"

namespace ricochet {

/// What takes the velocity of a node of an edge: m dv/dt = -sqrt(E) [xx xy; xy yy] v, E: the body's own.
struct EdgeDashpot {
  int node;
  double xx, xy, yy;
};

/// Edges behind which the body seems to go on: every piece of them is pulled by the stress that a wave in an unbounded
/// body has there, -rho c_P v_n along its normal and -rho c_S v_t across, per area (2 pi r ds of a body of revolution).
/// A plane wave that meets an edge head on leaves through it; one at an angle comes back in part.
/// [Lysmer & Kuhlemeyer, J. Eng. Mech. Div. ASCE 95, 859 (1969)]
///   rho c_P = sqrt(rho (lambda + 2 mu)), rho c_S = sqrt(rho mu): lambda and mu those of the elements at a node, rho
///   its mass over its share of their volume. Of dashpots s times as strong (1 - s)/(1 + s) of the amplitude comes
///   back.
/// Solved exactly beside the step, v -> exp(-C h/m) v.
struct AbsorbingEdges {
  static constexpr const char* name = "absorbing_edges";
  static constexpr const char* doc =
      "Dashpots on the free edges of a target of elements that do not face the projectile, its sides and what lies "
      "below (the outward normal less than 30 degrees above the horizontal): waves leave through them as if the body "
      "went on, so that it acts as a half-space. One that meets an edge head on leaves none behind.";
  static constexpr const char* example = "ricochet.absorbing_edges {}";
  static constexpr const char* energy_doc = "energy that left through the absorbing edges";

  double impedance = 1;

  static const std::vector<Member<AbsorbingEdges>>& fields() {
    static const std::vector<Member<AbsorbingEdges>> list{
        {{"impedance", "number", "",
          "s of the dashpots, over that of the body's waves: (1 - s)/(1 + s) of the amplitude of a wave that meets "
          "them head on comes back",
          positive, "1"},
         &AbsorbingEdges::impedance},
    };
    return list;
  }

  /// Of the free nodes on such edges; none of a body without elements. xx, xy, yy: per sqrt(E) [m0/R for E in m0
  /// c^2/R^2].
  std::vector<EdgeDashpot> dashpots(const Solid& solid) const;
};

}  // namespace ricochet
