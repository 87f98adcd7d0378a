#pragma once
// The contact of two bodies in W lanes. It answers for itself: what it pushes, what energy it holds, whether it is
// apart.

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "contact/candidates.hpp"
#include "contact/contact_laws.hpp"
#include "contact/gaps.hpp"
#include "contact/grip.hpp"
#include "contact/push.hpp"
#include "shape/closest.hpp"

namespace ricochet {

/// A node of one of the bodies, by index.
struct BodyNode {
  int body = 0, node = 0;
};

/// Where contact is stiffest.
struct Stiffest {
  double omega2 = 0;  ///< stiffness over mass [c^2/R^2]
  BodyNode node;

  void raise(double value, const BodyNode& at) {
    if (!(value > omega2)) return;
    omega2 = value;
    node = at;
  }
};

/// Nodes of the first body against cells of the second and, where the lane's law is two-sided, the other way round.
template <int W>
class Pair {
 public:
  Pair(int first, int second, const Solid& of_first, const Solid& of_second, const ContactLaws& laws)
      : body_{first, second}, solid_{&of_first, &of_second}, laws_(laws) {
    if (laws.grip) grip_.emplace(*laws.grip, of_first, of_second);
    allowance_.setConstant(std::numeric_limits<double>::infinity());
    of_modes_ = of_first.modes() || of_second.modes();
    for (const Solid* solid : solid_)
      if (solid->free > 0) lightest_ = std::min(lightest_, solid->mass.lightest());
  }

  int body(int side) const { return body_[side]; }
  bool holds(int body) const { return body == body_[0] || body == body_[1]; }

  /// Puts a law into a lane; the next evaluation looks for candidates. No law (nullptr) leaves the lane without
  /// contact.
  void set(int lane, const ExponentialRepulsion* law) {
    law_[lane] = law;
    stiffest_[at(lane)].omega2 = 0;
    allowance_[lane] = law ? -1.0 : std::numeric_limits<double>::infinity();
    for (auto& candidates : candidates_[lane]) candidates.clear();
    if (grip_) grip_->clear(lane);
  }
  const ExponentialRepulsion* law(int lane) const { return law_[lane]; }

  /// Passes on what is remembered of an impact, after set().
  void carry(int lane, Carrier& carrier) {
    if (grip_) grip_->carry(lane, carrier);
    Stiffest& stiffest = stiffest_[at(lane)];
    carrier.pass(stiffest.omega2);
    carrier.pass_whole(stiffest.node.body);
    carrier.pass_whole(stiffest.node.node);
  }

  /// The candidates of a lane hold every node and cell within reach until both surfaces together have moved so far.
  const Lane<W>& allowance() const { return allowance_; }
  void take_off(int lane, double moved) { allowance_[lane] -= moved; }
  void rebuild(int lane, const PlacedSurface& first, const PlacedSurface& second) {
    const double reach = law_[lane]->reach, skin = laws_.skin * reach;
    const double gap = box_distance(first, second) - reach;
    for (auto& candidates : candidates_[lane]) candidates.clear();
    allowance_[lane] = gap > skin ? gap : skin;
    if (gap > skin) return;
    candidates_[lane][0] = by_numbers(0, candidates_within(first.points(), second, reach + skin));
    if (law_[lane]->two_sided() && !first.plane())
      candidates_[lane][1] = by_numbers(1, candidates_within(second.points(), first, reach + skin));
  }

  /// Adds the contact's forces at the bodies' places, whose candidates are known, to their `f`; returns the energy of
  /// the repulsion in each lane. [m0 c^2]
  Lane<W> push(Motions<W>& bodies) {
    Lane<W> energy = Lane<W>::Zero();
    for (int lane = 0; lane < W; ++lane) {
      if (candidates_[lane][0].empty() && candidates_[lane][1].empty()) continue;
      const double xi = law_[lane]->xi;
      int node = -1;
      double on_node = 0, light = 0, together = 0;
      Stiffest stiffest;
      energy[lane] = each(lane, bodies, [&](const Push& push) {
        const double repulsion = xi * push.energy;
        on_node = push.node == node ? on_node + repulsion : repulsion;
        light = push.node == node ? std::min(light, lightest(push)) : lightest(push);
        node = push.node;  // cells of a node stand together
        stiffest.raise(xi * on_node / light, {body_[push.side], push.node});
        if (of_modes_) together += xi * repulsion * give(push);
        push_apart(push, lane, bodies);
      });
      // Few modes move neighbours alike: no faster than by all the stiffness at once.
      if (of_modes_) stiffest.omega2 = std::min(stiffest.omega2, together);
      stiffest_[at(lane)].raise(stiffest.omega2, stiffest.node);
    }
    if (grip_) hold(*grip_, bodies);
    return energy;
  }

  /// The greatest stiffness, xi F and that of friction, that contact put on one node in any evaluation since this was
  /// last asked, over the mass of the lightest node that moves with it. [c^2/R^2]
  double take_stiffest(int lane) {
    const double stiffest = std::exchange(stiffest_[at(lane)].omega2, 0.0);
    return stiffest > 0 && grip_ ? stiffest + grip_->stiffness(lane) / lightest_ : stiffest;
  }
  /// Which node that was.
  BodyNode stiffest_node(int lane) const { return stiffest_[at(lane)].node; }

