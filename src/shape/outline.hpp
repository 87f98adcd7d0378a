#pragma once
// Closed outlines: simple polygons, their points in order, counter-clockwise, the last joined to the first.

#include "core/rng.hpp"
#include "core/vec2.hpp"
#include "shape/cell_tree.hpp"
#include "shape/size_field.hpp"

namespace ricochet {

/// Two opposite corners of an upright rectangle.
struct Box {
  Vec2 low, high;
};

/// The least box that holds all points, at least one.
Box bounding_box(const Points& points);

/// Signed area: positive if the points run counter-clockwise. [unit of length squared]
double signed_area(const Points& outline);

/// Length of the closed polygon. [unit of length]
double perimeter(const Points& outline);

/// True if no two edges of the closed polygon cross, touch or overlap except neighbours in their common corner.
bool is_simple(const Points& outline);
/// The same of the edges of several closed chains.
bool is_simple(const CellTree& chains);

/// True if the outline turns by more than 30 degrees at its point i: a corner, which the rim keeps.
bool is_corner(const Points& outline, std::size_t i);

/// True for a counter-clockwise outline without a dent.
bool is_convex(const Points& outline);

/// Even-odd rule, over all chains of a surface; points on it may fall on either side.
bool inside(const CellTree& surface, const Vec2& point);

/// True if two surfaces have area in common: an edge of one meets one of the other, or a chain lies inside the other.
bool outlines_overlap(const CellTree& a, const CellTree& b);

/// The corners of an outline: where it turns by more than 30 degrees.
std::vector<std::size_t> corners_of(const Points& outline);

/// Points along the outline, `spacing` apart as nearly as an even division allows. Corners keep their place; between
/// corners, and around an outline that has none, the points are evenly spaced by arc length.
Points resample(const Points& outline, double spacing);

/// The same with a spacing that is that of `size` everywhere. A round outline begins nearest to where it is finest.
Points resample(const Points& outline, const SizeField& size);

/// Outward unit normal at each point of a counter-clockwise outline: the direction of the mean of both edges' normals.
Points outward_normals(const Points& outline);

/// Extent of the outline along the unit vector `direction`: the largest direction . point.
double support(const Points& outline, const Vec2& direction);

}  // namespace ricochet
