#pragma once
// What an impact is to expect by the law of a line contact, or of Hertz between bodies of revolution, before anything
// is computed.

#include <string>
#include <vector>

#include "contact/quasi_static.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// What makes a scene's numbers doubtful.
struct Doubt {
  /// coarse_contact, coarse_rim, folding, fast_modes, few_modes, corner, over_yield, small_half_space, supersonic
  std::string kind;
  std::string reason;  ///< a sentence with its remedy
};

/// Of the first touch of the smooth outlines. [R, m0, c]
struct Estimate {
  std::string no_law;          ///< a sentence if no law holds here: then what follows it is NaN
  QuasiStaticImpact impact{};  ///< not_given where there is no law
  /// Contact time and approach are within 20 % of those of fine lattices: the contact is narrower than the bodies, and
  /// the normal speed at most 0.1 c_P, 0.05 beside an elastic block, into which waves leave. [here]
  bool in_range = false;
  double pressure = not_given;  ///< greatest [m0 c^2/R^2, m0 c^2/R^3 of bodies of revolution]
  double normal_speed = not_given;
  double wave_speed = not_given;    ///< c_P of the projectile: sqrt(E2/(rho (1 - nu2^2)))
  double slowest_wave = not_given;  ///< the least c_P of the bodies that move inside
  double spacing = not_given;  ///< of nodes: the square root of area over nodes, the sides of a mesh at the touch; the
                               ///< coarser body's
  double radius = not_given;   ///< of curvature, of both together
  double over_yield = not_given;  ///< 1 if something would begin to yield that does not, else 0
  std::vector<Doubt> doubts;
};

/// A pure function of the scene's description; milliseconds.
Estimate estimate(const Scene& scene);

/// Of `estimate` alone; NaN where no body has a yield stress. Yielding begins at p0 = 1.67 Y in a line contact, at
/// 1.60 Y in one of Hertz. [Johnson 1985, section 6.2, Tresca]
double over_yield(const Scene& scene);

}  // namespace ricochet
