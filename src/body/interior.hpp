#pragma once
// What holds a body together, seen from outside: springs, elements, modes of either, or nothing inside that moves. A
// further interior is one more type in Interior (body/solid.hpp) and one more answer to each of these questions. The
// choice is made once a sweep.

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "body/elements/bound.hpp"
#include "body/elements/sweep.hpp"
#include "body/modal/sweep.hpp"
#include "body/motion.hpp"
#include "body/springs/bound.hpp"
#include "body/springs/sweep.hpp"

namespace ricochet {

static_assert(std::variant_size_v<Interior> == 4, "a further interior must answer every question of this file");

/// v += kick F/m, x += drift v of all that moves; F: of the interior, and what `f` holds, which this empties.
template <int W>
void kick_and_drift(Motion<W>& body, const Lane<W>& kick, const Lane<W>& drift) {
  if (const Springs* springs = body.solid->springs())
    kick_and_drift<2>(body, *springs, kick, drift);
  else if (const Elements* elements = body.solid->elements())
    kick_and_drift(body, *elements, kick, drift);
  else if (const Modes* modes = body.solid->modes())
    kick_and_drift(body, *modes, kick, drift);
}

/// x += by v, of what moves; modes turn.
template <int W>
void drift(Motion<W>& body, const Lane<W>& by) {
  if (const Modes* modes = body.solid->modes()) return drift(body, *modes, by);
  for (int c = 0; c < body.solid->free_coordinates(); ++c) body.q[c] += by * body.v[c];
}

/// Whether a team sweeps it sooner than one thread. Modes are few; what yields sums its loss in one order, by one.
inline bool worth_sharing(const Solid& solid) {
  if (const Springs* springs = solid.springs()) return springs->list.size() >= least_shared;
  return solid.elements() && solid.elements()->nodes.size() >= least_shared;
}

/// How a team shares the sweep over a body of springs or elements that do not yield.
inline Sharing sharing_of(const Solid& solid, Team& team) {
  const auto sharing = [&](const std::vector<int>& first, const auto& nodes) {
    return Sharing{&team, shares_of(first, solid.free, solid.nodes(), team.size(), nodes)};
  };
  if (const Elements* elements = solid.elements()) return sharing(elements->first, elements->nodes.data());
  const Springs& springs = std::get<Springs>(solid.interior);
  return sharing(springs.first, springs.list.ends());
}

/// What other parts may read of a body between two steps: of one of modes, the nodes inside it are placed.
template <int W>
void settle(Motion<W>& body) {
  if (const Modes* modes = body.solid->modes()) settle(body, *modes);
}

/// Potential energy of the interior, above that at rest. [m0 c^2]
template <int W>
Lane<W> interior_energy(const Motion<W>& body) {
  if (const Springs* springs = body.solid->springs()) return spring_energy<2>(body, *springs);
  if (const Elements* elements = body.solid->elements()) return element_energy(body, *elements);
  if (const Modes* modes = body.solid->modes()) return modal_energy(body, *modes, false);
  return Lane<W>::Zero();
}

/// Energy that the interior holds at rest, by prestress. [R^2, per unit of the body's stiffness]
inline double rest_energy(const Solid& solid) { return solid.springs() ? solid.springs()->rest_energy : 0; }

/// No vibration of the body at rest is faster.
inline FrequencyBound frequency_bound(const Solid& solid, double stiffness) {
  if (const Springs* springs = solid.springs()) return frequency_bound(solid, *springs, stiffness);
  if (const Elements* elements = solid.elements()) return frequency_bound(solid, *elements, stiffness);
  if (const Modes* modes = solid.modes()) return {std::sqrt(stiffness) * modes->omega.back(), modes->fastest_node};
  return {};
}

/// The same as the body is deformed now, in W lanes.
template <int W>
SquaredBounds<W> squared_frequency_bound(const Motion<W>& body) {
  if (const Springs* springs = body.solid->springs()) return squared_frequency_bound(body, *springs);
  if (const Elements* elements = body.solid->elements()) return squared_frequency_bound(body, *elements);
  SquaredBounds<W> bounds;
  if (const Modes* modes = body.solid->modes())
    bounds.raise(body.stiffness * (modes->omega.back() * modes->omega.back()), modes->fastest_node);
  return bounds;
}
/// rest(s, x): what is left of spring s at a stretch x.
template <int W, class Rest>
SquaredBounds<W> squared_frequency_bound(const Motion<W>& body, Rest&& rest) {
  if (const Springs* springs = body.solid->springs()) return squared_frequency_bound(body, *springs, rest);
  return squared_frequency_bound(body);
}

/// Modes have forces along themselves, and none at nodes.
inline void expect_nodes(const Solid& solid) {
  if (solid.modes()) throw std::logic_error("forces at the nodes of a body of modes");
}

/// Forces of the interior alone, which is not of modes. [m0 c^2/R]
template <int W>
Coordinates<W> interior_forces(const Motion<W>& body) {
  expect_nodes(*body.solid);
  Coordinates<W> force;
  force.resize(body.solid->coordinates());
  if (const Springs* springs = body.solid->springs())
    add_spring_forces<2>(body, *springs, force);
  else if (const Elements* elements = body.solid->elements())
    add_element_forces(body, *elements, force);
  return force;
}

/// K w: K the second derivatives of the energy of the interior, which is not of modes, where the body is, w along its
/// coordinates.
template <int W>
Coordinates<W> stiffness_times(const Motion<W>& body, const Coordinates<W>& w) {
  expect_nodes(*body.solid);
  Coordinates<W> product;
  product.resize(body.solid->coordinates());
  if (const Springs* springs = body.solid->springs())
    add_stiffness_times<2>(body, *springs, w, product);
  else if (const Elements* elements = body.solid->elements())
    add_stiffness_times(body, *elements, w, product);
  return product;
}

/// Mean stiffness of what a node hangs on, relative to the body's stiffness; infinite in a rigid body. Elements count
/// as the springs of a triangular lattice of their modulus, k = sqrt(3)/2 E.
inline double mean_stiffness(const Solid& body) {
  const Solid& solid = body.joined();
  if (const Elements* elements = solid.elements()) {
    double area = 0;
    for (const Triangle& nodes : elements->nodes) area += measure_at_rest(solid, nodes);
    return std::sqrt(0.75) * std::accumulate(elements->weight.begin(), elements->weight.end(), 0.0) / area;
  }
  const Springs* springs = solid.springs();
  if (!springs) return std::numeric_limits<double>::infinity();
  double mean = 0;
  const SpringList& list = springs->list;
  for (std::size_t s = 0; s < list.size(); ++s) mean += list[s].stiffness / static_cast<double>(list.size());
  return mean;
}

/// How many evaluations of single springs a sweep takes as much time as; an element takes that of two, a mode a third
/// of one for each coordinate of the surface.
inline double work_of_sweep(const Solid& solid) {
  if (const Modes* modes = solid.modes())
    return static_cast<double>(modes->omega.size()) * modes->rim.coordinates() / 3;
  if (const Elements* elements = solid.elements()) return 2.0 * elements->size();
  return solid.springs() ? static_cast<double>(solid.springs()->list.size()) : 0;
}

/// Calls `use(i, j)` for every two nodes that the interior joins.
template <class Use>
void each_joint(const Solid& body, Use&& use) {
  const Solid& solid = body.joined();
  if (const Springs* springs = solid.springs())
    each_spring(*springs, solid.free, [&](int i, int, const Spring& spring) { use(i, spring.other); });
  if (const Elements* elements = solid.elements())
    for (const auto& [i, j] : elements->edge) use(i, j);
}

/// Pushes a node of one lane: f += J^T F, which for nodes is the force itself.
template <int W>
void push_node(Motion<W>& body, int lane, int node, const Vec2& force) {
  body.f.add(node, lane, force);
}

}  // namespace ricochet
