#pragma once
// What the streams of random numbers are for (core/rng.hpp). No two purposes share one, whatever the seeds: what is
// drawn for one tells nothing of what is drawn for another.

#include <cstdint>

namespace ricochet::streams {

/// Of a body's seed: where nodes lie, how its rim is rough, its springs' strains, and the places of nodes that a rough
/// rim has left outside.
constexpr std::uint32_t interior = 1, roughness = 2, prestress = 3, redrawn = 6;

/// The lattices of a seed that were passed over had the streams before: one's lie so far from the next one's.
constexpr std::uint32_t of_a_lattice = 16;

/// Of a scene's seed: the vibrations of its first body; one more for those of the second.
constexpr std::uint32_t vibration = 4;

/// Of a seed that a user gives to draw numbers again and again.
constexpr std::uint32_t resampling = 100;

/// No lattice of a seed, however many were passed over, has the stream of a purpose that is not a body's.
constexpr bool is_of_lattice(std::uint32_t purpose) {
  const std::uint32_t place = purpose % of_a_lattice;
  return place == interior || place == roughness || place == redrawn;
}
static_assert(!is_of_lattice(prestress) && !is_of_lattice(vibration) && !is_of_lattice(vibration + 1) &&
              !is_of_lattice(resampling));

}  // namespace ricochet::streams
