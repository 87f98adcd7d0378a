#include "record/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "impact/axes.hpp"
#include "impact/launch/launch.hpp"
#include "impact/roles.hpp"

namespace ricochet {
namespace {

using S = const Sample&;
using Quantities = std::vector<std::pair<Field, std::function<double(S)>>>;

Quantities of_motion() {
  return {
      {{"time", "number", "R/c", "since the rims came within reach of each other"}, [](S s) { return s.time; }},
      {{"step", "number", "", "steps since then"}, [](S s) { return static_cast<double>(s.step); }},
      {{"x", "number", "R", "where the projectile's centre is, along the surface"},
       [](S s) { return tangential(s.projectile.centre); }},
      {{"height", "number", "R", "height of the projectile's centre"}, [](S s) { return normal(s.projectile.centre); }},
      {{"vn", "number", "c", "normal velocity of the projectile"}, [](S s) { return normal(s.projectile.velocity); }},
      {{"vt", "number", "c", "tangential velocity of the projectile"},
       [](S s) { return tangential(s.projectile.velocity); }},
      {{"omega", "number", "c/R", "spin of the projectile"}, [](S s) { return s.projectile.spin; }},
      {{"angle", "number", "rad",
        "that the projectile has turned by since the rims came within reach, counter-clockwise"},
       [](S s) { return s.projectile.angle; }},
      {{"target_vn", "number", "c", "normal velocity of the target; 0 if held"},
       [](S s) { return normal(s.target.velocity); }},
      {{"target_vt", "number", "c", "tangential velocity of the target; 0 if held"},
       [](S s) { return tangential(s.target.velocity); }},
      {{"target_omega", "number", "c/R", "spin of the target; 0 if held"}, [](S s) { return s.target.spin; }},
  };
}

Quantities of_contact() {
  return {
      {{"force_n", "number", "m0 c^2/R", "normal force of contact on the projectile"},
       [](S s) { return normal(s.force); }},
      {{"force_t", "number", "m0 c^2/R", "tangential force of contact on the projectile"},
       [](S s) { return tangential(s.force); }},
      {{"overlap", "number", "R",
        "how much nearer along the normal the centres are than at the first touch; undefined before it"},
       [](S s) { return s.overlap; }},
      {{"indentation", "number", "R",
        "overlap along the normal of the smooth outlines, undeformed, unrotated; below 0 where they are apart"},
       [](S s) { return s.indentation; }},
      {{"contact_length", "number", "R",
        "along the surface, between the outermost nodes of the projectile that bear more than 1 % of the force on the "
        "one that bears most; 0 without contact"},
       [](S s) { return s.contact_length; }},
  };
}

Quantities of_energy() {
  return {
      {{"vibration", "number", "m0 c^2", "energy of the vibration of both bodies"},
       [](S s) { return s.projectile.energy.vibration + s.target.energy.vibration; }},
      {{"projectile_translation", "number", "m0 c^2", "energy: projectile, centre of mass"},
       [](S s) { return s.projectile.energy.translation; }},
      {{"projectile_rotation", "number", "m0 c^2", "energy: projectile, spin"},
       [](S s) { return s.projectile.energy.rotation; }},
      {{"projectile_vibration", "number", "m0 c^2", "energy: projectile, vibration"},
       [](S s) { return s.projectile.energy.vibration; }},
      {{"target_translation", "number", "m0 c^2", "energy: target, centre of mass (0 if held)"},
       [](S s) { return s.target.energy.translation; }},
      {{"target_rotation", "number", "m0 c^2", "energy: target, spin (0 if held)"},
       [](S s) { return s.target.energy.rotation; }},
      {{"target_vibration", "number", "m0 c^2", "energy: target, vibration"},
       [](S s) { return s.target.energy.vibration; }},
      {{"contact_energy", "number", "m0 c^2", "energy of the repulsion"}, [](S s) { return s.contact_energy; }},
      {{"effects_energy", "number", "m0 c^2",
        "energy gained in the potentials of effects and lost to those that dissipate, since the start"},
       [](S s) { return s.effects_energy; }},
      {{"total_energy", "number", "m0 c^2", "the sum of all"}, [](S s) { return s.total_energy; }},
  };
}

// Three of a body, whose names begin with `prefix`.
void add_stresses(Quantities& list, const std::string& prefix, BodySample Sample::*body) {
  const std::string of = prefix.empty() ? "projectile" : "target";
  list.push_back(
      {{prefix + "pressure_max", "number", "m0 c^2/R^3",
        "greatest pressure in the " + of +
            ", minus the mean of the normal stresses, of the nodes' means of their elements; of a plane body "
            "over its thickness, which is R in the paper's units; undefined without elements"},
       [body](S s) { return (s.*body).stress.pressure; }});
  list.push_back({{prefix + "von_mises_max", "number", "m0 c^2/R^3", "the same of von Mises's stress"},
                  [body](S s) { return (s.*body).stress.von_mises; }});
  list.push_back({{prefix + "von_mises_depth", "number", "R",
                   "how far from the surface the node of that stress is, at rest; undefined without elements"},
                  [body](S s) { return (s.*body).stress.von_mises_depth; }});
}

Quantities of_stress() {
  Quantities list;
  add_stresses(list, "", &Sample::projectile);
  add_stresses(list, "target_", &Sample::target);
  return list;
}

// The turn since the start that brings the body at rest nearest to its places, weighed by mass: where the sum of
// m r x p' vanishes.
double turn_of(const Solid& solid, const Turn& at_start, const Points& places, const Vec2& centre) {
  const Vec2 rest = solid.centre();
  double sine = 0, cosine = 0;
  for (int i = 0; i < solid.nodes(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec2 before = at_start(solid.points[k] - rest), now = places[k] - centre;
    sine += solid.mass[i] * cross(before, now);
    cosine += solid.mass[i] * before.dot(now);
  }
  return std::atan2(sine, cosine);
}

// Along the surface, between the outermost nodes that bear more than 1 % of the strongest force; a half that an axis
// parts from the other begins there.
double length_of(const BodyShot& body, bool half) {
  double strongest = 0;
  for (const Vec2& force : body.force) strongest = std::max(strongest, force.norm());
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < body.force.size(); ++i) {
    if (!(body.force[i].norm() > 0.01 * strongest)) continue;
    low = std::min(low, tangential(body.place[i]));
    high = std::max(high, tangential(body.place[i]));
  }
  return half ? 2 * std::max(0.0, high) : high > low ? high - low : 0.0;
}

}  // namespace

const std::vector<std::pair<Field, std::function<double(const Sample&)>>>& Sample::fields() {
  static const Quantities list = [] {
    Quantities all = of_motion();
    for (const Quantities& more : {of_contact(), of_energy(), of_stress()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return list;
}

const std::function<double(const Sample&)>& Sample::value_named(const std::string& name) {
  for (const auto& [field, value] : fields())
    if (field.name == name) return value;
  throw std::logic_error("a sample has no " + name);
}

Sampler::Sampler(const Scene& scene, const Solids& solids, const Start& start)
    : scene_(scene),
      solids_(solids),
      start_(start),
      last_time_(std::numeric_limits<double>::quiet_NaN()),
      angle_(solids.size(), 0.0),
      spin_(solids.size(), 0.0) {}

// Between the centres, after a flight in which nothing but gravity has acted.
double Sampler::height_at(double first_touch) const {
  const auto of = [&](std::size_t body) {
    return normal(in_flight(scene_, solids_, start_, body, first_touch).centre);
  };
  return of(role::projectile) - of(role::target);
}

GreatestStress Sampler::stress_of(std::size_t body, const BodyShot& shot) const {
  const Body& of = *scene_.bodies()[body];
  GreatestStress stress = greatest_stress(*solids_[body], of.numbers.stiffness, shot);
  if (!of.material || solids_[body]->axisymmetric) return stress;
  const double thickness = of.material->thickness / scene_.units.length;
  stress.pressure /= thickness;
  stress.von_mises /= thickness;
  return stress;
}

namespace {

// Chain after chain, with a place of NaN between two.
Points outline_of(const Surface& surface, const std::vector<Vec2>& place) {
  Points outline;
  const auto* mesh = std::get_if<Mesh<2>>(&surface);
  if (!mesh) return outline;
  for (const Chain& chain : chains_of(mesh->cell)) {
    if (!outline.empty()) outline.emplace_back(not_given, not_given);
    for (const int node : chain.node)
      outline.push_back(place[static_cast<std::size_t>(mesh->node[static_cast<std::size_t>(node)])]);
  }
  return outline;
}

}  // namespace

Sample Sampler::operator()(const Snapshot& shot) {
  Sample sample;
  sample.time = shot.time;
  sample.step = shot.step;
  for (const std::size_t b : {role::projectile, role::target}) {
    BodySample& body = b == role::projectile ? sample.projectile : sample.target;
    body = {shot.rigid[b].centre,  shot.rigid[b].velocity,       0, shot.rigid[b].spin,
            shot.energy.bodies[b], stress_of(b, shot.bodies[b]), {}};
    body.outline = outline_of(solids_[b]->surface, shot.bodies[b].place);
    if (solids_[b]->anchored() || solids_[b]->axisymmetric) continue;
    // Whole turns are those that the spin has made since the last time.
    const double since = std::isnan(last_time_) ? shot.time : shot.time - last_time_;
    const double expected = angle_[b] + since * (std::isnan(last_time_) ? body.spin : spin_[b]);
    const double turn = turn_of(*solids_[b], start_.bodies[b].turn, shot.bodies[b].place, body.centre),
                 whole = 2 * std::numbers::pi;
    body.angle = turn + whole * std::round((expected - turn) / whole);
    angle_[b] = body.angle;
    spin_[b] = body.spin;
  }
  last_time_ = shot.time;
  const BodyShot& projectile = shot.bodies[role::projectile];
  for (const Vec2& force : projectile.force) sample.force += force;
  const bool half = solids_[role::projectile]->axisymmetric;
  if (half) sample.force = normal(sample.force) * upwards();  // what is radial balances itself
  const double height = normal(sample.projectile.centre) - normal(sample.target.centre);
  sample.indentation = start_.overlap_height - height;
  sample.first_touch = shot.first_touch;
  sample.touch_height = height_at(shot.first_touch);
  sample.overlap = sample.touch_height - height;
  if (shot.energy.contact > touch_share * start_.energy) sample.contact_length = length_of(projectile, half);
  sample.contact_energy = shot.energy.contact;
  sample.effects_energy = shot.energy.effects;
  sample.total_energy = shot.energy.total();
  return sample;
}

void settle_overlaps(std::vector<Sample>& samples) {
  if (samples.empty()) return;
  const double first_touch = samples.back().first_touch, height = samples.back().touch_height;
  for (Sample& sample : samples)
    sample.overlap = sample.time < first_touch
                         ? std::numeric_limits<double>::quiet_NaN()
                         : height - (normal(sample.projectile.centre) - normal(sample.target.centre));
}

}  // namespace ricochet
