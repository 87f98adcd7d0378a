#pragma once
// The sentence at the head of a report: what came out, in numbers, and no more than they carry.

#include <string>

#include "store/table.hpp"

namespace ricochet {

/// Has one of four forms, by how many impacts finished: none, one, few (below `many_impacts`), many. Means have their
/// standard errors; where two differ by less than 2 standard errors of their difference, it says that these impacts
/// cannot tell.
std::string report_sentence(const Table& table);

inline constexpr std::size_t many_impacts = 10;

}  // namespace ricochet
