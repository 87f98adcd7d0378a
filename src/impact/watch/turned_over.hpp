#pragma once
#include <optional>

#include "body/inversion.hpp"
#include "impact/state.hpp"
#include "impact/watch/endings.hpp"

namespace ricochet {

/// Whether elements may have yielded in a run.
template <int W>
bool flowed(const State<W>& state, const Run& run) {
  return run.steps > 0 && state.effects.flows().any();
}

/// Whether elements that yield have turned over in a lane: their law, of logarithms, has an infinite energy on the way
/// there, which a step has leapt.
template <int W>
std::optional<ending::TurnedOver> turned_over(const State<W>& state, int lane) {
  const Flows<W>& flows = state.effects.flows();
  if (!flows.any()) return std::nullopt;
  for (std::size_t b = 0; b < state.end.size(); ++b) {
    if (!flows.of(b)) continue;
    const double share = inverted_share(state.end[b])[lane];
    if (share > 0) return ending::TurnedOver{static_cast<int>(b), share};
  }
  return std::nullopt;
}

}  // namespace ricochet
