#pragma once
// Where the interior nodes of a lattice lie.

#include <string>

#include "core/rng.hpp"
#include "core/vec2.hpp"

namespace ricochet {

enum class Placement { uniform, poisson_disk, triangular };

/// Interior points of `outline` (simple, counter-clockwise). `spacing` is the mean distance sqrt(area / nodes).
/// uniform: `count` independent points, as in the paper; near-coincident pairs and skinny triangles occur.
/// poisson_disk: `count` random points with a least distance to each other and to the outline, as large as dart
/// throwing finds. triangular: a triangular lattice of the same density; the number of points is the nearest that fits,
/// not exactly `count`.
Points place_interior(const Points& outline, Placement placement, int count, double spacing, Random& random);

Placement placement_from_name(const std::string& name);

}  // namespace ricochet
