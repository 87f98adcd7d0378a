#pragma once
// How a run can end, as facts; the sentences are made of them afterwards.

#include <optional>
#include <string>
#include <variant>

#include "impact/watch/parting.hpp"
#include "impact/watch/run.hpp"

namespace ricochet {

namespace ending {
struct Finished {
  bool touching = false;  ///< ended by time, while the bodies touched
};
struct PassedBy {};
struct NotTouched {};
struct BrokenNode {
  BodyNode node;
  bool flows;  ///< elements may have yielded before
};
struct EnergyBeyondNumbers {};
struct EnergyDrift {
  double shorter;  ///< the share of the step that would keep the tolerance, by the method's order
};
struct Unstable {
  double omega;     ///< the frequency bound [c/R]
  double expected;  ///< to which it may rise
  BodyNode node;
};
struct TurnedOver {
  int body;      ///< of elements that yield
  double share;  ///< of its area at rest
};
struct Tunnelled {
  BodyNode node;
  int other;      ///< the body that it is inside of
  bool unpushed;  ///< a one-sided contact leaves it alone
  double depth;
};
struct FlewThrough {
  double least, touch;  ///< distance that it came to; the one below which repulsion shows [R]
};
struct NotParted {
  bool rests;  ///< the bodies hardly move apart
};
}  // namespace ending

using Ending = std::variant<ending::Finished, ending::PassedBy, ending::NotTouched, ending::BrokenNode,
                            ending::EnergyBeyondNumbers, ending::EnergyDrift, ending::Unstable, ending::TurnedOver,
                            ending::Tunnelled, ending::FlewThrough, ending::NotParted>;

Status status_of(const Ending& ending);

/// Why the run ended so and what to do about it; empty if it finished apart.
std::string sentence_of(const Ending& ending, const Run& run);

}  // namespace ricochet
