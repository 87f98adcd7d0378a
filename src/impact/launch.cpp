#include "impact/launch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/turn.hpp"
#include "force/contact/candidates.hpp"
#include "integrate/step_limit.hpp"
#include "lattice/outline.hpp"

namespace ricochet {
namespace {

Points rim_of(const Lattice& lattice) {
  Points rim;
  for (const int node : lattice.rim) rim.push_back(lattice.points[node]);
  return rim;
}

// Height of the boundary of a chain above x: the highest (or lowest) point of its edges there; NaN beside it.
double boundary_height(const ChainTree& chain, double x, bool highest) {
  double height = not_given;
  chain.search([&](const Vec2& low, const Vec2& high) { return low.x() <= x && x <= high.x(); },
               [&](std::size_t s) {
                 const Vec2 &a = chain.from(s), &b = chain.to(s);
                 const double y = a.x() == b.x() ? (highest ? std::max(a.y(), b.y()) : std::min(a.y(), b.y()))
                                                 : a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
                 if (std::isnan(height) || (highest ? y > height : y < height)) height = y;
               });
  return height;
}

// How far the chain `upper` must be raised so that it just rests on `lower`; NaN if they pass beside each other.
double resting_lift(const Points& upper, const Points& lower) {
  const ChainTree above(upper), below(lower);
  double lift = not_given;
  const auto consider = [&](double x) {
    const double bottom = boundary_height(above, x, false), top = boundary_height(below, x, true);
    if (!std::isnan(bottom) && !std::isnan(top) && !(top - bottom <= lift)) lift = top - bottom;
  };
  for (const Vec2& p : upper) consider(p.x());
  for (const Vec2& p : lower) consider(p.x());
  return lift;
}

// Of a flight towards the target: each closes most of the gap unless the flight is almost parallel to the surface.
constexpr int most_advances = 100000;

struct Circle {
  Vec2 centre;
  double radius;
};

Circle circle_around(const Points& points) {
  Vec2 low = points[0], high = points[0];
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {(low + high) / 2, (high - low).norm() / 2};
}

// A body that flies on with this velocity and reaches so far from its centre comes no nearer any more.
bool gone_past(const Circle& target, const Pose& pose, const Vec2& velocity, double reach) {
  const Vec2 offset = pose.centre - target.centre;
  return offset.dot(velocity) >= 0 && offset.norm() > target.radius + reach;
}

struct Step {
  double step, theta;
};

// The repulsion of a node that arrives with speed v grows e-fold in 1/(xi v), and its stiffness is xi^2 m v^2 / 2: a
// step this share of that time resolves both, however soft the springs. With the paper's disk it counts from 0.3 c on.
constexpr double onset_share = 0.3;

// `fastest`: no node of the projectile is faster [c].
Step choose_step(const Scene& scene, const Lattice& projectile, const Lattice& target, double fastest) {
  const Method& method = scene.method();
  if (const std::string conflict = scene.conflict_with(method); !conflict.empty()) throw FieldError("method", conflict);
  const FrequencyBound a = frequency_bound(projectile, scene.projectile->numbers.stiffness);
  FrequencyBound b = frequency_bound(target, scene.target->numbers.stiffness);
  b.omega *= slower_by(method);
  const double omega = std::max(a.omega, b.omega);
  if (!std::isfinite(omega))
    throw FieldError(
        std::isfinite(a.omega) ? "target" : "projectile",
        "its stiffness over its mass gives frequencies beyond every number; take a softer or heavier body");
  const double contacts =
      method.multirate() ? static_cast<double>(method.stages.size()) : 1;  // kicks that share a step evenly
  const Integration& wanted = scene.integration;
  const double step = !std::isnan(wanted.step) ? wanted.step
                      : !std::isnan(wanted.theta)
                          ? wanted.theta / omega
                          : std::min(method.usual / omega, onset_share * contacts / (scene.contact.xi * fastest));
  const double theta = step * omega;
  if (!(theta <= method.stability_limit)) {
    const bool first = a.omega >= b.omega, by_step = !std::isnan(wanted.step);
    const double unit = by_step ? 1 / omega : 1;
    throw FieldError(
        by_step ? "step" : "theta",
        fmt::format("{:.6g} is unstable: {} needs a {} below {:.4g} here (node {} of the {} vibrates at up to {:.4g} "
                    "c/R); {:.3g} works",
                    by_step ? wanted.step : theta, method.name, by_step ? "step" : "theta",
                    method.stability_limit * unit, first ? a.node : b.node, first ? "projectile" : "target",
                    first ? a.omega : b.omega / slower_by(method), method.usual * unit));
  }
  return {step, theta};
}

// A given step may be ten times coarser than the contact's onset asks for: the ledger tells what that costs. A coarser
// one may jump over the contact unseen, or through a body between two looks.
void check_contact_is_seen(const Scene& scene, double step, double fastest, double radius) {
  const Integration& wanted = scene.integration;
  if ((std::isnan(wanted.step) && std::isnan(wanted.theta)) || fastest == 0) return;
  const Method& method = scene.method();
  const double kicks = method.multirate() ? static_cast<double>(method.stages.size()) : 1;
  const double furthest =
      std::min(10 * onset_share * kicks / scene.contact.xi, radius * method.evaluations() / evaluations_between_looks);
  if (step * fastest <= furthest) return;
  const double unit = std::isnan(wanted.step) ? wanted.theta / step : 1;
  throw FieldError(std::isnan(wanted.step) ? "theta" : "step",
                   fmt::format("the projectile would move by {:.2g} R in a step of {:.3g} R/c and might pass the "
                               "contact unseen, whose repulsion grows e-fold in {:.2g} R; give {:.3g} or less",
                               step * fastest, step, 1 / scene.contact.xi, 0.99 * furthest / fastest * unit));
}

// Time and places must move on in numbers of 53 bits. `size`: of the places [R].
void check_progress(const Scene& scene, const Start& start, double fastest, double size) {
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  const Integration& wanted = scene.integration;
  const char* given = !std::isnan(wanted.step) ? "step" : !std::isnan(wanted.theta) ? "theta" : nullptr;
  const char* speed = std::isnan(scene.launch.normal_speed) ? "speed" : "normal_speed";
  if (start.time_limit + start.step == start.time_limit && !given && std::isnan(wanted.time_limit) &&
      start.step < 1e-12)
    throw FieldError("projectile",
                     fmt::format("the bodies are so stiff that a time step of {:.3g} R/c is lost in rounding at the "
                                 "time limit of {:.3g} R/c; take softer or heavier bodies",
                                 start.step, start.time_limit));
  if (start.time_limit + start.step == start.time_limit)
    throw FieldError(
        given                           ? given
        : std::isnan(wanted.time_limit) ? speed
                                        : "time_limit",
        fmt::format(
            "a time step of {:.3g} R/c is lost in rounding at the time limit of {:.3g} R/c: t + step = t; give {}",
            start.step, start.time_limit,
            given                           ? std::string("a longer ") + given
            : std::isnan(wanted.time_limit) ? "a lower speed"
                                            : "a shorter time_limit"));
  // The last digits of what a step adds to a place are lost; few enough that the impact does not notice.
  const double least = 1e3 * rounding * size;
  if (fastest > 0 && start.step * fastest < least)
    throw FieldError(
        given ? given : speed,
        fmt::format(
            "in a step of {:.3g} R/c the projectile would move by {:.2g} R, which is lost in rounding; give {} or more",
            start.step, start.step * fastest,
            given && given[0] == 's' ? fmt::format("a step of {:.2g}", least / fastest)
            : given                  ? fmt::format("a theta of {:.2g}", least / fastest / start.step * wanted.theta)
                                     : fmt::format("a speed of {:.2g} c", least / start.step)));
}

}  // namespace

Points posed(const Points& points, const Vec2& centre, const Pose& pose) {
  if (pose.angle == 0) {  // kept apart so that a flight without spin only shifts
    Points moved;
    for (const Vec2& p : points) moved.push_back(p + (pose.centre - centre));
    return moved;
  }
  const double c = std::cos(pose.angle), s = std::sin(pose.angle);
  Points moved;
  for (const Vec2& p : points) moved.push_back(pose.centre + turned(p - centre, c, s));
  return moved;
}

Start launch(const Scene& scene, const Lattice& projectile, const Lattice& target) {
  if (projectile.anchored()) throw FieldError("projectile", "a projectile must be free, this body has anchored nodes");
  if (scene.contact.xi * scene.contact.reach < 20)
    throw FieldError(
        "contact", fmt::format("xi reach = {:g} cuts the repulsion at more than exp(-20); raise reach to {:g} or more",
                               scene.contact.xi * scene.contact.reach, 20 / scene.contact.xi));
  if (scene.contact.xi * scene.contact.reach > 700)
    throw FieldError(
        "contact",
        fmt::format("xi reach = {:g} is beyond exp(-700), the smallest number there is; lower reach to {:g} or less",
                    scene.contact.xi * scene.contact.reach, 700 / scene.contact.xi));
  if (const std::string conflict = conflict_of(scene.effects); !conflict.empty()) throw FieldError("effects", conflict);
  for (const Effect& effect : scene.effects)
    if (!target.anchored())
      std::visit(
          []<class E>(const E&) {
            if constexpr (AnchorMotion<E> || std::same_as<E, Absorbing>)
              throw FieldError("effects",
                               fmt::format("{} needs a target with anchored nodes, and this one is free", E::name));
          },
          effect);
  for (const Effect& effect : scene.effects)
    std::visit(
        [&]<class E>(const E& e) {
          if constexpr (SpringChange<E>)
            for (int body : {0, 1}) {
              const Lattice& lattice = body == 0 ? projectile : target;
              if (!acts_on(e.on, body) || lattice.rest_energy == 0) continue;
              for (int i = 0; i < lattice.free; ++i)
                for (int s = lattice.first[i]; s < lattice.first[i + 1]; ++s) {
                  const Spring spring = lattice.spring[s];
                  const double strain = (lattice.points[spring.other] - lattice.points[i]).norm() / spring.length - 1;
                  if (e.exceeded(strain))
                    throw FieldError("effects",
                                     fmt::format("{}: prestress strains a spring of the {} by {:.3g} at rest, beyond "
                                                 "its limit; lower prestress or raise the limit",
                                                 E::name, body == 0 ? "projectile" : "target", strain));
                }
            }
        },
        effect);
  const Adhesion* adhesion = find_effect<Adhesion>(scene.effects);
  if (adhesion && adhesion->xi * scene.contact.reach < 20)
    throw FieldError(
        "effects",
        fmt::format(
            "adhesion: xi reach = {:g} cuts the attraction at more than exp(-20); raise contact.reach to {:g} or more",
            adhesion->xi * scene.contact.reach, 20 / adhesion->xi));
  if (adhesion && adhesion->xi >= scene.contact.xi)
    throw FieldError(
        "effects",
        fmt::format(
            "adhesion: xi = {:g} must be below the contact's, {:g}, or the rims would be drawn into one another",
            adhesion->xi, scene.contact.xi));
  const MovingAnchor* shaken = find_effect<MovingAnchor>(scene.effects);
  Start start;
  start.velocity = scene.launch.velocity();
  start.spin = scene.launch.spin;
  const Vec2 centre = projectile.centre();
  const Points rim = rim_of(projectile);
  Points target_rim = rim_of(target);
  if (shaken)
    for (Vec2& p : target_rim) p += shaken->displacement(0);
  double radius = 0;
  for (const Vec2& p : rim) radius = std::max(radius, (p - centre).norm());
  const double fastest = start.velocity.stableNorm() + std::abs(start.spin) * radius;
  const auto [step, theta] = choose_step(scene, projectile, target, fastest);
  start.step = step;
  start.theta = theta;
  const double normal_speed = -start.velocity.y();
  start.time_limit =
      !std::isnan(scene.integration.time_limit) ? scene.integration.time_limit : 100 + 2 / std::max(normal_speed, 1e-9);
  check_progress(scene, start, fastest, std::max(centre.norm(), radius));
  check_contact_is_seen(scene, step, fastest, radius);
  // Of the relative motion, in the frame where the energy is least: an anchored target is infinitely heavy.
  const double mass = projectile.total_mass();
  const double reduced = target.anchored() ? mass : mass * target.total_mass() / (mass + target.total_mass());
  const double rotation = projectile.inertia() * start.spin * start.spin / 2;
  start.energy = mass * start.velocity.squaredNorm() / 2 + rotation;
  // Attraction lowers the wall that V0 is, and other effects bring energy beside that of the launch: no claim then.
  const bool more_energy =
      std::any_of(scene.effects.begin(), scene.effects.end(),
                  [](const Effect& effect) {
                    return std::visit(
                        []<class E>(const E&) { return NodeForce<E> || PairForce<E> || AnchorMotion<E> || AtStart<E>; },
                        effect);
                  }) ||
      projectile.rest_energy > 0 || target.rest_energy > 0;
  start.certified = reduced * start.velocity.squaredNorm() / 2 + rotation < scene.contact.V0 && !more_energy;

  // The smooth outlines, projectile moved so that its centre lies above `at`, resting on the target.
  Points smooth = projectile.smooth_rim;
  for (Vec2& p : smooth) p.x() += scene.launch.at - centre.x();
  const double lift = resting_lift(smooth, target.smooth_rim);
  if (std::isnan(lift))
    throw FieldError("at", fmt::format("a projectile at x = {} passes beside the target", scene.launch.at));
  start.overlap_height = centre.y() + lift - target.centre().y();

  // What is cut off must not show: at 0.1 c a reach of 0.1 R is far enough, below about 1e-4 c it is not.
  constexpr double cut_share = touch_share / 100;
  start.contact = scene.contact;
  if (start.energy > 0)
    start.contact.reach =
        std::max(scene.contact.reach, std::log(scene.contact.V0 / (cut_share * start.energy)) / scene.contact.xi);
  const double reach = start.contact.reach;
  const auto roughest = [](const Points& a, const Points& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
    return largest;
  };
  const bool given = !std::isnan(scene.launch.height);
  const double height = given ? scene.launch.height
                              : reach + roughest(rim, projectile.smooth_rim) +
                                    roughest(target_rim, target.smooth_rim);  // a shaken target's displacement included
  if (normal_speed == 0 && !given) {
    start.touches = false;
    return start;
  }
  // Upstream along the line of flight: at `height` above touching.
  const auto upstream = [&](double above) {
    const double ahead = normal_speed > 0 ? above / normal_speed : 0.0;
    return Pose{Vec2(scene.launch.at - start.velocity.x() * ahead, centre.y() + lift + above), 0.0};
  };
  Pose pose = upstream(height);
  double distance = chain_distance(posed(rim, centre, pose), target_rim);
  // Where the outlines slope, a height is less of a distance: go higher until the rims are apart.
  for (double above = 2 * height; !given && distance < reach && above < 1e3 * height; above *= 2) {
    pose = upstream(above);
    distance = chain_distance(posed(rim, centre, pose), target_rim);
  }
  const auto too_near = [&](double apart) {
    return scene.contact.V0 * std::exp(-scene.contact.xi * apart) > touch_share * std::max(start.energy, 1e-300);
  };
  if (too_near(distance)) {
    // A height that works, found as if none were given, and the least one below it.
    double low = height, high = reach + roughest(rim, projectile.smooth_rim) + roughest(target_rim, target.smooth_rim);
    const auto works = [&](double above) {
      return !too_near(chain_distance(posed(rim, centre, upstream(above)), target_rim));
    };
    while (!works(high) && high < 1e3) {
      low = high;
      high *= 2;
    }
    while (high - low > 1e-3 * high) {
      const double middle = (low + high) / 2;
      (works(middle) ? high : low) = middle;
    }
    throw FieldError("height", fmt::format("the bodies overlap at the start (rims {:.3g} R apart, {:.3g} R needed); "
                                           "raise launch.height to {:.3g} or more, or leave it out",
                                           distance,
                                           std::log(scene.contact.V0 / (touch_share * std::max(start.energy, 1e-300))) /
                                               scene.contact.xi,
                                           1.01 * high));
  }

  const Circle around = circle_around(target_rim);
  for (int advance = 0; distance > reach; ++advance) {
    if (advance == most_advances)
      throw FieldError("launch",
                       fmt::format("the flight is too shallow to find the first touch (normal speed {:g} of {:g} c)",
                                   normal_speed, start.velocity.stableNorm()));
    const double time = std::max(distance - reach, 1e-3 * reach) / fastest;
    pose.centre += time * start.velocity;
    pose.angle += time * start.spin;
    if (gone_past(around, pose, start.velocity, radius + reach)) {
      start.touches = false;
      return start;
    }
    distance = chain_distance(posed(rim, centre, pose), target_rim);
  }
  start.pose = pose;
  return start;
}

double closest_approach(const Start& start, const Lattice& projectile, const Lattice& target, double enough) {
  const Points rim = rim_of(projectile), target_rim = rim_of(target);
  const Vec2 centre = projectile.centre();
  double radius = 0, least = std::numeric_limits<double>::infinity();
  for (const Vec2& p : rim) radius = std::max(radius, (p - centre).norm());
  const double fastest = start.velocity.stableNorm() + std::abs(start.spin) * radius;
  const Circle around = circle_around(target_rim);
  Pose pose = start.pose;
  for (int advance = 0; advance < most_advances; ++advance) {
    const double distance = chain_distance(posed(rim, centre, pose), target_rim);
    least = std::min(least, distance);
    if (least <= enough || gone_past(around, pose, start.velocity, radius)) break;
    const double time = std::max(distance - enough, 0.05 * enough) / fastest;
    pose.centre += time * start.velocity;
    pose.angle += time * start.spin;
  }
  return least;
}

}  // namespace ricochet
