#include "impact/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "impact/axes.hpp"
#include "impact/elastic.hpp"
#include "impact/roles.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

// Greatest pressure over the yield stress where yielding begins.
double yields_at(const Scene& scene) { return scene.projectile->numbers.axisymmetric() ? 1.60 : 1.67; }

bool flows(const Scene& scene, std::size_t body) {
  return flowing(scene.effects, static_cast<int>(body), static_cast<int>(scene.bodies().size())) != nullptr;
}

// 1 if a body that no effect lets yield would begin to, 0 if not; undefined of one whose yield stress nobody knows.
double pressure_over_yield(const Scene& scene, std::size_t b, double pressure) {
  const Body* body = scene.bodies()[b];
  if (!body->material || std::isnan(body->material->yield) || std::isnan(pressure) || flows(scene, b)) return not_given;
  return pressure > yields_at(scene) * body->material->yield ? 1 : 0;
}

// Speeds over c_P up to which no spring of a smooth disk of 1600 nodes folds on a plane: triangular 0.14, and at 0.21 7
// % of the area does; Poisson disks 0.05, and 0.6 % at 0.07; uniform points 0.02, and some at 0.05. [here]
double folding_speed(const std::string& placement) {
  return placement == "triangular" ? 0.15 : placement == "poisson_disk" ? 0.055 : 0.025;
}

// Speed over c_P up to which a body of modes rebounds as the elements that its modes are of: there e of a disk differs
// by 0.002, at twice that by 0.01. [here]
constexpr double fastest_modes = 0.05;

// So much more than enough is told, which two digits may take away.
constexpr double told_margin = 1.05;

// How many triangles of a mesh along half of the contact, and nodes of a lattice along all of it, tell the force to
// some per cent.
constexpr double enough_triangles = 8, enough_nodes = 4;

// Whether a body resolves the contact at this place of it. `radius`: of its outline there.
void add_doubts_of_mesh(const Scene& scene, std::size_t b, const Vec2& place, double radius, Estimate& e) {
  const Body& body = *scene.bodies()[b];
  if (body.rigid()) return;
  const std::string name = body_name(b);
  const auto add = [&](const char* kind, std::string reason) { e.doubts.push_back({kind, std::move(reason)}); };
  const bool meshed = body.numbers.meshed();
  const double spacing = spacing_of(body, place), half = e.impact.half_width / spacing;
  const auto told = [&](double x) { return scene.units.shown(std::abs(x) < 1e-9 ? 0 : x, "R"); };  // without rounding
  const auto finer = [&](double times) {
    times *= told_margin;
    if (!meshed) return fmt::format("take {:.2g} times as many nodes", times * times);
    if (spacing > 1.5 * body.numbers.h_min)
      return fmt::format("its mesh is finest elsewhere, give fine_at = {{ {}, {} }}", told(tangential(place)),
                         told(normal(place)));
    return fmt::format("take h_min = {}", scene.units.shown(spacing / times, "R", 2));
  };
  if (meshed && half < enough_triangles)
    add("coarse_contact",
        fmt::format("half of the contact is as wide as {:.2g} of the {}'s triangles there, and {:g} are needed for e "
                    "within one per cent: {}",
                    half, name, enough_triangles, finer(enough_triangles / half)));
  if (!meshed && 2 * half < enough_nodes)
    add("coarse_contact",
        fmt::format("the contact is {:.2g} node spacings of the {} long, and {:g} are needed for a force within some "
                    "per cent: {}",
                    2 * half, name, enough_nodes, finer(enough_nodes / (2 * half))));
  const double sagitta = spacing * spacing / (8 * std::abs(radius)), most = 0.1 * e.impact.approach;
  if (sagitta > most)
    add("coarse_rim", fmt::format("the polygon that the {}'s rim is strays from the outline by {:.2g} of the "
                                  "indentation: {}",
                                  name, sagitta / e.impact.approach, finer(std::sqrt(sagitta / most))));
}

void add_doubts_of_yield(const Scene& scene, std::size_t b, Estimate& e) {
  if (pressure_over_yield(scene, b, e.pressure) != 1) return;
  const Body& body = *scene.bodies()[b];
  const bool both = flows(scene, role::projectile + role::target - b);
  e.doubts.push_back(
      {"over_yield",
       fmt::format(
           "the greatest pressure passes {:g} times the yield stress of the {}, where yielding begins, which no "
           "effect lets yield{}",
           yields_at(scene), body_name(b),
           body.numbers.interior != "elements" ? ""
           : both                              ? "; give ricochet.yielding on = \"both\""
                  : fmt::format("; add ricochet.yielding {{ on = \"{}\" }}", body_name(b)))});
}

