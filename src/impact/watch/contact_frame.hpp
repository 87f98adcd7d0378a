#pragma once
// How the contact stands: its normal, where it is pushed, how far the bodies have come into each other.

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/pair.hpp"
#include "core/turn.hpp"
#include "impact/axes.hpp"
#include "impact/watch/run.hpp"
#include "impact/watch/smooth_outline.hpp"

namespace ricochet {

/// A body as it was built, turned and carried to where it is.
struct Pose {
  double cosine = 1, sine = 0;
  Vec2 centre = Vec2::Zero();  ///< of mass [R]

  Facing operator()(const Facing& at_rest) const {
    Facing facing = at_rest;
    facing.normal = turned(at_rest.normal, cosine, sine);
    return facing;
  }
};

/// The turn that brings the surface's nodes nearest to where they are, by least squares; none of a held body, and of
/// one of revolution.
template <int W>
Pose pose_of(const Motion<W>& body, int lane, const Vec2& centre) {
  const Solid& solid = *body.solid;
  if (solid.anchored() || solid.axisymmetric) return {1, 0, centre};
  const std::vector<int>& nodes = surface_nodes(solid.surface);
  Vec2 then = Vec2::Zero(), now = Vec2::Zero();
  for (const int node : nodes) {
    then += solid.points[static_cast<std::size_t>(node)] / static_cast<double>(nodes.size());
    now += body.q.at(node, lane) / static_cast<double>(nodes.size());
  }
  double along = 0, across = 0;
  for (const int node : nodes) {
    const Vec2 from = solid.points[static_cast<std::size_t>(node)] - then, to = body.q.at(node, lane) - now;
    along += from.dot(to);
    across += cross(from, to);
  }
  const double size = std::hypot(along, across);
  return {along / size, across / size, centre};
}

/// What a half of a contact that its axis parts has in common with the other half.
inline void make_symmetric(ContactFrame& frame) {
  frame.normal = normal(frame.normal) * upwards();
  for (int side : {0, 1}) {
    frame.arm[side] = normal(frame.arm[side]) * upwards();
    frame.arms2[side](0, 1) = frame.arms2[side](1, 0) = 0;
  }
}

/// Adds what pushes now to the contact's frame. `outline`, `pose`: of the pair's bodies, the projectile first.
template <int W>
void add_to_frame(const Pair<W>& pair, int lane, const Motions<W>& bodies,
                  const std::array<const SmoothOutline*, 2>& outline, const std::array<Pose, 2>& pose, Run& run) {
  ContactFrame now;
  const double xi = run.start.contact.xi;
  pair.each(lane, bodies, [&](const Push& push) {
    const int other = 1 - push.side;
    std::array<Facing, 2> facing;
    facing[push.side] = pose[push.side](outline[push.side]->at_node(push));
    facing[other] = pose[other](outline[other]->at_cell(push));
    const Vec2 place = bodies[static_cast<std::size_t>(pair.body(push.side))].q.at(push.node, lane);
    now.load += push.energy;
    now.normal += push.energy * normal_between(facing[0], facing[1]);
    const Unevenness uneven = unevenness_between(facing[0], facing[1], xi);
    now.uneven.sliding += push.energy * uneven.sliding;
    now.uneven.rolling += push.energy * uneven.rolling;
    for (int side : {0, 1}) {
      const Vec2 arm = place - pose[side].centre;
      now.arm[side] += push.energy * arm;
      now.arms2[side] += push.energy * arm * arm.transpose();
    }
  });
  if (!(now.load > 0)) return;
  if (bodies[static_cast<std::size_t>(pair.body(0))].solid->axisymmetric) make_symmetric(now);
  ContactFrame& frame = run.frame;
  frame.heaviest = std::max(frame.heaviest, now.load);
  frame.load += now.load;
  frame.normal += now.normal;
  frame.uneven.sliding += now.uneven.sliding;
  frame.uneven.rolling += now.uneven.rolling;
  for (int side : {0, 1}) {
    frame.arm[side] += now.arm[side];
    frame.arms2[side] += now.arms2[side];
  }
  const Vec2 came_from = run.approach.place + (run.clock().begin() - run.approach.time) * run.approach.velocity;
  const double overlap = now.normal.normalized().dot(came_from - (pose[0].centre - pose[1].centre));
  if (!(frame.overlap >= overlap)) frame.overlap = overlap;
}

}  // namespace ricochet
