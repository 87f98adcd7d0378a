#pragma once
// What ends an impact, seen in the surfaces of two bodies: they have parted for good, or one is inside the other.

#include <cstddef>
#include <optional>

#include "core/vec2.hpp"
#include "shape/placed_surface.hpp"

namespace ricochet {

/// One body as a rigid one, relative to another.
struct RelativeFlight {
  Vec2 centre, other_centre;  ///< [R]
  Vec2 velocity;              ///< of the one relative to the other [c]
  double turning;             ///< of the one [c/R]
  double other_turning = 0;
};

/// True if the surfaces are clear of each other along the normal or along the line of centres, move apart along it, and
/// both, flying on as rigid bodies, never meet again: a spinning bar may, however fast it leaves.
bool clear_for_good(const PlacedSurface& one, const PlacedSurface& other, const RelativeFlight& flight);

/// A surface node of one body that is inside the other.
struct Intruder {
  int side;           ///< whose node: 0, the first body's; 1, the second's
  std::size_t place;  ///< in its surface
  double depth;       ///< of a node of the second: its distance from the first's surface [R]
};

/// The first surface node of one body that is inside the other; none before a plane, whose repulsion has a sign. A
/// one-sided contact pushes nodes of the first body only: a node of the second may then stand in the gap between two of
/// them, but no deeper than `gap` [R].
std::optional<Intruder> inside_one_another(const PlacedSurface& first, const PlacedSurface& second, bool two_sided,
                                           double gap);

/// How deep the deepest surface node of either body stands inside the other; 0 if none does. [R]
double deepest_inside(const PlacedSurface& first, const PlacedSurface& second);

}  // namespace ricochet
