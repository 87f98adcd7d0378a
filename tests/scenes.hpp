#pragma once
// Small scenes that the tests share.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "body/plan.hpp"
#include "body/solid.hpp"
#include "impact/batch.hpp"
#include "impact/outcome.hpp"
#include "impact/scene.hpp"
#include "shape/outline.hpp"

namespace ricochet::test {

/// Under a sanitizer everything takes twenty to a hundred times longer, so the longest tests take fewer steps or kinds
/// there.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

inline Points circle(double radius = 1, int corners = 400) {
  Points points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    points.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

/// The half at x >= 0, along the axis x = 0 from its lowest point to its highest and back.
inline Points half_circle(double radius = 1, int corners = 400) {
  Points points{{0, -radius}};
  for (int i = 1; i < corners; ++i) {
    const double angle = std::numbers::pi * i / corners;
    points.push_back(radius * Vec2(std::sin(angle), -std::cos(angle)));
  }
  points.emplace_back(0, radius);
  return points;
}

inline Points box(double width, double depth) {
  return {{-width / 2, -depth}, {width / 2, -depth}, {width / 2, 0}, {-width / 2, 0}};
}

/// Of a body that is an outline and its numbers.
inline NodePlan plan_nodes(const Points& outline, const BodyNumbers& numbers, const std::vector<bool>& anchored_rim) {
  return ricochet::plan_nodes(Body{outline, numbers, {}, {}}, anchored_rim);
}
inline Points plan_rim(const Points& outline, const BodyNumbers& numbers) {
  return ricochet::plan_rim(Body{outline, numbers, {}, {}}).points;
}

inline BodyNumbers numbers(int nodes, double stiffness, double roughness, int seed,
                           const char* placement = "poisson_disk") {
  BodyNumbers n;
  n.nodes = nodes;
  n.mass = 1;
  n.stiffness = stiffness;
  n.roughness = roughness;
  n.seed = seed;
  n.placement = placement;
  return n;
}

/// Of elements, of the usual density.
inline BodyNumbers element_numbers(int nodes, double E, double nu, const std::string& law = "polynomial",
                                   const char* placement = "poisson_disk") {
  BodyNumbers n;
  n.interior = "elements";
  n.nodes = nodes;
  n.stiffness = E;
  n.nu = nu;
  n.law = law;
  n.placement = placement;
  return n;
}

inline std::shared_ptr<const Body> disk(int nodes, double stiffness, double roughness, int seed) {
  return std::make_shared<Body>(Body{circle(), numbers(nodes, stiffness, roughness, seed), {}, {}});
}

inline std::shared_ptr<const Body> wall(int nodes, double stiffness, double roughness, int seed, double width = 4,
                                        double depth = 1.5) {
  Body body{box(width, depth), numbers(nodes, stiffness, roughness, seed), {}, {}};
  const auto held = [&](const Vec2& p) { return p.y() < -depth + 1e-9 || std::abs(p.x()) > width / 2 - 1e-9; };
  std::vector<bool> rim;
  for (const Vec2& p : plan_rim(body.outline, body.numbers)) rim.push_back(held(p));
  for (const Vec2& p : plan_nodes(body.outline, body.numbers, rim).points) body.anchored.push_back(held(p));
  for (std::size_t i = 0; i < rim.size(); ++i) body.anchored[i] = rim[i];
  return std::make_shared<Body>(body);
}

/// The contact of the paper's scenes.
inline ExponentialRepulsion paper_contact() { return {150, 300, 0.1, "one"}; }

/// Without bodies.
inline Scene paper_scene() {
  Scene scene;
  scene.contact = paper_contact();
  return scene;
}

/// A hard disk of 60 nodes on a soft wall of 150: milliseconds.
inline Scene small_scene(int seed = 1, double psi1 = 1, double roughness = 0.03) {
  Scene scene = paper_scene();
  scene.projectile = disk(60, 1e4, roughness, seed);
  scene.target = wall(150, 400, roughness, seed);
  scene.launch.psi1 = psi1;
  return scene;
}

/// Every bit of an outcome, as text.
inline std::string exact_text(const Outcome& o) {
  std::string text = name_of(o.status) + ";";
  for (const auto& [field, value] : Outcome::fields()) text += fmt::format("{:a};", value(o));
  return text;
}

}  // namespace ricochet::test
