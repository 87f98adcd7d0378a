#pragma once
// How deep the dents are that an impact has left in bodies that yield.

#include <algorithm>
#include <array>
#include <variant>

#include "body/rigid_motion.hpp"
#include "impact/launch/placement.hpp"
#include "impact/outcome.hpp"
#include "impact/watch/ledger.hpp"
#include "impact/watch/run.hpp"
#include "impact/watch/surfaces.hpp"

namespace ricochet {

/// How far the deepest node of a target's surface, of those above its centre of mass, lies below where it was before
/// the impact, seen from the centre of one that is free. Undefined of one that is rigid, or free to turn. [R]
template <int W>
double dent_of_target(const Placement& before, const Vec3& centre, const Motion<W>& body, int lane) {
  const Solid& solid = *body.solid;
  if (std::holds_alternative<Rigid>(solid.interior) || !(solid.anchored() || solid.axisymmetric))
    return Outcome::undefined;
  const Points places = placed(solid.points, solid.centre(), before);
  double deepest = 0;
  for (const int node : surface_nodes(solid.surface)) {
    const double height = normal(places[static_cast<std::size_t>(node)]) - normal(before.centre);
    if (height > 0) deepest = std::max(deepest, height - normal(body.q.at(node, lane)) + normal(centre));
  }
  return deepest;
}

/// By how much less far the projectile reaches down from its centre of mass than at rest, and the target's. [R]
template <int W>
std::array<double, 2> dents(const Run& run, const RigidMotions<W>& motions, const Motions<W>& bodies, int lane) {
  const auto centre = [&](std::size_t body) {
    const Space<W>& of_lanes = motions[body].centre;
    return Vec3(of_lanes.at[0][lane], of_lanes.at[1][lane], of_lanes.at[2][lane]);
  };
  return {run.projectile_radius - depth_below(centre(role::projectile), bodies[role::projectile], lane),
          dent_of_target(run.start.bodies[role::target], centre(role::target), bodies[role::target], lane)};
}

}  // namespace ricochet
