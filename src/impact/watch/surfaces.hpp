#pragma once
#include <deque>

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

/// How far projectile and target are apart. [R]
template <int W>
double gap_between(const Motions<W>& bodies, int lane) {
  const Surfaces surfaces = surfaces_at(bodies, lane);
  return distance_of(surfaces[role::projectile], surfaces[role::target]);
}

}  // namespace ricochet
