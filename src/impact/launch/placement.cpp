#include "impact/launch/placement.hpp"

namespace ricochet {

Placement placed_at_rest(const Solid& solid) {
  Placement placement;
  placement.centre = in_space(solid.centre());
  return placement;
}

Placement flown(const Placement& placement, double time) {
  Placement later = placement;
  later.centre += time * placement.velocity;
  if (placement.acceleration != Vec3::Zero()) {
    later.centre += time * time / 2 * placement.acceleration;
    later.velocity += time * placement.acceleration;
  }
  later.turn = placement.turn.then(time * placement.spin.z());
  return later;
}

Points placed(const Points& points, const Vec2& centre, const Placement& placement) {
  const Vec2 to = in_plane(placement.centre);
  Points moved;
  for (const Vec2& p : points)
    moved.push_back(placement.turn.none() ? Vec2(p + (to - centre)) : Vec2(to + placement.turn(p - centre)));
  return moved;
}

}  // namespace ricochet
