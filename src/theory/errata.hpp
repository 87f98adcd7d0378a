#pragma once
// Slips of the paper (and of what is often quoted), for `ricochet theory errata`.

#include <span>

namespace ricochet::theory {

struct Misprint {
  const char* where;  ///< equation label of the paper's source, or section
  const char* printed;
  const char* right;
  const char* checked;  ///< how; tests are in tests/theory
};

std::span<const Misprint> errata();

}  // namespace ricochet::theory
