#pragma once
#include <algorithm>
#include <deque>
#include <limits>

#include "impact/axes.hpp"
#include "impact/roles.hpp"
#include "impact/state.hpp"
#include "shape/placed_surface.hpp"

namespace ricochet {

/// The surfaces of all bodies of a lane, by index.
using Surfaces = std::deque<PlacedSurface>;

template <int W>
Surfaces surfaces_at(const Motions<W>& bodies, int lane) {
  Surfaces surfaces;
  for (const Motion<W>& body : bodies) {
    Points points;
    for (const int node : surface_nodes(body.solid->surface)) points.push_back(body.q.at(node, lane));
    surfaces.emplace_back(body.solid->surface, std::move(points));
  }
  return surfaces;
}

/// How far a body at rest reaches from its centre of mass. [R]
inline double reach_from_centre(const Solid& solid, const Vec2& direction) {
  return PlacedSurface(solid.surface, solid.smooth).support(direction) - direction.dot(solid.centre());
}

/// How far below a point, along the normal, the surface of a body reaches now. [R]
template <int W>
double depth_below(const Vec3& point, const Motion<W>& body, int lane) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const int node : surface_nodes(body.solid->surface)) lowest = std::min(lowest, normal(body.q.at(node, lane)));
  return normal(point) - lowest;
}

/// How far projectile and target are apart. [R]
template <int W>
double gap_between(const Motions<W>& bodies, int lane) {
  const Surfaces surfaces = surfaces_at(bodies, lane);
  return distance_of(surfaces[role::projectile], surfaces[role::target]);
}

}  // namespace ricochet
