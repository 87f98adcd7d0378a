#pragma once
#include <optional>
#include <vector>

#include "contact/friction.hpp"
#include "contact/pair_forces.hpp"

namespace ricochet {

using GripLaw = Friction;

/// What acts between surfaces beside the repulsion, in all lanes.
struct ContactLaws {
  std::vector<PairForce> forces;
  std::optional<GripLaw> grip;
  double skin = 0.5;  ///< how far beyond the reach candidates are kept, over the reach; changes no bit
};

}  // namespace ricochet
