#pragma once
// Friction at work in W lanes: the tangential springs of the touching nodes of both rims, and what follows their
// relative motion.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "force/contact/friction.hpp"
#include "force/lane.hpp"
#include "lattice/lattice.hpp"

namespace ricochet {

/// A rim segment that repels a rim node of the other body.
struct Touch {
  int direction, node, from, to;  ///< direction 0: node of the projectile, segment of the target; 1: the reverse
  double along;                   ///< where on the segment the closest point lies
  double load;                    ///< the repulsion [m0 c^2/R]
};

template <int W>
class Grip {
  template <int V>
  friend class Grip;

 public:
  Grip(const Friction& law, const Lattice& projectile, const Lattice& target)
      : law_(law), rims_{&projectile.rim, &target.rim} {
    for (int body : {0, 1}) {
      const Lattice& lattice = body == 0 ? projectile : target;
      before_[body].resize(lattice.nodes());
      stretch_[body].assign(static_cast<std::size_t>(lattice.nodes()), Lane<W>::Zero());
      in_touch_[body].assign(static_cast<std::size_t>(lattice.nodes()), false);
      for (std::size_t s = 0; s < lattice.spring.size(); ++s)
        mean_[body] += lattice.spring[s].stiffness / static_cast<double>(lattice.spring.size());
    }
    known_.fill(false);
  }

  /// Of a touching node's tangential spring in a lane, since its first evaluation. [m0 c^2/R^2]
  double stiffness(int lane) const { return stiffness_[lane]; }

  void clear(int lane) {
    for (auto& body : stretch_)
      for (Lane<W>& s : body) s[lane] = 0;
    lost_[lane] = 0;
    known_[lane] = false;
  }

  template <int V>
  void take(int lane, const Grip<V>& from, int from_lane) {
    for (int body : {0, 1}) {
      for (std::size_t i = 0; i < stretch_[body].size(); ++i)
        stretch_[body][i][lane] = from.stretch_[body][i][from_lane];
      for (const int i : *rims_[body]) before_[body].set(i, lane, from.before_[body].at(i, from_lane));
    }
    lost_[lane] = from.lost_[from_lane];
    stiffness_[lane] = from.stiffness_[from_lane];
    known_[lane] = from.known_[from_lane];
  }

  /// An evaluation in a lane: begin, add every touch (those of a node one after another), end.
  void begin() { touches_.clear(); }
  void add(const Touch& touch) { touches_.push_back(touch); }
  void end(int lane, Moving<W>& projectile, Moving<W>& target) {
    const std::array<Moving<W>*, 2> bodies{&projectile, &target};
    stiffness_[lane] =
        law_.stiffness * std::min(mean_[0] * projectile.stiffness[lane], mean_[1] * target.stiffness[lane]);
    for (std::size_t first = 0, last; first < touches_.size(); first = last) {
      for (last = first; last < touches_.size() && touches_[last].node == touches_[first].node &&
                         touches_[last].direction == touches_[first].direction;)
        ++last;
      hold(lane, std::span(touches_).subspan(first, last - first), *bodies[touches_[first].direction],
           *bodies[1 - touches_[first].direction]);
    }
    for (int body : {0, 1}) {
      for (const int i : *rims_[body]) {
        before_[body].set(i, lane, bodies[body]->position.at(i, lane));
        double& s = stretch_[body][static_cast<std::size_t>(i)][lane];
        if (s != 0 && !in_touch_[body][static_cast<std::size_t>(i)]) {
          lost_[lane] += stiffness_[lane] / 2 * s * s;
          s = 0;
        }  // out of reach: let go
        in_touch_[body][static_cast<std::size_t>(i)] = false;
      }
    }
    known_[lane] = true;
  }

  /// Energy lost to sliding since the impact began, and that held by the springs. [m0 c^2]
  Lane<W> lost() const { return lost_; }
  Lane<W> held() const {
    Lane<W> sum = Lane<W>::Zero();
    for (const auto& body : stretch_)
      for (const Lane<W>& s : body) sum += s * s;
    return stiffness_ / 2 * sum;
  }

