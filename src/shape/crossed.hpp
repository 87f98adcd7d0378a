#pragma once
// Meshes of a rectangle that keep their volume easily.

#include <optional>

#include "shape/size_field.hpp"
#include "shape/triangulate.hpp"

namespace ricochet {

/// A rectangle in rows and columns of smaller ones, each of four triangles about its middle. One triangle of constant
/// strain holds one volume, and a mesh of any triangles has more of them than its nodes can follow where metal flows:
/// it locks. Here the four volumes of a cell are three independent ones, as the diagonals cross on two straight lines.
/// [Nagtegaal, Parks & Rice, Comput. Methods Appl. Mech. Eng. 4, 153 (1974)]
struct CrossedGrid {
  std::vector<double> x, y;  ///< of the lines, rising [R]

  Points rim() const;                       ///< counter-clockwise from where both are least
  Points inside() const;                    ///< crossings of lines, then middles, row by row
  std::vector<Triangle> triangles() const;  ///< of the rim's points and then those inside

 private:
  int columns() const { return static_cast<int>(x.size()) - 1; }
  int rows() const { return static_cast<int>(y.size()) - 1; }
  int crossing(int column, int row) const;
};

/// With lines as far apart as `size` asks along the lowest and the leftmost side; nothing unless the outline is a
/// rectangle with sides along x and y.
std::optional<CrossedGrid> crossed_grid(const Points& outline, const SizeField& size);

}  // namespace ricochet
