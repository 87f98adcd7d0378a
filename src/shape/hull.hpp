#pragma once
#include "core/vec2.hpp"

namespace ricochet {

/// The places in `points`, of which three at least lie on no line, of the corners of their convex hull,
/// counter-clockwise from the leftmost one on. Points that lie on a side to rounding are no corners.
std::vector<std::size_t> convex_hull(const Points& points);

}  // namespace ricochet
