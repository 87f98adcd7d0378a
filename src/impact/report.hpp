#pragma once
// From what was followed of a run to its outcome.

#include "effect/acting.hpp"
#include "impact/watch/endings.hpp"
#include "impact/watch/run.hpp"

namespace ricochet {

/// What a state says of one lane when its run ends.
struct LastFacts {
  std::vector<Flying> bodies;  ///< by index: at parting, what acted on since taken back
  std::vector<Flying> now;     ///< by index: at the end of the run
  Ledger ledger;
  std::vector<double> effect_energy, effect_count;                      ///< as in Outcome
  double plastic_strain_most = Outcome::undefined;                      ///< as in Outcome
  std::array<double, 2> dents{Outcome::undefined, Outcome::undefined};  ///< of projectile and target
};

Outcome report(const Run& run, const Ending& ending, const Solids& solids, const LastFacts& facts);

/// Of a scene in which the bodies pass by each other.
Outcome passes_by();

}  // namespace ricochet
