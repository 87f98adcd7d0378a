#include "hard/random_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "material/solid_law.hpp"
#include "scenes.hpp"
#include "shape/outline.hpp"

namespace ricochet::test {
namespace {

struct Shape {
  std::string name;
  Points outline;
};

Shape random_shape(Random& random) {
  const double turn = random.uniform(0, 2 * std::numbers::pi);
  const auto turned = [&](Points points) {
    for (Vec2& p : points)
      p = Vec2(std::cos(turn) * p.x() - std::sin(turn) * p.y(), std::sin(turn) * p.x() + std::cos(turn) * p.y());
    return points;
  };
  switch (static_cast<int>(random.uniform(0, 4))) {
    case 0:
      return {"disk", circle()};
    case 1:
      return {"square", turned({{-0.8, -0.8}, {0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}})};
    case 2: {
      Points ellipse = circle();
      const double flat = random.uniform(0.3, 1);
      for (Vec2& p : ellipse) p.y() *= flat;
      return {fmt::format("ellipse({:.2f})", flat), turned(ellipse)};
    }
    default: {
      Points star;
      const double inner = random.uniform(0.45, 0.8);
      for (int i = 0; i < 10; ++i)
        star.push_back((i % 2 ? inner : 1.0) *
                       Vec2(std::cos(std::numbers::pi * i / 5), std::sin(std::numbers::pi * i / 5)));
      return {fmt::format("star({:.2f})", inner), turned(star)};
    }
  }
}

double decades(Random& random, double low, double high) { return std::pow(10, random.uniform(low, high)); }

// Turns a body of springs into one of elements of the same stiffness and mass. Half of them are meshes, fine at `fine`.
void make_of_elements(Body& body, double nodes_mass, const Vec2& fine, Random& random) {
  BodyNumbers& n = body.numbers;
  const double area = std::abs(signed_area(body.outline));
  n.interior = "elements";
  n.nu = random.uniform(0, 0.45);
  n.state = random.uniform() < 0.5 ? "plane_stress" : "plane_strain";
  n.law = solid_law_names()[static_cast<std::size_t>(random.uniform(0, static_cast<double>(solid_law_names().size())))];
  n.quartic = BodyNumbers{}.quartic;
  if (!std::isnan(nodes_mass)) n.density = nodes_mass * n.nodes / area;
  n.mass = not_given;
  if (random.uniform() < 0.5) return;
  n.h_min = std::sqrt(area / n.nodes) * random.uniform(0.4, 1);
  n.h_max = n.h_min * random.uniform(1, 5);
  n.grade = random.uniform(0.02, 0.4);
  body.fine_at = fine;
}

Vec2 lowest(const Points& outline) {
  return *std::min_element(outline.begin(), outline.end(), [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
}

// With as many nodes as its mesh has, as scripts describe it, and as anchored as `held` says.
template <class Held>
Body counted(Body body, const Held& held) {
  try {
    std::vector<bool> rim;
    for (const Vec2& q : ricochet::plan_rim(body).points) rim.push_back(held(q));
    const bool anchors = std::count(rim.begin(), rim.end(), true) > 0;
    if (!anchors && !body.numbers.meshed()) return body;
    const Points planned = ricochet::plan_nodes(body, rim).points;
    if (body.numbers.meshed()) body.numbers.nodes = static_cast<int>(planned.size());
    for (std::size_t i = 0; anchors && i < planned.size(); ++i)
      body.anchored.push_back(i < rim.size() ? rim[i] : held(planned[i]));
  } catch (const FieldError&) {  // refused again when it is built
  }
  return body;
}

// What a body of elements is, on a line.
std::string text_of_interior(const BodyNumbers& n) {
  if (!n.of_elements()) return "";
  const std::string mesh = n.meshed() ? fmt::format(", h {:.2g} to {:.2g}", n.h_min, n.h_max) : "";
  return fmt::format(" [elements {} {} nu {:.2g}{}]", n.law, n.state, n.nu, mesh);
}

// What acts beside the contact of a scene, of what elements accept.
std::vector<Effect> random_effects(double speed, double mass, const Body& target, Random& random) {
  std::vector<Effect> effects;
  const auto draw = [&](double share) { return random.uniform() < share; };
  const auto held = std::count(target.anchored.begin(), target.anchored.end(), true);
  const bool anchored = held > 0, moves = held < static_cast<std::ptrdiff_t>(target.anchored.size());
  const std::string on = anchored || draw(0.5) ? "projectile" : "both";
  if (draw(0.2)) effects.emplace_back(Gravity{speed * speed * decades(random, -4, -1), on});
  if (draw(0.2)) effects.emplace_back(Drag{speed * decades(random, -3, 0), on});
  if (draw(0.2)) effects.emplace_back(Friction{random.uniform(0, 1), decades(random, -1, 1)});
  if (anchored && moves && draw(0.2))
    effects.emplace_back(Absorbing{random.uniform(0.1, 0.5), speed * decades(random, -1, 1)});
  if (draw(0.1)) effects.emplace_back(Adhesion{mass * speed * speed * decades(random, -3, 0), 200});
  return effects;
}

// The program's own step for two thirds of all scenes; the others get a right one, a coarse one, or nonsense.
void draw_step(Scene& scene, Random& random) {
  const double limit = scene.method().stability_limit;
  const double way = random.uniform();
  if (way < 0.2)
    scene.integration.theta = random.uniform(0.2, 1) * limit;
  else if (way < 0.25)
    scene.integration.theta = random.uniform(1.02, 3) * limit;
  else if (way < 0.3)
    scene.integration.step = decades(random, -20, 2);
  else if (way < 0.33)
    scene.integration.step = std::array{0.0, -0.01, std::numeric_limits<double>::infinity(),
                                        5e-324}[static_cast<std::size_t>(random.uniform(0, 4))];
}

// Lets the elements of the bodies yield, from stresses of one in 1e4 of E to those that nothing reaches. What yields
// has a law of its own.
void let_yield(Scene& scene, Random& random) {
  double E = 0;
  for (std::shared_ptr<const Body>* of : {&scene.projectile, &scene.target}) {
    if (!(*of)->numbers.of_elements()) continue;
    Body body = **of;
    if (!body.numbers.axisymmetric()) body.numbers.state = "plane_strain";
    body.numbers.law = BodyNumbers{}.law;
    E = std::max(E, body.numbers.stiffness);
    *of = std::make_shared<Body>(body);
  }
  Yielding yielding;
  yielding.yield = E * decades(random, -4, -0.5);
  yielding.hardening = random.uniform() < 0.5 ? 0 : E * decades(random, -4, 0);
  yielding.on = !scene.target->numbers.of_elements()       ? "projectile"
                : !scene.projectile->numbers.of_elements() ? "target"
                                                           : "both";
  scene.effects.emplace_back(yielding);
  scene.integration.method = "verlet";
}

Body half_body(Points outline, const BodyNumbers& numbers, const Vec2& fine, Random& random) {
  Body body{std::move(outline), numbers, {}, {}};
  make_of_elements(body, not_given, fine, random);
  body.numbers.state = "axisymmetric";
  body.numbers.roughness = 0;
  return body;
}

// Half the section of a sphere, an ellipsoid or a cylinder.
Shape random_half(Random& random) {
  const double stretch = random.uniform(0.3, 1.5);
  if (random.uniform() < 0.4) return {"sphere", half_circle()};
  if (random.uniform() < 0.5) {
    Points half = half_circle();
    for (Vec2& p : half) p.y() *= stretch;
    return {fmt::format("ellipsoid({:.2f})", stretch), half};
  }
  return {fmt::format("cylinder({:.2f})", stretch), {{0, -stretch}, {1, -stretch}, {1, stretch}, {0, stretch}}};
}

// Bodies of revolution, which move along their axis alone: on a plane, on a block held below, or on another such body.
RandomScene revolved_scene(std::uint64_t seed, Random& random) {
  RandomScene made;
  Scene& scene = made.scene;
  scene.launch.speed = decades(random, -8, std::log10(3.0));
  // Three quarters of the bodies have a sound 1 to 300 times the speed, so that most impacts are over in some thousand
  // steps.
  const double E = random.uniform() < 0.25 ? 1e4 : std::pow(10 * scene.launch.speed / decades(random, -2.5, 0.5), 2);
  const double ratio = random.uniform() < 0.5 ? decades(random, -6, 6) : decades(random, -2, 2);
  const auto numbers_of = [&](double stiffness) {
    BodyNumbers n = element_numbers(60 + static_cast<int>(random.uniform(0, 120)), stiffness, 0);
    n.seed = static_cast<int>(seed);
    if (random.uniform() < 0.5) n.density = usual_density * decades(random, -3, 3);
    return n;
  };
  const auto free = [](const Vec2&) { return false; };
  const Shape upper = random_half(random);
  scene.projectile =
      std::make_shared<Body>(counted(half_body(upper.outline, numbers_of(E), lowest(upper.outline), random), free));
  const double kind = random.uniform();
  std::string below = "plane";
  Body target;
  if (kind < 0.4) {
    target.plane = Plane{};
    made.flat_rigid = true;
  } else if (kind < 0.7) {
    below = "block";
    const Points block{{0, -2}, {2, -2}, {2, 0}, {0, 0}};
    target = counted(half_body(block, numbers_of(E * ratio), {0, 0}, random),
                     [](const Vec2& q) { return q.y() < -2 + 1e-9; });
  } else {
    const Shape lower = random_half(random);
    below = "free " + lower.name;
    target = counted(half_body(lower.outline, numbers_of(E * ratio), -lowest(lower.outline), random), free);
  }
  scene.target = std::make_shared<Body>(target);
  if (random.uniform() < 0.3) scene.contact.sides = "one";
  const auto& all = methods();
  scene.integration.method = all[static_cast<std::size_t>(random.uniform(0, static_cast<double>(all.size())))].name;
  if (scene.method().multirate()) scene.integration.method = "verlet";
  if (random.uniform() < 0.4) let_yield(scene, random);
  if (random.uniform() < 0.3)
    scene.effects.emplace_back(
        Gravity{scene.launch.speed * scene.launch.speed * decades(random, -4, -1), "projectile"});
  if (random.uniform() < 0.3)
    scene.effects.emplace_back(Drag{scene.launch.speed * decades(random, -3, 0), "projectile"});
  if (!scene.conflict_with(scene.method()).empty()) scene.integration.method = "verlet";
  draw_step(scene, random);
  made.text = fmt::format("{} (E {:.2g}){} on {}{}{}, {:.2g} c, {}-sided, {} step {:.3g} theta {:.3g}{}", upper.name, E,
                          text_of_interior(scene.projectile->numbers), below,
                          target.plane ? "" : fmt::format(" (ratio {:.2g})", ratio),
                          target.plane ? "" : text_of_interior(target.numbers), scene.launch.speed, scene.contact.sides,
                          scene.method().name, scene.integration.step, scene.integration.theta,
                          scene.effects.empty() ? "" : " with " + text_of(scene.effects));
  return made;
}

}  // namespace

RandomScene random_scene(std::uint64_t seed) {
  Random kinds(seed, 609);  // one scene of eight is of bodies of revolution, one of four with elements lets them yield
  if (kinds.uniform() < 0.125) return revolved_scene(seed, kinds);
  Random random(seed, 606);
  RandomScene made;
  Scene& scene = made.scene;
  scene = paper_scene();
  Random choices(seed, 607);  // of what a body weighs and who chooses the contact
  const auto weigh = [&](BodyNumbers& body, double area) {
    if (choices.uniform() < 0.5) return;
    body.density = body.mass * body.nodes / area;
    body.mass = not_given;
  };
  // Half of all ratios within 1e-2 ... 1e2; three quarters of the bodies with springs for which the speed is 1/300 to 3
  // of their sound, so that most impacts are over in some thousand steps.
  const double ratio = random.uniform() < 0.5 ? decades(random, -6, 6) : decades(random, -2, 2),
               mass = decades(random, -3, 3), speed = decades(random, -8, std::log10(3.0));
  const double stiffness = random.uniform() < 0.25 ? 1e4 : std::pow(10 * speed / decades(random, -2.5, 0.5), 2) * mass;
  const auto quartic = [&] { return random.uniform() < 0.3 ? 0.0 : decades(random, -3, 3); };
  const auto placement = [&] {
    return std::array{"uniform", "poisson_disk", "triangular"}[static_cast<std::size_t>(random.uniform(0, 3))];
  };
  const auto roughness = [&] { return random.uniform() < 0.3 ? 0.0 : random.uniform(0, 0.1); };

  const Shape upper = random_shape(random);
  BodyNumbers p = numbers(60 + static_cast<int>(random.uniform(0, 60)), stiffness, roughness(), static_cast<int>(seed),
                          placement());
  p.quartic = quartic();
  p.mass = mass;
  weigh(p, std::abs(signed_area(upper.outline)));
  Random interiors(seed, 608);  // of elements: two scenes of five have a body of them
  const double of_elements = interiors.uniform();
  Body projectile{upper.outline, p, {}, {}};
  if (of_elements < 0.3) make_of_elements(projectile, p.mass, lowest(upper.outline), interiors);
  const auto free = [](const Vec2&) { return false; };
  scene.projectile = std::make_shared<Body>(counted(projectile, free));

  std::string below;
  BodyNumbers t = numbers(100 + static_cast<int>(random.uniform(0, 100)), stiffness / mass * ratio, roughness(),
                          static_cast<int>(seed), placement());
  t.quartic = quartic();
  weigh(t, 7.5);
  const double kind = random.uniform(0, 1);
  const bool target_of_elements = of_elements > 0.15 && of_elements < 0.425;
  if (kind < 0.4) {
    const Shape lower = random_shape(random);
    Body target{lower.outline, t, {}, {}};
    if (target_of_elements) make_of_elements(target, t.mass, -lowest(lower.outline), interiors);
    scene.target = std::make_shared<Body>(counted(target, free));
    below = "free " + lower.name;
  } else {
    const bool rigid = kind < 0.6;
    if (rigid) t.roughness = 0;
    Body wall{box(5, 1.5), t, {}, {}};
    if (target_of_elements && !rigid) make_of_elements(wall, t.mass, {0, 0}, interiors);
    const auto held = [&](const Vec2& q) { return rigid || q.y() < -1.5 + 1e-9 || std::abs(q.x()) > 2.5 - 1e-9; };
    scene.target = std::make_shared<Body>(counted(wall, held));
    below = rigid ? "rigid wall" : "wall";
    made.flat_rigid = rigid;
  }

  scene.launch.speed = speed;
  scene.launch.psi1 = random.uniform() < 0.3   ? 0.0
                      : random.uniform() < 0.8 ? random.uniform(0, 8)
                                               : random.uniform(8, 50);
  if (random.uniform() < 0.4) scene.launch.spin = (random.uniform() < 0.5 ? 1 : -1) * speed * random.uniform(0, 3);
  made.flat_rigid = made.flat_rigid && scene.launch.spin == 0;
  scene.launch.at = random.uniform(-0.6, 0.6);
  if (random.uniform() < 0.5) scene.contact.sides = "two";
  // Strong enough for the whole energy, or the usual one, which the fast and the heavy break through.
  if (random.uniform() < 0.6) scene.contact.V0 = std::max(150.0, mass * p.nodes * speed * speed * 4);

  if (choices.uniform() < 0.35) scene.contact = ExponentialRepulsion{};

  const auto& all = methods();
  scene.integration.method = all[static_cast<std::size_t>(random.uniform(0, static_cast<double>(all.size())))].name;
  const bool with_elements = scene.projectile->numbers.of_elements() || scene.target->numbers.of_elements();
  if (with_elements && interiors.uniform() < 0.5) scene.effects = random_effects(speed, mass, *scene.target, interiors);
  if (with_elements && kinds.uniform() < 0.25) let_yield(scene, kinds);
  if (!scene.conflict_with(scene.method()).empty()) scene.integration.method = "verlet";
  draw_step(scene, random);
  made.text = fmt::format(
      "{} ({}, {} nodes, springs {:.2g}, quartic {:.2g}, mass {:.2g}, rough {:.2g}){} on {} ({}, {} nodes, ratio "
      "{:.2g}, quartic {:.2g}, rough {:.2g}){}, {:.2g} c, psi1 {:.2g}, spin {:.2g}, {}-sided xi {:.3g}, {} step {:.3g} "
      "theta {:.3g}{}",
      upper.name, p.placement, scene.projectile->numbers.nodes, stiffness, p.quartic, mass, p.roughness,
      text_of_interior(scene.projectile->numbers), below, t.placement, scene.target->numbers.nodes, ratio, t.quartic,
      t.roughness, text_of_interior(scene.target->numbers), speed, scene.launch.psi1, scene.launch.spin,
      scene.contact.sides, scene.contact.xi, scene.method().name, scene.integration.step, scene.integration.theta,
      scene.effects.empty() ? "" : " with " + text_of(scene.effects));
  return made;
}

}  // namespace ricochet::test
