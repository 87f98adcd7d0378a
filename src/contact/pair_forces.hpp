#pragma once
// What may act between surfaces beside the repulsion. A new one is its header and its name here.

#include <concepts>
#include <variant>

#include "contact/adhesion.hpp"

namespace ricochet {

/// A potential of a node and a cell at a distance.
template <class E>
concept PairLaw = requires(const E& law, double distance) {
  { law.energy(distance) } -> std::same_as<double>;
  { law.force(distance) } -> std::same_as<double>;
};

using PairForce = std::variant<Adhesion>;

static_assert(PairLaw<Adhesion>);

}  // namespace ricochet