  /// Energy of the repulsion in each lane. [m0 c^2]
  Lane<W> energy(const Motions<W>& bodies) const {
    Lane<W> sum = Lane<W>::Zero();
    for (int lane = 0; lane < W; ++lane) sum[lane] = each(lane, bodies, [](const Push&) {});
    return sum;
  }

  /// Energy of a pair force beside it. [m0 c^2]
  Lane<W> energy_of(std::size_t force, const Motions<W>& bodies) const {
    Lane<W> sum = Lane<W>::Zero();
    std::visit(
        [&](const auto& law) {
          for (int lane = 0; lane < W; ++lane)
            each(lane, bodies, [&](const Push& push) { sum[lane] += law.energy(distance(push, lane, bodies)); });
        },
        laws_.forces[force]);
    return sum;
  }

  /// Adds the forces of contact, friction included, to a lane of copies of the bodies; nothing else changes.
  void push_copies(int lane, Motions<W>& copies) const {
    each(lane, copies, [&](const Push& push) { push_apart(push, lane, copies); });
    if (!grip_) return;
    Grip<W> grip = *grip_;
    hold(grip, copies);
  }

  struct GripEnergies {
    Lane<W> lost = Lane<W>::Zero(), held = Lane<W>::Zero();
  };
  /// What friction would have taken if it were evaluated in these places. The bodies are copies: they collect forces
  /// that nobody reads.
  GripEnergies grip_energies(Motions<W>& copies) const {
    if (!grip_) return {};
    Grip<W> grip = *grip_;
    hold(grip, copies);
    return {grip.lost(), grip.held()};
  }

  /// Energy of the repulsion in a lane, the bodies having gone back by a time along their velocities. [m0 c^2]
  double energy_before(int lane, const Motions<W>& bodies, double time) const {
    return each(
        lane, bodies, [](const Push&) {}, time);
  }

  /// Calls `use(push)` for every node and cell of a lane within reach, in a fixed order; returns their energy. `back`:
  /// of the places, along the velocities [R/c].
  template <class Use>
  double each(int lane, const Motions<W>& bodies, Use&& use, double back = 0) const {
    if (!law_[lane]) return 0;
    double sum = 0;
    for (int side = 0; side < 2; ++side) {
      const std::vector<Near>& candidates = candidates_[lane][side];
      if (candidates.empty()) continue;
      const auto* plane = std::get_if<Plane>(&solid_[1 - side]->surface);
      gather(side, lane, candidates, bodies, plane == nullptr);
      if (back != 0) go_back(side, lane, candidates, bodies, plane == nullptr, back);
      measure(gaps_, *law_[lane], laws_.forces, plane);
      if (!law_[lane]->sums() && !plane) choose(*law_[lane], candidates);
      for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (gaps_.energy[i] == 0) continue;
        sum += gaps_.energy[i];
        use(Push{side, candidates[i].node, plane != nullptr, candidates[i].cell, gaps_.along[i],
                 Vec2(gaps_.fx[i], gaps_.fy[i]), gaps_.energy[i]});
      }
    }
    return sum;
  }

  /// True if no node of the lane is within reach of a cell.
  bool apart(int lane, const Motions<W>& bodies) const {
    bool any = false;
    each(lane, bodies, [&](const Push&) { any = true; });
    return !any;
  }

