#pragma once
// A lane is one of W impacts that advance together; a Lane<W> holds one quantity of all of them and is written like a
// number. Every operation on it is element by element and IEEE exact or correctly rounded, so an impact has the same
// bits alone (W = 1) and in any batch.

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "core/vec2.hpp"

namespace ricochet {

template <int W>
using Lane = Eigen::Array<double, W, 1>;

/// W, chosen when the project is configured. 4 doubles fill an AVX2 register.
inline constexpr int lanes = RICOCHET_LANES;
#ifdef EIGEN_VECTORIZE_AVX512
static_assert(
    lanes < 8,
    "Eigen 3.4 estimates the square root of eight numbers on AVX-512, in other bits; configure with RICOCHET_LANES=4");
#endif

/// A vector of every node in every lane: [node][x|y][lane].
template <int W>
class NodeVectors {
 public:
  void resize(int nodes) { values_.assign(2 * nodes, Lane<W>::Zero()); }
  Lane<W>& x(int node) { return values_[2 * node]; }
  Lane<W>& y(int node) { return values_[2 * node + 1]; }
  const Lane<W>& x(int node) const { return values_[2 * node]; }
  const Lane<W>& y(int node) const { return values_[2 * node + 1]; }
  Vec2 at(int node, int lane) const { return {x(node)[lane], y(node)[lane]}; }
  void set(int node, int lane, const Vec2& v) {
    x(node)[lane] = v.x();
    y(node)[lane] = v.y();
  }
  void add(int node, int lane, const Vec2& v) {
    x(node)[lane] += v.x();
    y(node)[lane] += v.y();
  }
  int nodes() const { return static_cast<int>(values_.size() / 2); }

  /// [2 node + (0: x, 1: y)], for a hot loop: a pointer in a local variable is not reloaded after every store.
  Lane<W>* data() { return values_.data(); }
  const Lane<W>* data() const { return values_.data(); }

 private:
  std::vector<Lane<W>> values_;
};

/// One body in motion, in W lanes. `force` collects what acts on a node until its kick, which empties it; on an
/// anchored node, which is never kicked, it only grows, and only moving anchors are asked for it.
template <int W>
struct Moving {
  const struct Lattice* lattice = nullptr;
  NodeVectors<W> position, velocity, force;
  Lane<W> stiffness = Lane<W>::Zero();  ///< ka of each lane [m0 c^2/R^2]
  Lane<W> pulse =
      Lane<W>::Zero();  ///< sum of the free nodes' velocities at the last kick: finite as long as they all are
};

/// True if what acts on "projectile", "target" or "both" acts on body 0 (the projectile) or 1.
inline bool acts_on(std::string_view on, int body) {
  return on == "both" || on == (body == 0 ? "projectile" : "target");
}

}  // namespace ricochet