 private:
  // The node's motion is taken relative to where it would be if it were fixed to the segments that repel it, each
  // weighted by its load: u = t.(u_node - sum w u_fixed), with u_fixed = (1 - a) u_from + a u_to + (turn of the
  // segment) perp(away). Forces are -k s du/du_i, so they sum to nothing and have no moment: momentum and angular
  // momentum are conserved. [here]
  void hold(int lane, std::span<const Touch> touches, Moving<W>& nodes, Moving<W>& chain) {
    const int direction = touches[0].direction, node = touches[0].node;
    const NodeVectors<W>&then = before_[direction], &chain_then = before_[1 - direction];
    struct Arm {
      Vec2 from, to;  // du/du_from, du/du_to, without the weight
    };
    Points& away = away_;
    away.resize(touches.size());
    const Vec2 place = nodes.position.at(node, lane);
    Vec2 push = Vec2::Zero();
    double loads = 0;
    for (std::size_t k = 0; k < touches.size(); ++k) {
      const Touch& touch = touches[k];
      away[k] = place - (1 - touch.along) * chain.position.at(touch.from, lane) -
                touch.along * chain.position.at(touch.to, lane);
      const double distance = away[k].norm();
      if (distance > 0) push += touch.load / distance * away[k];
      loads += touch.load;
    }
    const double load = push.norm();
    if (!(load > 0)) return;
    const Vec2 t(push.y() / load, -push.x() / load);  // +x on a wall that pushes up
    const auto arm = [&](std::size_t k) {
      const Touch& touch = touches[k];
      const Vec2 edge = chain.position.at(touch.to, lane) - chain.position.at(touch.from, lane);
      const Vec2 turn = perpendicular(away[k]).dot(t) / edge.squaredNorm() * perpendicular(edge);
      return Arm{(1 - touch.along) * t - turn, touch.along * t + turn};
    };
    double motion = t.dot(place - then.at(node, lane));
    for (std::size_t k = 0; k < touches.size(); ++k) {
      const Touch& touch = touches[k];
      const Arm a = arm(k);
      motion -= touch.load / loads *
                (a.from.dot(chain.position.at(touch.from, lane) - chain_then.at(touch.from, lane)) +
                 a.to.dot(chain.position.at(touch.to, lane) - chain_then.at(touch.to, lane)));
    }
    double& stretch = stretch_[direction][static_cast<std::size_t>(node)][lane];
    const Friction::Slid slid = law_.slide(stretch, known_[lane] ? motion : 0.0, load, stiffness_[lane]);
    stretch = slid.stretch;
    lost_[lane] += slid.lost;
    in_touch_[direction][static_cast<std::size_t>(node)] = true;
    const double force = -stiffness_[lane] * stretch;
    nodes.force.add(node, lane, force * t);
    for (std::size_t k = 0; k < touches.size(); ++k) {
      const Arm a = arm(k);
      const double share = -force * touches[k].load / loads;
      chain.force.add(touches[k].from, lane, share * a.from);
      chain.force.add(touches[k].to, lane, share * a.to);
    }
  }

  Friction law_;
  std::array<const std::vector<int>*, 2> rims_;
  std::array<NodeVectors<W>, 2> before_;         // [body] rim nodes at the last evaluation
  std::array<std::vector<Lane<W>>, 2> stretch_;  // [body][node] of the tangential springs [R]
  std::array<std::vector<bool>, 2> in_touch_;    // [body][node] in the evaluation at hand
  std::array<double, 2> mean_{};                 // [body] stiffness of its springs, relative to its number
  Lane<W> stiffness_ = Lane<W>::Zero();
  std::array<bool, W> known_{};  // before_ holds this impact
  Lane<W> lost_ = Lane<W>::Zero();
  std::vector<Touch> touches_;  // of the evaluation at hand
  Points away_;                 // of the node at hand: from the closest point of each segment
};

}  // namespace ricochet
