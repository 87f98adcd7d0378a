#include "body/plan.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "shape/outline.hpp"
#include "shape/placement.hpp"

namespace ricochet {
namespace {

constexpr std::uint32_t interior_stream = 1, roughness_stream = 2;

double spacing_of(const Points& outline, const BodyNumbers& numbers) {
  return std::sqrt(signed_area(outline) / numbers.nodes);
}

void check_outline(const Points& outline) {
  if (outline.size() < 3) throw FieldError("outline", fmt::format("needs at least 3 points, has {}", outline.size()));
  for (std::size_t i = 0; i < outline.size(); ++i)
    if (!outline[i].allFinite())
      throw FieldError("outline",
                       fmt::format("point {} is not finite: ({}, {})", i + 1, outline[i].x(), outline[i].y()));
  if (!is_simple(outline))
    throw FieldError("outline", "crosses or touches itself; give its points in order along the boundary");
  // Extents whose square is no number, or nothing, would leave no spacing to place nodes by.
  const double area = signed_area(outline);
  if (!(area > 1e-100 && area < 1e100))
    throw FieldError("outline",
                     fmt::format("encloses an area of {:g} R^2; scale it to lie between 1e-100 and 1e100", area));
}

// Moves the rim's points along its normals.
void roughen(Points& rim, const BodyNumbers& numbers, const std::vector<bool>& anchored_rim) {
  Random random(static_cast<std::uint64_t>(numbers.seed), roughness_stream);
  const Points normals = outward_normals(rim);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const double height = numbers.roughness * random.normal();
    if (anchored_rim.empty() || !anchored_rim[i]) rim[i] += height * normals[i];
  }
  if (!is_simple(rim))
    throw FieldError(
        "roughness",
        fmt::format("the rough rim crosses itself (roughness {}, seed {}); lower the roughness or take another seed",
                    numbers.roughness, numbers.seed));
}

}  // namespace

Points plan_rim(const Points& outline, const BodyNumbers& numbers) {
  check_outline(outline);
  Points rim = resample(outline, spacing_of(outline, numbers));
  if (static_cast<int>(rim.size()) > numbers.nodes)
    throw FieldError("nodes", fmt::format("{} nodes cannot cover this outline, which needs {} for itself",
                                          numbers.nodes, rim.size()));
  if (!is_simple(rim))
    throw FieldError("nodes",
                     fmt::format("{} nodes are too few to follow this outline without crossing it", numbers.nodes));
  return rim;
}

NodePlan plan_nodes(const Points& outline, const BodyNumbers& numbers, const std::vector<bool>& anchored_rim) {
  NodePlan plan;
  plan.smooth_rim = plan.points = plan_rim(outline, numbers);
  plan.rim = static_cast<int>(plan.points.size());
  for (const std::size_t corner : corners_of(outline))
    for (int k = 0; k < plan.rim; ++k)
      if (plan.smooth_rim[static_cast<std::size_t>(k)] == outline[corner]) plan.corners.push_back(k);
  if (numbers.roughness > 0) roughen(plan.points, numbers, anchored_rim);
  if (numbers.rigid()) return plan;
  Random random(static_cast<std::uint64_t>(numbers.seed), interior_stream);
  const Points interior = place_interior(plan.points, placement_from_name(numbers.placement), numbers.nodes - plan.rim,
                                         spacing_of(outline, numbers), random);
  plan.points.insert(plan.points.end(), interior.begin(), interior.end());
  return plan;
}

}  // namespace ricochet
