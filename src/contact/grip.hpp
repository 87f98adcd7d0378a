#pragma once
// Friction at work between two bodies in W lanes: the tangential springs of the touching nodes, and what follows their
// relative motion.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "body/interior.hpp"
#include "contact/contact_laws.hpp"
#include "contact/push.hpp"
#include "core/carrier.hpp"

namespace ricochet {

/// A cell that repels a node of the other body with a load [m0 c^2/R].
struct Touch {
  Push push;
  double load;
};

template <int W>
class Grip {
 public:
  using Two = std::array<Motion<W>*, 2>;  ///< the pair's bodies

  Grip(const GripLaw& law, const Solid& first, const Solid& second) : law_(law), solids_{&first, &second} {
    for (int side : {0, 1}) {
      const Solid& solid = *solids_[side];
      before_[side].resize(solid.coordinates());
      stretch_[side].assign(static_cast<std::size_t>(solid.nodes()), Lane<W>::Zero());
      in_touch_[side].assign(static_cast<std::size_t>(solid.nodes()), false);
      mean_[side] = mean_stiffness(solid);
    }
    known_.fill(false);
  }

  /// Of a touching node's tangential spring in a lane, since its first evaluation. [m0 c^2/R^2]
  double stiffness(int lane) const { return stiffness_[lane]; }

  void clear(int lane) {
    for (auto& nodes : stretch_)
      for (Lane<W>& s : nodes) s[lane] = 0;
    lost_[lane] = 0;
    known_[lane] = false;
  }

  void carry(int lane, Carrier& carrier) {
    for (int side : {0, 1}) {
      for (Lane<W>& s : stretch_[side]) carrier.pass(s[lane]);
      for (const int i : surface_nodes(solids_[side]->surface))
        for (int d = 0; d < 2; ++d) carrier.pass(before_[side][2 * i + d][lane]);
    }
    carrier.pass(lost_[lane]);
    carrier.pass(stiffness_[lane]);
    carrier.pass_whole(known_[lane]);
  }

  /// An evaluation in a lane: begin, add every touch (those of a node one after another), end.
  void begin() { touches_.clear(); }
  void add(const Touch& touch) { touches_.push_back(touch); }
  void end(int lane, const Two& bodies) {
    stiffness_[lane] =
        law_.stiffness * std::min(mean_[0] * bodies[0]->stiffness[lane], mean_[1] * bodies[1]->stiffness[lane]);
    for (std::size_t first = 0, last; first < touches_.size(); first = last) {
      const Push& push = touches_[first].push;
      for (last = first;
           last < touches_.size() && touches_[last].push.node == push.node && touches_[last].push.side == push.side;)
        ++last;
      hold(lane, std::span(touches_).subspan(first, last - first), bodies);
    }
    for (int side : {0, 1}) let_go(lane, side, *bodies[side]);
    known_[lane] = true;
  }

  /// Energy lost to sliding since the impact began, and that held by the springs. [m0 c^2]
  Lane<W> lost() const { return lost_; }
  Lane<W> held() const {
    Lane<W> sum = Lane<W>::Zero();
    for (const auto& nodes : stretch_)
      for (const Lane<W>& s : nodes) sum += s * s;
    return stiffness_ / 2 * sum;
  }

 private:
  // How a cell's nodes take part in the motion of a node: du/du_i, without the touch's weight.
  struct Arm {
    Vec2 first, second;
  };

  // Of nodes out of reach; all remember where they are.
  void let_go(int lane, int side, const Motion<W>& body) {
    for (const int i : surface_nodes(solids_[side]->surface)) {
      before_[side].set(i, lane, body.q.at(i, lane));
      double& s = stretch_[side][static_cast<std::size_t>(i)][lane];
      if (s != 0 && !in_touch_[side][static_cast<std::size_t>(i)]) {
        lost_[lane] += stiffness_[lane] / 2 * s * s;
        s = 0;
      }
      in_touch_[side][static_cast<std::size_t>(i)] = false;
    }
  }

  // From the closest point of the touch's cell to its node.
  Vec2 away_from_cell(int lane, const Push& push, const Vec2& place, const Motion<W>& other) const {
    if (const auto* plane = std::get_if<Plane>(&other.solid->surface)) {
      const Vec2 normal = in_plane(plane->normal);
      return (normal.dot(place) - plane->offset) * normal;
    }
    return place - (1 - push.along) * other.q.at(push.cell[0], lane) - push.along * other.q.at(push.cell[1], lane);
  }

