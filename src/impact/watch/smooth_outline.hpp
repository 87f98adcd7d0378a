#pragma once
// The smooth outline of a body at rest: which way it faces, and how strongly it is curved.

#include <limits>
#include <vector>

#include "body/solid.hpp"
#include "contact/push.hpp"

namespace ricochet {

/// A place on a smooth outline.
struct Facing {
  static constexpr double corner = std::numeric_limits<double>::infinity();
  Vec2 normal;       ///< outward, of unit length
  double curvature;  ///< convex: above 0 [1/R]; `corner` where there is no one normal
  /// Of the sides that stand for the outline there, on average [R]; infinite where they are the surface itself: of a
  /// plane, and of a rim that is rough, whose slopes are meant.
  double side = std::numeric_limits<double>::infinity();
};

class SmoothOutline {
 public:
  explicit SmoothOutline(const Solid& solid);

  /// Where the node of a push stands on this outline, or where its cell is pushed.
  Facing at_node(const Push& push) const { return nodes_[static_cast<std::size_t>(push.node)].own; }
  Facing at_cell(const Push& push) const;
  /// A circle: it touches below its centre of mass, wherever the lattice's masses have put that.
  bool round() const { return round_; }

 private:
  /// Of a node: the normals and curvatures of the outline where it comes to it and where it goes on from it.
  struct Sides {
    Facing own{Vec2::Zero(), 0}, before{Vec2::Zero(), 0}, after{Vec2::Zero(), 0};
  };
  void face_cells(const Solid& solid, const Mesh<2>& mesh);
  bool is_round(const Solid& solid) const;

  std::vector<Sides> nodes_;  // [node], those of the surface
  Vec2 plane_ = Vec2::Zero();
  bool round_ = false;
};

/// The normal, from the target to the projectile, where two smooth outlines touch. Beside the point of touch the one
/// has turned away from the normal by s times its curvature, and the other by s times its own to the other side, so
/// that the mean of both, each weighed by the other's curvature, is the normal at the point of touch itself; of two
/// circles, the line of centres. [here] A flat side, and the side that a corner meets, count alone.
Vec2 normal_between(const Facing& projectile, const Facing& target);

/// What sides of the rims make of the bodies' motion along each other where they touch: motion towards each other.
struct Unevenness {
  double sliding = 0;  ///< of the speed at which the one slides on the other
  double rolling = 0;  ///< of the speed at which the one turns against the other [R]
};

/// Where two smooth outlines of curvatures k and k' touch, slide at u and turn at w against each other, the point of
/// touch moves along the first at (w - k' u)/(k + k') and along the second at (w + k u)/(k + k'). [kinematics of
/// rolling; e.g. Montana 1988, here in the plane] A side of length l that stands for an outline of curvature k leans
/// by k l/sqrt(12) against it, root mean square. Where two sides meet, both push, and the surface stands higher by
/// ln 2/xi, over half a side. [here] Two flat sides slide, and do not roll.
Unevenness unevenness_between(const Facing& projectile, const Facing& target, double xi);

}  // namespace ricochet
