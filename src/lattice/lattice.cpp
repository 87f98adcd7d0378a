#include "lattice/lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/rng.hpp"
#include "lattice/outline.hpp"

namespace ricochet {
namespace {

constexpr std::uint32_t interior_stream = 1, roughness_stream = 2;

double spacing_of(const Points& outline, const BodyNumbers& numbers) {
  return std::sqrt(signed_area(outline) / numbers.nodes);
}

}  // namespace

const std::vector<Member<BodyNumbers>>& BodyNumbers::fields() {
  static const std::vector<Member<BodyNumbers>> list{
      {{"nodes", "integer", "", "number of mass points, those on the outline included", {4, 1e7}, "800"},
       &BodyNumbers::nodes},
      {{"placement",
        "string",
        "",
        "how the interior nodes are placed",
        any_number,
        "uniform",
        false,
        {"uniform", "poisson_disk", "triangular"}},
       &BodyNumbers::placement},
      {{"seed", "integer", "", "chooses the random lattice", {0, 9007199254740992.0}, "1"}, &BodyNumbers::seed},
      {{"stiffness", "number", "m0 c^2/R^2", "spring constant ka of T = ka x + kb x^3", positive, "10000"},
       &BodyNumbers::stiffness},
      {{"quartic", "number", "1/R^2", "kb / ka; 0 makes the springs linear", not_negative, "0.001"},
       &BodyNumbers::quartic},
      {{"mass", "number", "m0", "mass of one node", positive, "1"}, &BodyNumbers::mass},
      {{"roughness", "number", "R",
        "standard deviation of the rim along its outward normal; anchored rim nodes stay smooth", not_negative, "0"},
       &BodyNumbers::roughness},
      {{"prestress",
        "number",
        "",
        "standard deviation of the springs' rest lengths over their own; the lattice is relaxed to where they balance",
        {0, 0.3},
        "0"},
       &BodyNumbers::prestress},
  };
  return list;
}

std::string Body::geometry_text() const {
  std::string outline_text, anchor_text, stiffness_text;
  for (const Vec2& p : outline) outline_text += fmt::format("{} {};", p.x(), p.y());
  for (const bool held : anchored) anchor_text += held ? '1' : '0';
  for (const double k : node_stiffness) stiffness_text += fmt::format("{};", k);
  return fmt::format(
      "outline {} anchored {} stiffness {} nodes {} placement {} seed {} roughness {} quartic {} mass {} prestress {}",
      hash_text(outline_text), hash_text(anchor_text), hash_text(stiffness_text), numbers.nodes, numbers.placement,
      numbers.seed, numbers.roughness, numbers.quartic, numbers.mass, numbers.prestress);
}

Points plan_rim(const Points& outline, const BodyNumbers& numbers) {
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
  if (numbers.roughness > 0) {
    Random random(static_cast<std::uint64_t>(numbers.seed), roughness_stream);
    const Points normals = outward_normals(plan.smooth_rim);
    for (std::size_t i = 0; i < plan.points.size(); ++i) {
      const double height = numbers.roughness * random.normal();
      if (anchored_rim.empty() || !anchored_rim[i]) plan.points[i] += height * normals[i];
    }
    if (!is_simple(plan.points))
      throw FieldError(
          "roughness",
          fmt::format("the rough rim crosses itself (roughness {}, seed {}); lower the roughness or take another seed",
                      numbers.roughness, numbers.seed));
  }
  Random random(static_cast<std::uint64_t>(numbers.seed), interior_stream);
  const Points interior = place_interior(plan.points, placement_from_name(numbers.placement), numbers.nodes - plan.rim,
                                         spacing_of(outline, numbers), random);
  plan.points.insert(plan.points.end(), interior.begin(), interior.end());
  return plan;
}

double Lattice::inertia() const {
  const Vec2 middle = centre();
  double sum = 0;
  for (const Vec2& p : points) sum += (p - middle).squaredNorm();
  return mass * sum;
}

Vec2 Lattice::centre() const {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace ricochet
