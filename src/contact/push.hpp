#pragma once
#include <array>

#include "core/vec2.hpp"

namespace ricochet {

/// A node that a cell of another surface pushes off: a stencil of at most three nodes whose forces sum to nothing. A
/// plane takes the reaction itself.
struct Push {
  int side;                 ///< whose node: 0, the pair's first body; 1, its second
  int node;                 ///< by its number in its body
  bool plane;               ///< the cell is a plane: `cell` says nothing
  std::array<int, 2> cell;  ///< the cell's nodes, by their numbers in the other body
  double along;             ///< where on the cell the closest point lies: 0 at its first node, 1 at its second
  Vec2 force;               ///< on the node, pair forces included [m0 c^2/R]
  double energy;            ///< of the repulsion [m0 c^2]

  /// Calls `use(side, node, force)` for every node of the stencil.
  template <class Use>
  void each_force(Use&& use) const {
    use(side, node, force);
    if (plane) return;
    use(1 - side, cell[0], Vec2(-(1 - along) * force));
    use(1 - side, cell[1], Vec2(-along * force));
  }
  /// The node of the first body that is pushed hardest.
  int first_bodys_node() const { return side == 0 ? node : along < 0.5 ? cell[0] : cell[1]; }
};

}  // namespace ricochet