 private:
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }

  /// A candidate by the numbers of its nodes in their bodies: looked up once, not in every evaluation.
  struct Near {
    int node;
    std::array<int, 2> cell;  ///< of a plane: -1
    int place;                ///< of the node in its surface
  };

  std::vector<Near> by_numbers(int side, const std::vector<Candidate>& candidates) const {
    const std::vector<int>& nodes = surface_nodes(solid_[side]->surface);
    const auto* mesh = std::get_if<Mesh<2>>(&solid_[1 - side]->surface);
    std::vector<Near> list;
    for (const Candidate& c : candidates)
      list.push_back(
          {nodes[static_cast<std::size_t>(c.node)], mesh ? ends_of(*mesh, c.cell) : std::array{-1, -1}, c.node});
    return list;
  }

  static std::array<int, 2> ends_of(const Mesh<2>& mesh, int cell) {
    const auto& [a, b] = mesh.cell[static_cast<std::size_t>(cell)];
    return {mesh.node[static_cast<std::size_t>(a)], mesh.node[static_cast<std::size_t>(b)]};
  }

  // Places of the candidates' nodes and of their cells' ends.
  void gather(int side, int lane, const std::vector<Near>& candidates, const Motions<W>& bodies, bool ends) const {
    const Coordinates<W>& nodes = bodies[static_cast<std::size_t>(body_[side])].q;
    const Coordinates<W>& cells = bodies[static_cast<std::size_t>(body_[1 - side])].q;
    gaps_.resize(candidates.size());
    gaps_.weight.clear();
    const std::vector<double>& weight = std::get<Mesh<2>>(solid_[side]->surface).weight;
    if (law_[lane]->by_length)
      for (const Near& c : candidates) gaps_.weight.push_back(weight[static_cast<std::size_t>(c.place)]);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      gaps_.px[i] = nodes[2 * candidates[i].node][lane];
      gaps_.py[i] = nodes[2 * candidates[i].node + 1][lane];
    }
    if (!ends) return;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const auto [a, b] = candidates[i].cell;
      gaps_.ax[i] = cells[2 * a][lane];
      gaps_.ay[i] = cells[2 * a + 1][lane];
      gaps_.bx[i] = cells[2 * b][lane];
      gaps_.by[i] = cells[2 * b + 1][lane];
    }
  }

  // By a rule that does not sum, which pushes are left, and where to.
  void choose(const ExponentialRepulsion& law, const std::vector<Near>& candidates) const {
    std::vector<int> node;
    for (const Near& c : candidates) node.push_back(c.node);
    keep_nearest(gaps_, node);
    if (law.rule == "spring_normal") turn_to_normals(gaps_, law);
  }

  // The places gathered, by a time along the velocities.
  void go_back(int side, int lane, const std::vector<Near>& candidates, const Motions<W>& bodies, bool ends,
               double time) const {
    const Coordinates<W>& nodes = bodies[static_cast<std::size_t>(body_[side])].v;
    const Coordinates<W>& cells = bodies[static_cast<std::size_t>(body_[1 - side])].v;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      gaps_.px[i] -= time * nodes[2 * candidates[i].node][lane];
      gaps_.py[i] -= time * nodes[2 * candidates[i].node + 1][lane];
      if (!ends) continue;
      const auto [a, b] = candidates[i].cell;
      gaps_.ax[i] -= time * cells[2 * a][lane];
      gaps_.ay[i] -= time * cells[2 * a + 1][lane];
      gaps_.bx[i] -= time * cells[2 * b][lane];
      gaps_.by[i] -= time * cells[2 * b + 1][lane];
    }
  }

  // Of the nodes of a push, those that move. [m0]
  double lightest(const Push& push) const {
    double least = std::numeric_limits<double>::infinity();
    push.each_force([&](int side, int node, const Vec2&) {
      const Solid& solid = *solid_[at(side)];
      if (node < solid.free) least = std::min(least, solid.mass[node]);
    });
    return least;
  }

  // How far a push drives its nodes apart for each unit of its force: of either body by the node that gives most.
  // [1/m0]
  double give(const Push& push) const {
    std::array<double, 2> most{};
    push.each_force([&](int side, int node, const Vec2&) {
      const Solid& solid = *solid_[at(side)];
      if (node >= solid.free) return;
      const double gives = solid.modes() ? solid.modes()->give[at(node)] : 1 / solid.mass[node];
      most[at(side)] = std::max(most[at(side)], gives);
    });
    return most[0] + most[1];
  }

  void push_apart(const Push& push, int lane, Motions<W>& bodies) const {
    push.each_force([&](int side, int node, const Vec2& force) {
      push_node(bodies[static_cast<std::size_t>(body_[side])], lane, node, force);
    });
  }

  double distance(const Push& push, int lane, const Motions<W>& bodies) const {
    const Coordinates<W>& nodes = bodies[static_cast<std::size_t>(body_[push.side])].q;
    const Coordinates<W>& cells = bodies[static_cast<std::size_t>(body_[1 - push.side])].q;
    const Vec2 place = nodes.at(push.node, lane);
    if (const auto* plane = std::get_if<Plane>(&solid_[1 - push.side]->surface))
      return plane->normal.dot(in_space(place)) - plane->offset;
    return closest(place, cells.at(push.cell[0], lane), cells.at(push.cell[1], lane)).distance;
  }

  // Friction at the bodies' places.
  void hold(Grip<W>& grip, Motions<W>& bodies) const {
    for (int lane = 0; lane < W; ++lane) {
      if (!law_[lane]) continue;
      grip.begin();
      each(lane, bodies, [&](const Push& push) { grip.add({push, law_[lane]->xi * push.energy}); });
      grip.end(lane, {&bodies[static_cast<std::size_t>(body_[0])], &bodies[static_cast<std::size_t>(body_[1])]});
    }
  }

  std::array<int, 2> body_;
  std::array<const Solid*, 2> solid_;
  ContactLaws laws_;
  Lane<W> allowance_;
  std::array<const ExponentialRepulsion*, W> law_{};
  std::array<std::array<std::vector<Near>, 2>, W> candidates_;  // [lane][side]
  std::array<Stiffest, W> stiffest_{};
  bool of_modes_ = false;                                      // one of the bodies
  double lightest_ = std::numeric_limits<double>::infinity();  // of the masses that move [m0]
  std::optional<Grip<W>> grip_;
  mutable Gaps gaps_;  // of the lane at hand; kept for its memory
};

}  // namespace ricochet