  Arm arm(int lane, const Push& push, const Vec2& away, const Vec2& t, const Motion<W>& other) const {
    const Vec2 edge = other.q.at(push.cell[1], lane) - other.q.at(push.cell[0], lane);
    const Vec2 turn = perpendicular(away).dot(t) / edge.squaredNorm() * perpendicular(edge);
    return Arm{(1 - push.along) * t - turn, push.along * t + turn};
  }

  // The direction along which the touches of a node let it slide: +x on a wall that pushes up. Gives their load.
  double tangent_of(int lane, std::span<const Touch> touches, const Vec2& place, const Motion<W>& other, Vec2& t) {
    away_.resize(touches.size());
    Vec2 pushed = Vec2::Zero();
    for (std::size_t k = 0; k < touches.size(); ++k) {
      away_[k] = away_from_cell(lane, touches[k].push, place, other);
      const double distance = away_[k].norm();
      if (distance > 0) pushed += touches[k].load / distance * away_[k];
    }
    const double load = pushed.norm();
    t = Vec2(pushed.y() / load, -pushed.x() / load);
    return load;
  }

  // The node's motion is taken relative to where it would be if it were fixed to the cells that repel it, each
  // weighted by its load: u = t.(u_node - sum w u_fixed), with u_fixed = (1 - a) u_first + a u_second + (turn of the
  // segment) perp(away); a plane does not move. Forces are -k s du/du_i, so they sum to nothing and have no moment:
  // momentum and angular momentum are conserved. [here]
  void hold(int lane, std::span<const Touch> touches, const Two& bodies) {
    const int side = touches[0].push.side, node = touches[0].push.node;
    Motion<W>&nodes = *bodies[side], &other = *bodies[1 - side];
    const Vec2 place = nodes.q.at(node, lane);
    Vec2 t;
    const double load = tangent_of(lane, touches, place, other, t);
    if (!(load > 0)) return;
    double loads = 0;
    for (const Touch& touch : touches) loads += touch.load;
    const double motion = motion_along(lane, touches, t, loads, place, other);
    double& stretch = stretch_[side][static_cast<std::size_t>(node)][lane];
    const GripLaw::Slid slid = law_.slide(stretch, known_[lane] ? motion : 0.0, load, stiffness_[lane]);
    stretch = slid.stretch;
    lost_[lane] += slid.lost;
    in_touch_[side][static_cast<std::size_t>(node)] = true;
    const double force = -stiffness_[lane] * stretch;
    push_node(nodes, lane, node, force * t);
    for (std::size_t k = 0; k < touches.size(); ++k) {
      const Push& push = touches[k].push;
      if (push.plane) continue;
      const Arm a = arm(lane, push, away_[k], t, other);
      const double share = -force * touches[k].load / loads;
      push_node(other, lane, push.cell[0], share * a.first);
      push_node(other, lane, push.cell[1], share * a.second);
    }
  }

  double motion_along(int lane, std::span<const Touch> touches, const Vec2& t, double loads, const Vec2& place,
                      const Motion<W>& other) const {
    const int side = touches[0].push.side;
    const Coordinates<W>& other_then = before_[1 - side];
    double motion = t.dot(place - before_[side].at(touches[0].push.node, lane));
    for (std::size_t k = 0; k < touches.size(); ++k) {
      const Push& push = touches[k].push;
      if (push.plane) continue;
      const Arm a = arm(lane, push, away_[k], t, other);
      motion -= touches[k].load / loads *
                (a.first.dot(other.q.at(push.cell[0], lane) - other_then.at(push.cell[0], lane)) +
                 a.second.dot(other.q.at(push.cell[1], lane) - other_then.at(push.cell[1], lane)));
    }
    return motion;
  }

  GripLaw law_;
  std::array<const Solid*, 2> solids_;
  std::array<Coordinates<W>, 2> before_;         // [side] surface nodes at the last evaluation
  std::array<std::vector<Lane<W>>, 2> stretch_;  // [side][node] of the tangential springs [R]
  std::array<std::vector<bool>, 2> in_touch_;    // [side][node] in the evaluation at hand
  std::array<double, 2> mean_{};                 // [side] stiffness inside, relative to its number
  Lane<W> stiffness_ = Lane<W>::Zero();
  std::array<bool, W> known_{};  // before_ holds this impact
  Lane<W> lost_ = Lane<W>::Zero();
  std::vector<Touch> touches_;  // of the evaluation at hand
  Points away_;                 // of the node at hand: from the closest point of each cell
};

}  // namespace ricochet
