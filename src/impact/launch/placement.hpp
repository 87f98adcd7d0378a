#pragma once
// Where a body of an impact starts.

#include "body/modal/sweep.hpp"
#include "core/turn.hpp"
#include "core/vec3.hpp"

namespace ricochet {

struct Placement {
  Vec3 centre = Vec3::Zero();        ///< of mass [R]
  Vec3 velocity = Vec3::Zero();      ///< [c]
  Vec3 spin = Vec3::Zero();          ///< [c/R]
  Turn turn{};                       ///< from its place at rest
  Vec3 acceleration = Vec3::Zero();  ///< of its free flight [c^2/R]
  double time = 0;                   ///< since it was launched [R/c]
};

/// A body as it was built, at rest.
Placement placed_at_rest(const Solid& solid);

/// Where a body in free flight is after a time.
Placement flown(const Placement& placement, double time);

/// Points of a body, given where it is at rest, where it is placed.
Points placed(const Points& points, const Vec2& centre, const Placement& placement);

/// Puts a body into a lane, rigid.
template <int W>
void put(Motion<W>& body, int lane, const Placement& placement) {
  const Solid& solid = *body.solid;
  const Points points = placed(solid.points, solid.centre(), placement);
  const Vec2 centre = in_plane(placement.centre), velocity = in_plane(placement.velocity);
  for (int i = 0; i < solid.nodes(); ++i) {
    const Vec2& p = points[static_cast<std::size_t>(i)];
    body.q.set(i, lane, p);
    body.v.set(i, lane, velocity + placement.spin.z() * perpendicular(p - centre));
    body.f.set(i, lane, Vec2::Zero());
  }
  if (solid.modes()) put_modes(body, lane, centre, velocity, placement.turn.angle(), placement.spin.z());
}

}  // namespace ricochet
