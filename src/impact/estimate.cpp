#include "impact/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "body/plan.hpp"
#include "contact/line_contact.hpp"
#include "contact/point_contact.hpp"
#include "impact/axes.hpp"
#include "impact/doubts.hpp"
#include "impact/elastic.hpp"
#include "impact/launch/launch.hpp"
#include "shape/curvature.hpp"
#include "shape/outline.hpp"
#include "shape/placed_surface.hpp"

namespace ricochet {
namespace {

constexpr double boundless = std::numeric_limits<double>::infinity();

Vec2 arriving_velocity(const Scene& scene) { return arriving_velocity(scene, elastic_of(*scene.target).held); }

// As the body stands in the scene: turned by its angle.
Points outline_of(const Body& body) {
  Points outline = body.outline;
  turn(outline, body.numbers.angle);
  return outline;
}

/// Where the smooth outlines first touch: the projectile is moved there, the target lies where it is at rest.
struct Touch {
  Points projectile, target;
  Vec2 at, moved;  ///< by how much the projectile was
};

// The height of a closed outline's lower or upper side at x; NaN beside it.
double height_of(const Points& outline, double x, bool upper) {
  double height = not_given;
  const auto see = [&](double here) {
    if (!(upper ? here <= height : here >= height)) height = here;
  };
  const Vec2* last = &outline.back();
  for (const Vec2& p : outline) {
    const Vec2 &a = *std::exchange(last, &p), &b = p;
    if (std::min(a.x(), b.x()) > x || std::max(a.x(), b.x()) < x) continue;
    see(a.x() == b.x() ? normal(a) : normal(a) + (x - a.x()) / (b.x() - a.x()) * (normal(b) - normal(a)));
    if (a.x() == b.x()) see(normal(b));
  }
  return height;
}

// Nothing if the bodies pass beside each other.
std::optional<Touch> touch_of(const Scene& scene) {
  Points above = outline_of(*scene.projectile), below = outline_of(*scene.target);
  const bool on_axis = scene.projectile->numbers.axisymmetric();
  const double shift = on_axis ? 0 : scene.launch.at - figure_of(above).centre.x();
  for (Vec2& p : above) p.x() += shift;
  const bool plane = scene.target->plane.has_value();
  double lift = -boundless;
  Vec2 at(0, 0);
  const auto consider = [&](double x) {
    const double bottom = height_of(above, x, false);
    const double top = plane ? scene.target->plane->offset : height_of(below, x, true);
    if (std::isnan(bottom) || std::isnan(top) || top - bottom <= lift) return;
    lift = top - bottom;
    at = {x, top};
  };
  if (plane)
    consider(std::min_element(above.begin(), above.end(), [](auto& a, auto& b) { return normal(a) < normal(b); })->x());
  else
    for (const Points* corners : std::initializer_list<const Points*>{&above, &below})
      for (const Vec2& p : *corners) consider(p.x());
  if (lift == -boundless) return std::nullopt;
  for (Vec2& p : above) p += lift * upwards();
  return Touch{std::move(above), std::move(below), at, {shift, lift}};
}

/// A body at the touch.
struct Side {
  Elastic elastic;
  OutlineAt outline{};
  LineBody line = LineBody::rigid_plane();
  double slowness = 0;  ///< 1 over the mass that the normal speed of its point at the touch has [1/m0]
};

// The outline on both sides of the axis x = 0 of a half that reaches it at the height of `at`; the half itself if it
// does not.
Points mirrored(const Points& half, const Vec2& at) {
  const std::size_t n = half.size();
  const auto on_axis = [&](std::size_t i) { return half[i % n].x() == 0; };
  for (std::size_t i = 0; i < n; ++i) {
    if (!on_axis(i) || !on_axis(i + 1) || on_axis(i + 2)) continue;
    Points whole{half[(i + 1) % n]};
    for (std::size_t k = i + 2; whole.size() == 1 || whole.back().x() != 0; ++k) whole.push_back(half[k % n]);
    const double rounding = 1e-9 * whole.front().norm();
    if (std::min(std::abs(normal(whole.front()) - normal(at)), std::abs(normal(whole.back()) - normal(at))) > rounding)
      continue;
    for (std::size_t back = whole.size() - 1; back-- > 1;)
      whole.emplace_back(-tangential(whole[back]), normal(whole[back]));
    return whole;
  }
  return half;
}

// A body of revolution at a touch on its axis. Its volume is the area of the half times the way of its centre around
// the axis. [Pappus]
Side side_of_revolution(const Body& body, const Points& half, const Vec2& at) {
  Side side{elastic_of(body)};
  const Figure figure = figure_of(half);
  const double volume = 2 * std::numbers::pi * figure.centre.x() * figure.area;
  side.outline = outline_at(mirrored(half, at), at, 0.1 * std::cbrt(3 * volume / (4 * std::numbers::pi)));
  if (!side.elastic.held) side.slowness = 1 / (volume * side.elastic.density);
  return side;
}

Side side_of(const Body& body, const Points& outline, const Vec2& at) {
  Side side{elastic_of(body)};
  if (body.plane) {
    side.outline = {{0, 1}, boundless, false};
    return side;
  }
  if (body.numbers.axisymmetric()) return side_of_revolution(body, outline, at);
  const Figure figure = figure_of(outline);
  const double size = std::sqrt(figure.area / std::numbers::pi);
  side.outline = outline_at(outline, at, 0.1 * size);
  const Box box = bounding_box(outline);
  side.line = std::isinf(side.outline.radius)
                  ? LineBody::block(side.elastic.modulus, side.elastic.poisson, normal(Vec2(box.high - box.low)))
                  : LineBody{side.elastic.modulus, side.outline.radius, 4 * size};
  if (side.elastic.held) return side;
  const double arm = cross(at - figure.centre, side.outline.normal);
  side.slowness = (1 / figure.area + arm * arm / figure.moment) / side.elastic.density;
  return side;
}

constexpr const char* corner_touches = "a corner touches, and the law is of smooth outlines";
constexpr const char* flat_touches = "a flat side touches a flat one, and the law is of round outlines";

std::string why_no_law(const Side& one, const Side& other, double radius) {
  if (one.outline.corner || other.outline.corner) return corner_touches;
  if (!(radius > 0)) return "the outlines fit into each other";
  if (std::isinf(radius)) return flat_touches;
  return "";
}

// Directions of the sides of an outline on which a point lies.
Points sides_at(const Body& body, const Points& outline, const Vec2& point) {
  if (body.plane) return {perpendicular(upwards())};  // against the projectile's, as outlines run
  const double rounding = 1e-9 * (bounding_box(outline).high - bounding_box(outline).low).maxCoeff();
  Points sides;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], side = outline[(i + 1) % outline.size()] - a;
    const double share = std::clamp((point - a).dot(side) / side.squaredNorm(), 0.0, 1.0);
    if ((a + share * side - point).norm() <= rounding) sides.push_back(side.normalized());
  }
  return sides;
}

