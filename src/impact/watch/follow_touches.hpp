#pragma once
// What is followed of touches after every step.

#include <algorithm>

#include "impact/axes.hpp"
#include "impact/state.hpp"
#include "impact/watch/run.hpp"

namespace ricochet {

/// The load of a contact below which nothing touches [m0 c^2]: a share of the energy of the bodies' motion towards each
/// other, at their reduced mass; less than what the reach cuts off cannot be told.
inline double least_load(const Start& start, const Solids& solids) {
  const Solid &projectile = *solids[role::projectile], &target = *solids[role::target];
  const double towards = normal(start.bodies[role::projectile].velocity) - normal(start.bodies[role::target].velocity);
  const double mass = projectile.total_mass(), other = target.total_mass();
  const double reduced = target.anchored() ? mass : mass * other / (mass + other);
  return std::max(touch_share * reduced * towards * towards / 2, cut_share * start.energy);
}

/// Asks for looks at the aimed pair beside the usual ones: at the greatest load of a touch so short that it falls
/// between two of them, and where a touch ends that may be the first parting. `nearby`: the load, about; `began`,
/// `ended`: a touch, by this step.
inline void ask_for_looks(Run& run, double nearby, bool began, bool ended) {
  const TouchClock& clock = run.clock();
  ContactFrame& frame = run.frame;
  if (began) {
    frame.heaviest = 0;
    frame.asked = false;
  }
  const bool falls = clock.touching() && nearby < clock.greatest();
  if (!frame.asked && falls && frame.heaviest < clock.greatest() / 2) run.due.frame = frame.asked = true;
  if (ended && frame.heaviest == 0) run.due.frame = true;
  if (ended && !run.first_parting && clock.last_counts()) run.due.parting = true;
}

/// When a touch has just ended, of bodies that fly so. While they still approach, it was that of an asperity before the
/// others.
inline void keep_first_parting(Run& run, const Flying& projectile, const Flying& target) {
  if (!(normal(in_plane(projectile.velocity - target.velocity)) > 0)) return;
  run.first_parting = {projectile, target};
  run.first_parting_time = run.clock().end();
}

template <int W>
void follow_touches(const State<W>& state, int lane, Run& run) {
  for (std::size_t p = 0; p < run.clocks.size(); ++p) {
    TouchClock& clock = run.clocks[p];
    const double nearby = state.contact_energy[p][lane];
    const bool before = clock.touching();
    const bool ended = clock.wants(nearby) && clock.follow({run.time(), state.contact_energy_at_end(p, lane)});
    if (p == role::aimed_pair) ask_for_looks(run, nearby, clock.touching() && !before, ended);
  }
}

}  // namespace ricochet
