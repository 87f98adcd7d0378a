#pragma once
// Which law each element of a body has: one of all, or of its own constants where nu depends on the place.

#include <utility>

#include "body/elements/elements.hpp"
#include "core/lane.hpp"

namespace ricochet {

/// The same law of all.
template <class OfAll>
struct OneLaw {
  using Law = OfAll;
  Law law;
  [[gnu::always_inline]] const Law& of(std::size_t) const { return law; }
};

/// As `law` but for Lame's constants, which are the element's. `E`: Young's modulus of each lane.
template <int W, class OfAll>
struct LawsByPlace {
  using Law = OfAll;
  Law law;
  const Lame* lame;  // [element]
  Lane<W> E;
  [[gnu::always_inline]] Law of(std::size_t element) const {
    Law own = law;
    own.lambda = lame[element].lambda * E;
    own.mu = lame[element].mu * E;
    return own;
  }
};

/// Calls `use(laws)`, laws.of(e): an element's; chosen once a sweep, so that bodies of one nu do not pay for others.
template <int W, class Law, class Use>
decltype(auto) with_laws(const Elements& elements, const Law& law, const Lane<W>& E, Use&& use) {
  if (elements.lame.empty()) return use(OneLaw<Law>{law});
  return use(LawsByPlace<W, Law>{law, elements.lame.data(), E});
}

}  // namespace ricochet