// Whether a side lies along one of the other body, whose corners then touch first or last by rounding alone.
bool lies_flat(const Scene& scene, const Touch& touch) {
  const Points ours = sides_at(*scene.projectile, touch.projectile, touch.at),
               theirs = sides_at(*scene.target, touch.target, touch.at);
  return std::any_of(ours.begin(), ours.end(), [&](const Vec2& one) {
    return std::any_of(theirs.begin(), theirs.end(),
                       [&](const Vec2& other) { return std::abs(cross(one, other)) < 1e-9 && one.dot(other) < 0; });
  });
}

// Where the touch is in a body as it was described, before it was turned and moved.
Vec2 place_in(const Body& body, const Vec2& at) {
  Points place{at};
  turn(place, -body.numbers.angle);
  return place[0];
}

void set_speeds(const Scene& scene, Estimate& e) {
  e.wave_speed = elastic_of(*scene.projectile).wave_speed();
  e.slowest_wave = e.wave_speed;
  if (!scene.target->rigid()) e.slowest_wave = std::min(e.wave_speed, elastic_of(*scene.target).wave_speed());
}

Estimate without_law(Estimate e, std::string why) {
  if (why == corner_touches)
    e.doubts.push_back({"corner",
                        "a corner touches, whose pressure has no bound: e follows the mesh or lattice, and the "
                        "rounding that it stands for; see what ricochet.refined(scene, 4) changes"});
  e.no_law = std::move(why);
  e.impact = {not_given, not_given, not_given, not_given, not_given, false};
  return e;
}

Estimate by_law(const Scene& scene) {
  Estimate e;
  set_speeds(scene, e);
  const std::optional<Touch> touch = touch_of(scene);
  if (!touch) return without_law(e, "the outlines pass beside each other");
  const std::array<Vec2, 2> places{place_in(*scene.projectile, touch->at - touch->moved),
                                   place_in(*scene.target, touch->at)};
  e.spacing = std::max(spacing_of(*scene.projectile, places[0]), spacing_of(*scene.target, places[1]));
  const Side one = side_of(*scene.projectile, touch->projectile, touch->at);
  const Side other = side_of(*scene.target, touch->target, touch->at);
  const Vec2 normal =
      std::isinf(one.outline.radius) || one.outline.corner ? other.outline.normal : Vec2(-one.outline.normal);
  e.normal_speed = -arriving_velocity(scene).dot(normal);
  const bool revolved = scene.projectile->numbers.axisymmetric();
  if (revolved && tangential(touch->at) != 0)
    return without_law(e, "the bodies touch along a ring, and the law is of a touch on their axis");
  const LinePair line = pressed_together(one.line, other.line);
  const PointBody point = pressed_together(PointBody{one.elastic.modulus, one.outline.radius},
                                           PointBody{other.elastic.modulus, other.outline.radius});
  e.radius = revolved ? point.radius : line.radius;
  if (const std::string why = why_no_law(one, other, e.radius); !why.empty())
    return without_law(e, why == corner_touches && lies_flat(scene, *touch) ? flat_touches : why);
  if (!(e.normal_speed > 0)) return without_law(e, "the outlines slide past each other");
  const double mass = 1 / (one.slowness + other.slowness);
  e.impact = revolved ? point_impact(point, mass, e.normal_speed) : line_impact(line, mass, e.normal_speed);
  e.pressure = e.impact.pressure;
  e.over_yield = pressure_over_yield(scene, e.pressure);
  const double most = !scene.target->rigid() && other.elastic.held ? 0.05 : 0.1;
  e.in_range = e.impact.in_range && e.normal_speed <= most * e.slowest_wave;
  add_doubts_of_contact(scene, places, {one.outline.radius, other.outline.radius}, e);
  return e;
}

}  // namespace

Estimate estimate(const Scene& scene) {
  Estimate e = by_law(scene);
  add_doubts_of_bodies(scene, e.normal_speed > 0 ? e.normal_speed : arriving_velocity(scene).norm(), e);
  return e;
}

double over_yield(const Scene& scene) {
  const auto bodies = scene.bodies();
  const bool known = std::any_of(bodies.begin(), bodies.end(),
                                 [](const Body* body) { return body->material && !std::isnan(body->material->yield); });
  return known ? estimate(scene).over_yield : not_given;
}

}  // namespace ricochet
