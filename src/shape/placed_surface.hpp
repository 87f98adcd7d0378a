#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "shape/cell_tree.hpp"
#include "shape/surface.hpp"

namespace ricochet {

/// A surface where it stands. All lengths in R.
class PlacedSurface {
 public:
  /// `points`: of the surface's nodes, in their order; none for a plane. Refers to the surface.
  PlacedSurface(const Surface& surface, Points points) : surface_(surface), points_(std::move(points)) {}
  PlacedSurface(const PlacedSurface&) = delete;
  PlacedSurface& operator=(const PlacedSurface&) = delete;

  const Points& points() const { return points_; }
  const Plane* plane() const { return std::get_if<Plane>(&surface_); }
  const CellTree& tree() const;  ///< of a mesh

  /// Points on the surface may fall on either side.
  bool contains(const Vec2& p) const;
  /// Of p from the nearest cell, or `least` if that is smaller; below 0 inside a plane.
  double distance(const Vec2& p, double least) const;
  /// How far inside p lies: its distance from the surface, 0 outside. An open chain has its inside to the left of its
  /// cells, and none beyond its ends. [R]
  double depth(const Vec2& p) const;
  /// The largest direction . point: infinite for a plane but along its normal.
  double support(const Vec2& direction) const;
  /// The cells at most `distance` from p, by rising number; 0 for a plane, which has one.
  void within(const Vec2& p, double distance, std::vector<int>& cells) const;
  /// The highest (or lowest) point of the surface above x; NaN beside it.
  double height(double x, bool highest) const;

 private:
  bool closed() const;  // every chain of the mesh
  double depth_behind_open_chains(const Vec2& p) const;

  const Surface& surface_;
  Points points_;
  mutable std::optional<CellTree> tree_;  // made when first asked for
  mutable std::optional<bool> closed_;
};

/// A lower bound of the distance of two surfaces: that of their bounding boxes; 0 if these overlap.
double box_distance(const PlacedSurface& a, const PlacedSurface& b);

/// The smallest distance of a node of either surface from a cell of the other, and 0 if their insides overlap.
double distance_of(const PlacedSurface& a, const PlacedSurface& b);

}  // namespace ricochet
