#pragma once
#include <string>
#include <vector>

#include "impact/scene.hpp"

namespace ricochet {

/// Places of at most `most` scenes of a list, so that each quantity in which they differ (speeds, angle, spin, place of
/// landing, lattice, effects) is met from its least to its greatest value, as evenly as so few can. The same for any
/// order of a sweep's lists.
std::vector<std::size_t> spread_over(const std::vector<const Scene*>& scenes, std::size_t most);

}  // namespace ricochet
