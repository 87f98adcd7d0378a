#pragma once
// What a body shows to others: cells that join nodes, or a plane. It need be no ring: chains may be several, closed or
// open, so a body may have holes, or end at an axis of symmetry.

#include <array>
#include <variant>
#include <vector>

#include "core/vec2.hpp"
#include "core/vec3.hpp"

namespace ricochet {

/// A cell joins D nodes: a segment in the plane. By their places in Mesh::node.
template <int D>
using Cells = std::vector<std::array<int, D>>;

/// Cells stand where neighbours in number are neighbours in space: along the chains. Their inside lies to the left.
template <int D>
struct Mesh {
  std::vector<int> node;       ///< [surface node] its number in the body
  Cells<D> cell;               ///< [cell]
  std::vector<double> weight;  ///< [surface node] its share of the rim: rim_shares() or ring_shares(); empty: 1
};

/// A half-space whose inside is normal . x <= offset, of unit normal.
struct Plane {
  Vec3 normal{0, 1, 0};
  double offset = 0;  ///< [R]
};

using Surface = std::variant<Mesh<2>, Plane>;

/// The closed chain of `count` surface nodes, in their order, from the node `first` on.
Cells<2> ring(int count, int first = 0);

/// Closed chains: the outline of a body, counter-clockwise, then those of its holes, clockwise.
struct Rim {
  Points points;
  Cells<2> cells;

  const Vec2& from(std::size_t cell) const { return points[static_cast<std::size_t>(cells[cell][0])]; }
  const Vec2& to(std::size_t cell) const { return points[static_cast<std::size_t>(cells[cell][1])]; }
  void add(const Points& chain);
};

/// Half of the length of each cell at a surface node, at these places. [surface node] [R]
std::vector<double> rim_shares(const Mesh<2>& mesh, const Points& places);

/// The same of a body of revolution about the axis x = 0: of the area of each cell's ring, 2 pi l (2 x + x')/6 at the
/// end at x. [surface node] [R^2]
std::vector<double> ring_shares(const Mesh<2>& mesh, const Points& places);

/// A run of cells each of which begins where the one before ended.
struct Chain {
  std::vector<int> node;  ///< places in Mesh::node, each once
  bool closed = false;
};
std::vector<Chain> chains_of(const Cells<2>& cells);

/// The nodes of a surface, by their numbers in the body; none of a plane.
const std::vector<int>& surface_nodes(const Surface& surface);

}  // namespace ricochet
