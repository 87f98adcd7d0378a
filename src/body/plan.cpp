#include "body/plan.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "body/given_nodes.hpp"
#include "body/hull_nodes.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/streams.hpp"
#include "core/turn.hpp"
#include "shape/crossed.hpp"
#include "shape/mesh.hpp"
#include "shape/outline.hpp"
#include "shape/placement.hpp"

namespace ricochet {
namespace {

// The lattices of a seed that were passed over had others.
Random random_of(const Body& body, std::uint32_t purpose) {
  return {static_cast<std::uint64_t>(body.numbers.seed),
          purpose + streams::of_a_lattice * static_cast<std::uint32_t>(body.passed_over)};
}

// `what`: of several outlines, which.
void check_outline(const Points& outline, const char* field, const std::string& what) {
  const auto refuse = [&](const std::string& message) { throw FieldError(field, what + message); };
  if (outline.size() < 3) refuse(fmt::format("needs at least 3 points, has {}", outline.size()));
  for (std::size_t i = 0; i < outline.size(); ++i)
    if (!outline[i].allFinite())
      refuse(fmt::format("point {} is not finite: ({}, {})", i + 1, outline[i].x(), outline[i].y()));
  if (!is_simple(outline)) refuse("crosses or touches itself; give its points in order along the boundary");
  // Extents whose square is no number, or nothing, would leave no spacing to place nodes by.
  const double area = std::abs(signed_area(outline));
  if (!(area > 1e-100 && area < 1e100))
    refuse(fmt::format("encloses an area of {:g} R^2; scale it to lie between 1e-100 and 1e100", area));
}

// The half of a section that bodies of revolution are described by.
void check_half_section(const Body& body) {
  if (!body.numbers.axisymmetric()) return;
  const auto refuse = [](const char* field, const std::string& message) { throw FieldError(field, message); };
  if (!body.numbers.of_elements())
    refuse("state", "axisymmetric is of elements; give interior = \"elements\" too, or another state");
  for (std::size_t i = 0; i < body.outline.size(); ++i)
    if (!(body.outline[i].x() >= 0))
      refuse("outline", fmt::format("of an axisymmetric body is the half of its section at x >= 0, and point {} is "
                                    "({:g}, {:g}); leave the other half out",
                                    i + 1, body.outline[i].x(), body.outline[i].y()));
  if (body.numbers.roughness > 0) refuse("roughness", "of an axisymmetric body would be rings around it; leave it out");
  if (body.numbers.angle != 0) refuse("angle", "would turn an axisymmetric body off its axis; leave it out");
}

// Holes that cross nothing lie inside the outline and beside each other if each is inside of all other chains.
void check_holes(const Body& body) {
  const auto refuse = [](std::size_t k, const char* message) {
    throw FieldError("holes", fmt::format("hole {} {}", k + 1, message));
  };
  Rim all;
  all.add(body.outline);
  for (std::size_t k = 0; k < body.holes.size(); ++k) {
    check_outline(body.holes[k], "holes", fmt::format("hole {} ", k + 1));
    all.add(body.holes[k]);
  }
  const bool crossing = !is_simple(CellTree(all.points, all.cells));
  Rim some;
  some.add(body.outline);
  for (std::size_t k = 0; k < body.holes.size() && crossing; ++k) {
    some.add(body.holes[k]);
    if (!is_simple(CellTree(some.points, some.cells)))
      refuse(k, "crosses or touches the outline or a hole before it; move it, or make one of both");
  }
  for (std::size_t k = 0; k < body.holes.size(); ++k) {
    Rim others;
    others.add(body.outline);
    for (std::size_t j = 0; j < body.holes.size(); ++j)
      if (j != k) others.add(body.holes[j]);
    if (!inside(CellTree(others.points, others.cells), body.holes[k].front()))
      refuse(k, "must lie inside the outline and outside of other holes; move it");
  }
}

double area_of(const Body& body) {
  double area = signed_area(body.outline);
  for (const Points& hole : body.holes) area += signed_area(hole);
  return area;
}

double length_of(const Body& body) {
  double length = perimeter(body.outline);
  for (const Points& hole : body.holes) length += perimeter(hole);
  return length;
}

// Springs across a dent of the outline itself, or a hole, would fill it.
void check_plain(const Body& body) {
  if (!body.numbers.plain()) return;
  const auto refuse = [](const char* message) { throw FieldError("triangulation", message); };
  if (body.numbers.of_elements() || body.rigid()) refuse("plain is of springs; leave it out, or take interior springs");
  if (!body.holes.empty() || !is_convex(body.outline))
    refuse("plain would join nodes across a dent or a hole of the outline; take clipped");
}

// The spacing s at which `inside` nodes and a rim of the length L fill the area A: A = (inside + L/s) s^2.
double spacing_of(const Body& body, std::size_t inside) {
  const double area = area_of(body), length = length_of(body);
  return 2 * area / (length + std::sqrt(length * length + 4 * static_cast<double>(inside) * area));
}

bool given(double number) { return !std::isnan(number); }

std::vector<Points> outlines_of(const Body& body) {
  std::vector<Points> chains{body.outline};
  chains.insert(chains.end(), body.holes.begin(), body.holes.end());
  return chains;
}

// What is known of a body's nodes before its rim is laid.
struct Known {
  GivenNodes given;
  std::optional<HullNodes> hull;
};

Known known_nodes_of(const Body& body) {
  if (!body.points.empty()) return {given_nodes(body.points, outlines_of(body)), {}};
  Known nodes{{std::vector<Points>(1 + body.holes.size()), {}}, {}};
  if (body.numbers.by_hull()) {
    Random random = random_of(body, streams::interior);
    nodes.hull = hull_nodes(body, random);
  }
  return nodes;
}

double rim_spacing_of(const Body& body, const GivenNodes& nodes) {
  if (given(body.numbers.rim_spacing)) return body.numbers.rim_spacing;
  if (!body.points.empty()) return spacing_of(body, nodes.inside.size());
  return std::sqrt(area_of(body) / body.numbers.nodes);
}

// Its chains are polygons that cross neither themselves nor each other.
bool follows(const Rim& rim) {
  for (const Chain& chain : chains_of(rim.cells))
    if (chain.node.size() < 3) return false;
  return is_simple(CellTree(rim.points, rim.cells));
}

// Beyond it a mesh is refused before it is made.
constexpr double most_meshed = 1e6;

void check_mesh(const Body& body) {
  if (!body.points.empty())
    throw FieldError("points", "are nodes given by hand, and a mesh places its own; leave them out, or h_min");
  const SizeField size = body.size_field();
  if (body.numbers.h_max < size.least)
    throw FieldError("h_max", fmt::format("{:g} is below h_min = {:g}; raise it", body.numbers.h_max, size.least));
  double radius = 0;
  for (const Vec2& p : body.outline) radius = std::max(radius, (p - size.fine_at).norm());
  if (const double nodes = nodes_within(size, radius); !(nodes <= most_meshed))
    throw FieldError("h_min", fmt::format("{:g} would take up to {:.3g} nodes, more than {:g}; raise it, or h_max or "
                                          "grade",
                                          size.least, nodes, most_meshed));
  for (const Points& chain : outlines_of(body))
    if (const double length = perimeter(chain); 4 * size.least > length)
      throw FieldError(
          "h_min", fmt::format("{:g} is too long to follow an outline of length {:.4g}; lower it", size.least, length));
}

// What would take more nodes than a body can have, or too few to follow a chain, before it is laid.
void check_spacing(const Body& body, double spacing) {
  const double wanted = length_of(body) / spacing;
  constexpr double most = 1e7;
  if (!given(body.numbers.rim_spacing)) {
    if (!(wanted <= most))
      throw FieldError("nodes", fmt::format("{} nodes cannot cover this outline, which needs {:.3g} for itself",
                                            body.numbers.nodes, wanted));
    return;
  }
  if (!(wanted <= (body.points.empty() ? body.numbers.nodes : most)))
    throw FieldError("rim_spacing",
                     fmt::format("{:g} would take {:.4g} nodes on the rim; raise it, or nodes", spacing, wanted));
  for (const Points& chain : outlines_of(body))
    if (const double length = perimeter(chain); 4 * spacing > length)
      throw FieldError("rim_spacing", fmt::format("{:g} is too long to follow an outline of length {:.4g}; lower it",
                                                  spacing, length));
}

CrossedGrid crossed_grid_of(const Body& body) {
  std::optional<CrossedGrid> grid;
  if (body.holes.empty()) grid = crossed_grid(body.outline, body.size_field());
  if (!grid)
    throw FieldError("mesh", "crossed is of a rectangle with sides along x and y and without holes; leave it out");
  return *grid;
}

Rim lay_graded_rim(const Body& body) {
  check_mesh(body);
  Rim rim;
  if (body.numbers.crossed()) {
    rim.add(crossed_grid_of(body).rim());
    return rim;
  }
  for (const Points& chain : outlines_of(body)) rim.add(resample(chain, body.size_field()));
  if (!follows(rim))
    throw FieldError("h_max", "is too long to follow this outline without crossing it; lower it, or h_min");
  return rim;
}

Rim lay_rim(const Body& body, const Known& nodes) {
  if (body.numbers.meshed()) return lay_graded_rim(body);
  Rim rim;
  if (nodes.hull) {
    rim.add(nodes.hull->rim);
    return rim;
  }
  const double spacing = rim_spacing_of(body, nodes.given);
  check_spacing(body, spacing);
  const std::vector<Points> chains = outlines_of(body);
  for (std::size_t k = 0; k < chains.size(); ++k)
    rim.add(nodes.given.on_chain[k].empty() ? resample(chains[k], spacing) : nodes.given.on_chain[k]);
  if (body.points.empty() && static_cast<int>(rim.points.size()) > body.numbers.nodes)
    throw FieldError("nodes", fmt::format("{} nodes cannot cover this outline, which needs {} for itself",
                                          body.numbers.nodes, rim.points.size()));
  if (follows(rim)) return rim;
  if (!body.points.empty())
    throw FieldError("points", "are too few to follow the outline without crossing it; give more, or a rim_spacing");
  throw FieldError("nodes",
                   fmt::format("{} nodes are too few to follow this outline without crossing it", body.numbers.nodes));
}

// Moves the rim's points along its normals.
void roughen(Rim& rim, const Body& body, const std::vector<bool>& anchored_rim) {
  const BodyNumbers& numbers = body.numbers;
  Random random = random_of(body, streams::roughness);
  std::size_t i = 0;
  for (const Chain& chain : chains_of(rim.cells)) {
    const auto first = rim.points.begin() + chain.node.front();
    for (const Vec2& normal : outward_normals(Points(first, first + static_cast<int>(chain.node.size())))) {
      const double height = numbers.roughness * random.normal();
      if (anchored_rim.empty() || !anchored_rim[i]) rim.points[i] += height * normal;
      ++i;
    }
  }
  if (!follows(rim))
    throw CrossingRim("roughness",
                      fmt::format("the rough rim crosses itself (roughness {}, seed {}); lower the roughness or take "
                                  "another seed, as crossing = \"pass_over\" does",
                                  numbers.roughness, numbers.seed));
}

// Which points of a rim that is smooth are corners of the outlines.
std::vector<int> corners_of(const Body& body, const Rim& rim) {
  std::vector<int> corners;
  for (const Points& chain : outlines_of(body))
    for (const std::size_t corner : ricochet::corners_of(chain))
      for (std::size_t k = 0; k < rim.points.size(); ++k)
        if (rim.points[k] == chain[corner]) corners.push_back(static_cast<int>(k));
  return corners;
}

Points plan_interior(const Body& body, const Rim& rim, const Known& nodes) {
  if (body.numbers.crossed()) return crossed_grid_of(body).inside();
  if (body.numbers.meshed()) return mesh_interior(rim, body.size_field());
  if (!body.points.empty()) return nodes.given.inside;
  if (nodes.hull) {
    Random random = random_of(body, streams::redrawn);
    return inside_rough_rim(*nodes.hull, rim, random);
  }
  const BodyNumbers& numbers = body.numbers;
  const int count = numbers.nodes - static_cast<int>(rim.points.size());
  const double spacing = given(numbers.rim_spacing) ? spacing_of(body, static_cast<std::size_t>(count))
                                                    : std::sqrt(area_of(body) / numbers.nodes);
  Random random = random_of(body, streams::interior);
  return place_interior(rim, placement_from_name(numbers.placement), {count, spacing, numbers.margin}, random);
}

}  // namespace

Rim plan_rim(const Body& body) {
  check_outline(body.outline, "outline", "");
  check_half_section(body);
  check_holes(body);
  check_plain(body);
  return lay_rim(body, known_nodes_of(body));
}

NodePlan plan_nodes(const Body& body, const std::vector<bool>& anchored_rim) {
  check_outline(body.outline, "outline", "");
  check_half_section(body);
  check_holes(body);
  check_plain(body);
  const Known nodes = known_nodes_of(body);
  Rim rim = lay_rim(body, nodes);
  NodePlan plan;
  plan.smooth_rim = rim.points;
  plan.rim = static_cast<int>(rim.points.size());
  plan.corners = corners_of(body, rim);
  if (body.numbers.roughness > 0) roughen(rim, body, anchored_rim);
  plan.points = rim.points;
  if (!body.rigid()) {
    const Points interior = plan_interior(body, rim, nodes);
    plan.points.insert(plan.points.end(), interior.begin(), interior.end());
    if (body.numbers.crossed()) plan.triangles = crossed_grid_of(body).triangles();
  }
  plan.rim_cells = std::move(rim.cells);
  return plan;
}

void turn(Points& points, double angle) {
  if (angle == 0) return;
  const double quarters = std::fmod(angle, 360) / 90, radians = quarters * std::numbers::pi / 2;
  const bool exact = quarters == std::floor(quarters);
  const double cosine = exact ? std::round(std::cos(radians)) : std::cos(radians);
  const double sine = exact ? std::round(std::sin(radians)) : std::sin(radians);
  for (Vec2& p : points) p = ricochet::turned(p, cosine, sine);
}

NodePlan turned(NodePlan plan, double angle) {
  for (Points* points : {&plan.points, &plan.smooth_rim}) turn(*points, angle);
  return plan;
}

}  // namespace ricochet
