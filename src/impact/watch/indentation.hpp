#pragma once
// How the projectile lies on the target, read from what pushes it.

#include <optional>
#include <vector>

#include "contact/contacts.hpp"
#include "impact/axes.hpp"
#include "impact/watch/run.hpp"

namespace ricochet {

/// A place where the projectile is pushed, and how strongly.
struct PushedPlace {
  Vec2 place;    ///< [R]
  double force;  ///< [m0 c^2/R]
};

/// Ends of a contact along the surface, from every push in it: those with more than 1 % of the strongest.
struct ContactEnds {
  Vec2 left, right;  ///< [R]
};
inline ContactEnds contact_ends(const std::vector<PushedPlace>& pushes, double strongest) {
  std::optional<Vec2> a, b;
  for (const PushedPlace& p : pushes) {
    if (p.force < 0.01 * strongest) continue;
    if (!a || tangential(p.place) < tangential(*a)) a = p.place;
    if (!b || tangential(p.place) > tangential(*b)) b = p.place;
  }
  return {*a, *b};
}

/// Takes the contact's shape if there is one now; that of a body of revolution is as wide on either side of its axis.
/// `centre`: of the projectile, along the surface.
template <int W>
void measure_contact(const Pair<W>& pair, int lane, const Motions<W>& bodies, double centre, double overlap, Run& run) {
  std::vector<PushedPlace> pushes;
  double strongest = 0;
  const Motion<W>& first = bodies[static_cast<std::size_t>(pair.body(0))];
  pair.each(lane, bodies, [&](const Push& push) {
    pushes.push_back({first.q.at(push.first_bodys_node(), lane), push.force.norm()});
    strongest = std::max(strongest, pushes.back().force);
  });
  if (strongest * run.start.contact.reach < run.threshold) return;  // between two touches
  auto [a, b] = contact_ends(pushes, strongest);
  if (first.solid->axisymmetric) a = {-tangential(b), normal(b)};
  const bool leftwards = tangential(run.start.bodies[role::projectile].velocity) < 0;
  Indentation& i = run.indentation;
  i.seen = true;
  i.depth = overlap;
  i.length = tangential(b) - tangential(a);
  i.centre_offset = std::abs(centre - tangential(leftwards ? b : a));
  i.tan_alpha =
      i.length > 0 ? (leftwards ? normal(a) - normal(b) : normal(b) - normal(a)) / i.length : Outcome::undefined;
}

}  // namespace ricochet
