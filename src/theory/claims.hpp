#pragma once
// What the paper claims of its simulation and its model leaves open, for `ricochet theory errata`.

#include <span>

namespace ricochet::theory {

struct Claim {
  const char* where;    ///< figure or section of the paper
  const char* printed;  ///< what it says
  const char* had;      ///< what can be had, with standard errors
  const char* by;       ///< by which reading of the model, and which command
};

std::span<const Claim> claims();

}  // namespace ricochet::theory
