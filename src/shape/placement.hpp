#pragma once
// Where the interior nodes of a lattice lie.

#include <string>

#include "core/rng.hpp"
#include "shape/surface.hpp"

namespace ricochet {

enum class Placement { uniform, poisson_disk, triangular };

/// How many points are placed, how far apart as a mean, and how far at least from the rim. [R]
struct Spacing {
  int count;
  double spacing, margin;
};

/// Points inside a rim (simple). uniform: independent points, as in the paper; near-coincident pairs and skinny
/// triangles occur. poisson_disk: random points with a least distance to each other and to the rim's nodes, as large as
/// dart throwing finds. triangular: a triangular lattice of the same density; the number of points is the nearest that
/// fits, not exactly `count`. Throws FieldError if the margin leaves no room.
Points place_interior(const Rim& rim, Placement placement, const Spacing& wanted, Random& random);

Placement placement_from_name(const std::string& name);

}  // namespace ricochet