// The least depth of a block that stands for a half-space, over the contact's time at a wave speed, for what it takes
// of the energy to be at most 15 % too great: c_P where waves come back from its edges, c_S where they leave, which
// bear no lasting load. Of spheres at 1e-3 and 1e-2 c0: 57 and 1 % at 0.25 and 0.5 c_S. [here]
constexpr double deep_enough = 0.4, deep_enough_of_open = 0.43;

// A body of revolution that is held in one node alone floats: it stands for a half-space. So does one whose edges
// absorb.
void add_doubts_of_block(const Scene& scene, Estimate& e) {
  const Body& block = *scene.target;
  if (block.rigid() || !block.numbers.axisymmetric()) return;
  const bool open = std::any_of(scene.effects.begin(), scene.effects.end(),
                                [](const Effect& effect) { return std::holds_alternative<AbsorbingEdges>(effect); });
  if (!open && std::count(block.anchored.begin(), block.anchored.end(), true) != 1) return;
  const Elastic elastic = elastic_of(block);
  const Box box = bounding_box(block.outline);
  const double extent = std::min(tangential(box.high), normal(Vec2(box.high - box.low)));
  const double enough =
      e.impact.time * (open ? deep_enough_of_open * elastic.shear_speed() : deep_enough * elastic.wave_speed());
  if (extent >= enough) return;
  e.doubts.push_back(
      {"small_half_space",
       fmt::format(
           "the target, {} deep and wide, is too small for a half-space: the contact lasts so long that {}, and "
           "the energy that it takes is more than 15 % too great; take extent = {}{}",
           scene.units.shown(extent, "R", 3),
           open ? "it moves as a whole on its absorbing edges" : "waves come back from its edges",
           scene.units.shown(told_margin * enough, "R", 2), open ? "" : ", or add ricochet.absorbing_edges {}")});
}

void add_doubts_of_speed(const Scene& scene, Estimate& e) {
  for (const Body* body : scene.bodies()) {
    if (body->rigid()) continue;
    const double share = e.normal_speed / elastic_of(*body).wave_speed();
    if (body->numbers.interior != "springs") continue;  // elements resist being turned over
    const double most = folding_speed(body->numbers.placement);
    if (share > most)
      e.doubts.push_back(
          {"folding",
           fmt::format("at {:.2g} of a body's wave speed springs of a {} lattice fold, which takes energy that "
                       "no solid would; stay below {:g} of it, or take a triangular lattice",
                       share, body->numbers.placement, most)});
  }
}

}  // namespace

double spacing_of(const Body& body, const Vec2& place) {
  if (body.rigid()) return 0;
  return body.numbers.meshed() ? body.size_field()(place) : std::sqrt(signed_area(body.outline) / body.numbers.nodes);
}

double pressure_over_yield(const Scene& scene, double pressure) {
  return std::fmax(pressure_over_yield(scene, role::projectile, pressure),
                   pressure_over_yield(scene, role::target, pressure));
}

void add_doubts_of_bodies(const Scene& scene, double speed, Estimate& e) {
  for (const Body* body : scene.bodies()) {
    if (body->rigid()) continue;
    const double share = speed / elastic_of(*body).wave_speed();
    if (share > 1)
      e.doubts.push_back(
          {"supersonic", fmt::format("at {:.2g} of a body's wave speed nothing runs ahead of the contact, and strains "
                                     "are no small ones; in SI, are E and density in Pa and kg/m^3?",
                                     share)});
    if (!body->numbers.of_modes()) continue;
    if (share > fastest_modes)
      e.doubts.push_back(
          {"fast_modes",
           fmt::format("at {:.2g} of a body's wave speed strains are too large for modes, which are those "
                       "of small ones; stay below {:g} of it, or give interior = \"{}\"",
                       share, fastest_modes, body->numbers.modes_of)});
    if (body->numbers.modes > 0 && std::isnan(scene.contact.xi))
      e.doubts.push_back(
          {"few_modes",
           fmt::format("a rim of {} modes cannot yield to the contact that the program chooses for a whole "
                       "body, and chatters: leave modes out, or give a softer contact.xi and see whether "
                       "e stays with half of it",
                       body->numbers.modes)});
  }
}

void add_doubts_of_contact(const Scene& scene, const std::array<Vec2, 2>& places, const std::array<double, 2>& radii,
                           Estimate& e) {
  for (const std::size_t b : {role::projectile, role::target}) add_doubts_of_mesh(scene, b, places[b], radii[b], e);
  add_doubts_of_speed(scene, e);
  for (const std::size_t b : {role::projectile, role::target}) add_doubts_of_yield(scene, b, e);
  add_doubts_of_block(scene, e);
}

}  // namespace ricochet
