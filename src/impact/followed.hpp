#pragma once
// What is followed of one impact while it runs: its progress, its contact, where it broke.

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "force/catalogue.hpp"
#include "force/lane.hpp"
#include "impact/launch.hpp"
#include "impact/outcome.hpp"
#include "integrate/step_limit.hpp"
#include "lattice/lattice.hpp"

namespace ricochet {

/// What is followed of one impact while it runs.
struct Run {
  const Scene* scene = nullptr;  // nullptr: the lane is idle
  std::size_t index = 0;
  Start start;
  Ledger before;
  double energy_before = 0;
  std::array<double, effect_kinds> effects_before{};  // energies of the effects
  double reference_height = 0;  // overlap of the smooth outlines is this minus the height between the centres
  double projectile_radius = 0, target_radius = 0;
  std::int64_t steps = 0;
  bool touching = false;
  int touches = 0;
  double first_touch = 0, last_touch = 0;
  double indentation = 0;
  bool indented = false;
  double contact_length = Outcome::undefined, centre_offset = Outcome::undefined, tan_alpha = Outcome::undefined;
  double drift = 0;
  int looks = 0;
  double spring_bound =
      0;                // squared_frequency_bound of both bodies when it was last taken, the target's times slower_by^2
  BodyNode bound_node;  // the node that set it
  bool broken = false;  // a velocity is no longer finite: steps do not count from then on
  BodyNode broken_node;  // whose
  double inverted = 0, inversion_time = Outcome::undefined;
  double theta_most = 0;  // greatest step times frequency bound, springs as stretched and contact included
  double seconds = 0;     // its share of the thread's time

  double time() const { return static_cast<double>(steps) * start.step; }
};

/// A place where the projectile is pushed, and how strongly.
struct Push {
  Vec2 place;    ///< [R]
  double force;  ///< [m0 c^2/R]
};

/// Ends of a contact along x, from every push in it: those with more than 1 % of the strongest. The projectile moves
/// along +x.
struct ContactEnds {
  Vec2 trailing, leading;  ///< [R]
};
inline ContactEnds ends_of(const std::vector<Push>& pushes, double strongest) {
  std::optional<Vec2> a, b;
  for (const Push& p : pushes) {
    if (p.force < 0.01 * strongest) continue;
    if (!a || p.place.x() < a->x()) a = p.place;
    if (!b || p.place.x() > b->x()) b = p.place;
  }
  return {*a, *b};
}

/// The node where a lane ceased to be finite. A node that is not finite takes its neighbours along in the same
/// evaluation, so the one with the most of them is where it began.
template <int W>
BodyNode where_it_broke(const std::array<Moving<W>, 2>& bodies, int lane) {
  BodyNode where;
  int most = -1;
  for (int b : {0, 1}) {
    const Lattice& lattice = *bodies[b].lattice;
    const auto lost = [&](int i) {
      return i < lattice.free && !(bodies[b].position.at(i, lane) + bodies[b].velocity.at(i, lane)).allFinite();
    };
    std::vector<int> neighbours(static_cast<std::size_t>(lattice.nodes()));
    for (int i = 0; i < lattice.free; ++i)
      for (int s = lattice.first[i]; s < lattice.first[i + 1]; ++s) {
        const int j = lattice.spring[s].other;
        neighbours[i] += lost(j);
        neighbours[j] += lost(i);
      }
    for (int i = 0; i < lattice.free; ++i)
      if (lost(i) && neighbours[i] > most) {
        most = neighbours[i];
        where = {b, i};
      }
  }
  return where;
}

}  // namespace ricochet
