#include "record/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/wave_speeds.hpp"
#include "core/error.hpp"
#include "core/turn.hpp"
#include "impact/axes.hpp"
#include "impact/batch.hpp"
#include "impact/launch/launch.hpp"
#include "impact/roles.hpp"

namespace ricochet {
namespace {

// How closely a course is followed. [R/c]
constexpr double course_spacing = 0.1;

void append_all(std::vector<float>& all, const Points& points) {
  for (const Vec2& p : points) append(all, p);
}

Frame frame_of(const Snapshot& shot) {
  Frame frame;
  frame.time = shot.time;
  frame.step = shot.step;
  std::size_t entry = 0;
  for (std::size_t b = 0; b < shot.bodies.size(); ++b) {
    append_all(frame.position, shot.bodies[b].place);
    append_all(frame.velocity, shot.bodies[b].velocity);
    append_all(frame.contact_force, shot.bodies[b].force);
    const BodyEnergy& energy = shot.energy.bodies[b];
    for (const double part : {energy.translation, energy.rotation, energy.vibration}) frame.energy[entry++] = part;
  }
  frame.energy[entry++] = shot.energy.contact;
  frame.energy[entry] = shot.energy.total();
  return frame;
}

// The bodies as they were before, when they flew and turned freely; one that falls was held where it began to.
Snapshot moved_back(const Snapshot& shot, const Start& start, double time) {
  Snapshot earlier = shot;
  earlier.time = time;
  earlier.step = static_cast<std::int64_t>(std::floor(time / start.step));
  for (std::size_t b = 0; b < shot.bodies.size(); ++b) {
    const Vec2 velocity = in_plane(start.bodies[b].velocity), fall = in_plane(start.bodies[b].acceleration);
    const double spin = start.bodies[b].spin.z();
    if (velocity == Vec2::Zero() && spin == 0) continue;
    const double since = fall == Vec2::Zero() ? time : std::max(time, -start.fell);
    const Vec2 way = since * velocity + since * since / 2 * fall, faster = since * fall;
    const Turn turn(spin * since);
    BodyShot& body = earlier.bodies[b];
    const Vec2 centre = shot.rigid[b].centre;
    for (Vec2& p : body.place) p = centre + way + turn(p - centre);
    for (Vec2& v : body.velocity) v = velocity + turn(v - velocity) + faster;
    earlier.rigid[b].centre += way;
    earlier.rigid[b].velocity += faster;
    if (fall == Vec2::Zero()) continue;
    double& translation = earlier.energy.bodies[b].translation;
    const double gained = translation * ((velocity + faster).squaredNorm() / velocity.squaredNorm() - 1);
    translation += gained;
    earlier.energy.effects -= gained;
  }
  return earlier;
}

// Elastic elongations where the past of a spring counts, one after another for all bodies.
void add_elongations(Frame& frame, const Snapshot& shot, const Solids& solids) {
  if (std::all_of(shot.bodies.begin(), shot.bodies.end(), [](const BodyShot& body) { return body.springs.empty(); }))
    return;
  for (std::size_t b = 0; b < solids.size(); ++b) {
    const Springs* springs = solids[b]->joined().springs();
    if (!springs) continue;
    const Points& places = shot.bodies[b].place;
    const std::vector<SpringRest<double>>& rests = shot.bodies[b].springs;
    for (std::size_t s = 0; s < springs->list.size(); ++s) {
      const Spring spring = springs->list[s];
      if (rests.empty())
        frame.elongation.push_back(
            static_cast<float>((places[spring.node] - places[spring.other]).norm() - spring.length));
      else
        frame.elongation.push_back(rests[s].share > 0 ? static_cast<float>(rests[s].elastic)
                                                      : std::numeric_limits<float>::quiet_NaN());
    }
  }
}

// [cell] the place of its element in the list, -1 of cells that never strain, which are no elements.
std::vector<int> elements_of_cells(const Solid& solid, const Elements& elements) {
  std::vector<int> of_cells;
  for (Triangle t : solid.cells) {
    std::sort(t.begin(), t.end());
    const auto found = std::lower_bound(elements.nodes.begin(), elements.nodes.end(), t);
    const bool strains = found != elements.nodes.end() && *found == t;
    of_cells.push_back(strains ? static_cast<int>(found - elements.nodes.begin()) : -1);
  }
  return of_cells;
}

// What elements that yield remember, triangle by triangle for all bodies; the others have never flowed.
void add_plastic(Frame& frame, const Snapshot& shot, const Solids& solids) {
  if (std::all_of(shot.bodies.begin(), shot.bodies.end(), [](const BodyShot& body) { return body.plastic.empty(); }))
    return;
  constexpr std::array<double, 5> never{1, 0, 1, 1, 0};
  for (std::size_t b = 0; b < solids.size(); ++b) {
    const std::vector<std::array<double, 5>>& plastic = shot.bodies[b].plastic;
    std::vector<int> element(solids[b]->cells.size(), -1);
    if (const Elements* elements = solids[b]->elements(); elements && !plastic.empty())
      element = elements_of_cells(*solids[b], *elements);
    for (const int e : element)
      for (const double number : e < 0 ? never : plastic[static_cast<std::size_t>(e)])
        frame.plastic.push_back(static_cast<float>(number));
  }
}

// How far a plane is drawn. [R]
constexpr double plane_extent = 1e3;

// The ends of a plane's line about where the projectile is to land; from left to right, so that its inside is hatched.
Points plane_ends(const Plane& plane, const Scene& scene) {
  const Vec2 normal = in_plane(plane.normal), along = -perpendicular(normal);
  const Vec2 middle = plane.offset * normal + scene.launch.at * along;
  return {middle - plane_extent * along, middle + plane_extent * along};
}

std::vector<MeshChain> chains_in_mesh(const Solid& solid, int first) {
  const auto* mesh = std::get_if<Mesh<2>>(&solid.surface);
  if (!mesh) return {{{first, first + 1}, false}};
  std::vector<MeshChain> chains;
  for (const Chain& chain : chains_of(mesh->cell)) {
    chains.push_back({{}, chain.closed});
    for (const int k : chain.node) chains.back().node.push_back(mesh->node[static_cast<std::size_t>(k)] + first);
  }
  return chains;
}

// [cell] E of its element over the body's; 0 of cells that never strain, which are no elements.
std::vector<double> relative_moduli(const Solid& solid, const Elements& elements) {
  std::vector<double> moduli;
  const std::vector<int> of_cells = elements_of_cells(solid, elements);
  for (std::size_t k = 0; k < of_cells.size(); ++k)
    moduli.push_back(of_cells[k] < 0 ? 0
                                     : elements.weight[static_cast<std::size_t>(of_cells[k])] /
                                           measure_at_rest(solid, solid.cells[k]));
  return moduli;
}

// Lame's constants of a body's cells, which are the next triangles of a mesh, if they depend on the place.
void add_constants(FrameMesh& mesh, const Solid& solid, const Elements& elements) {
  if (elements.lame.empty()) return;
  mesh.lame.resize(2 * mesh.triangles.size(), 0.0);
  for (const int e : elements_of_cells(solid, elements)) {
    const Lame lame = e < 0 ? Lame{} : elements.lame[static_cast<std::size_t>(e)];
    mesh.lame.insert(mesh.lame.end(), {lame.lambda, lame.mu});
  }
}

// A body's part of a mesh whose nodes so far are others'. `points`: its nodes at rest, or the ends of a plane's line.
void add_body(FrameMesh& mesh, const Solid& solid, const Points& points, double stiffness) {
  const bool plane = std::holds_alternative<Plane>(solid.surface);
  BodyMesh body{mesh.nodes(), static_cast<int>(points.size()), {}, {}};
  body.axisymmetric = solid.axisymmetric;
  for (int i = 0; i < body.nodes; ++i) {
    append(mesh.rest, points[static_cast<std::size_t>(i)]);
    mesh.mass.push_back(plane ? 1 : solid.mass[i]);
    mesh.anchored.push_back(i >= solid.free);
  }
  if (const Springs* springs = solid.joined().springs()) {
    body.law = numbers_of(springs->law);
    each_spring(*springs, solid.free, [&](int i, int, const Spring& spring) {
      mesh.springs.push_back({i + body.first, spring.other + body.first});
      mesh.length.push_back(spring.length);
      mesh.stiffness.push_back(spring.stiffness * stiffness);
    });
  }
  if (const Elements* elements = solid.joined().elements()) {
    body.solid_law = numbers_of(elements->law);
    mesh.modulus.resize(mesh.triangles.size(), 0.0);
    for (const double relative : relative_moduli(solid, *elements)) mesh.modulus.push_back(stiffness * relative);
    add_constants(mesh, solid, *elements);
  }
  for (const Triangle& t : solid.cells)
    mesh.triangles.push_back({t[0] + body.first, t[1] + body.first, t[2] + body.first});
  if (!mesh.modulus.empty()) mesh.modulus.resize(mesh.triangles.size(), 0.0);
  if (!mesh.lame.empty()) mesh.lame.resize(2 * mesh.triangles.size(), 0.0);
  body.surface = chains_in_mesh(solid, body.first);
  mesh.bodies.push_back(body);
}

bool is_plane(const Solid* solid) { return std::holds_alternative<Plane>(solid->surface); }

// What a plane's snapshot leaves out: the ends of its line, which rest.
Snapshot with_planes(Snapshot shot, const Scene& scene, const Solids& solids) {
  for (std::size_t b = 0; b < solids.size(); ++b)
    if (const Plane* plane = std::get_if<Plane>(&solids[b]->surface)) {
      shot.bodies[b].place = plane_ends(*plane, scene);
      shot.bodies[b].velocity = shot.bodies[b].force = {Vec2::Zero(), Vec2::Zero()};
    }
  return shot;
}

}  // namespace

FrameMesh frame_mesh(const Scene& scene, const Solids& solids) {
  FrameMesh mesh;
  mesh.units = scene.units;
  const Vec2 velocity = scene.launch.velocity();
  const bool slanted = normal(velocity) < 0 && !solids[role::projectile]->axisymmetric;
  mesh.psi1 = slanted ? tangential(velocity) / -normal(velocity) : not_given;
  for (const Effect& effect : scene.effects) mesh.effects.push_back(name_of(effect));
  const auto bodies = scene.bodies();
  for (std::size_t b = 0; b < solids.size(); ++b) {
    const Plane* plane = std::get_if<Plane>(&solids[b]->surface);
    add_body(mesh, *solids[b], plane ? plane_ends(*plane, scene) : solids[b]->points, bodies[b]->numbers.stiffness);
    const WaveSpeeds speeds = wave_speeds(*bodies[b], *solids[b]);
    mesh.bodies.back().wave_speeds = {speeds.pressure, speeds.shear, speeds.surface};
  }
  return mesh;
}

FrameMesh frame_mesh(const Scene& scene, const Solids& solids, const Course& course) {
  FrameMesh mesh = frame_mesh(scene, solids);
  mesh.first_touch = course.touched;
  return mesh;
}

FrameMesh body_mesh(const Solid& solid, double stiffness) {
  FrameMesh mesh;
  mesh.psi1 = not_given;
  add_body(mesh, solid, solid.points, stiffness);
  return mesh;
}

Course follow_course(const Solids& solids, const Scene& scene, const std::atomic<bool>& stop) {
  const Start start = launch(scene, solids);
  if (!start.touches) throw FieldError("scene", "the projectile passes by the target: there is nothing to show");
  Course course;
  course.step = start.step;
  double most = 0;
  bool touched = false;
  const auto look = [&](const Snapshot& shot) {
    course.touched = shot.first_touch;
    if (shot.energy.contact > most) {
      most = shot.energy.contact;
      course.tightest = shot.time;
    }
    if (shot.energy.contact <= touch_share * start.energy) return;
    if (!touched) {
      course.first_touch = shot.time;
      touched = true;
    }
    course.last_touch = shot.time;
  };
  const Observer observer{0, equally_spaced(0, course_spacing, std::numeric_limits<std::int64_t>::max(), start.step),
                          look};
  course.outcome = run_scene(solids, scene, stop, &observer);
  return course;
}

std::vector<double> frame_times(const Course& course, double from, double until, int count, double slow_motion) {
  // Film time runs `slow_motion` times as long while the bodies touch.
  const double a = std::clamp(course.first_touch, from, until), b = std::clamp(course.last_touch, a, until);
  const double total = (a - from) + slow_motion * (b - a) + (until - b);
  std::vector<double> times;
  for (int k = 0; k < count; ++k) {
    const double film = count == 1 ? 0 : total * k / (count - 1), slow = film - (a - from);
    times.push_back(slow <= 0                       ? from + film
                    : slow <= slow_motion * (b - a) ? a + slow / slow_motion
                                                    : b + slow - slow_motion * (b - a));
  }
  for (int k = 1; k < count; ++k)
    if (times[k] - times[k - 1] < course.step * (1 - 1e-9))
      throw FieldError("frames", fmt::format("{} frames in {:.4g} R/c are closer than the time step {:.3g} R/c; ask "
                                             "for {} or fewer, or give the scene a smaller step",
                                             count, until - from, course.step,
                                             static_cast<std::int64_t>(total / slow_motion / course.step) + 1));
  return times;
}

namespace {

/// Times that are asked for one after the other, each at the step that ends nearest.
class Moments {
 public:
  Moments(const std::vector<double>& times, double step) : times_(times), step_(step) {}
  bool due(double time) const { return next_ < times_.size() && time >= times_[next_] - step_ / 2; }
  /// The next one, if it lies in the free flight before the run; 0 if not.
  double before_the_run() const { return next_ < times_.size() && times_[next_] < -step_ / 2 ? times_[next_] : 0.0; }
  void take() { ++next_; }
  double end() const { return times_.empty() ? -step_ : times_.back(); }

 private:
  const std::vector<double>& times_;
  double step_;
  std::size_t next_ = 0;
};

}  // namespace

bool film_scene(const Solids& solids, const Scene& scene, const std::vector<double>& times,
                const std::atomic<bool>& stop, const std::function<void(Frame)>& use, const Sampling& sampling) {
  const Start start = launch(scene, solids);
  if (!start.touches) throw FieldError("scene", "the projectile passes by the target: there is nothing to show");
  Moments frames(times, start.step), samples(sampling.times, start.step);
  Sampler sampler(scene, solids, start);
  const auto hand_over_frame = [&](const Snapshot& shot, const Snapshot& now) {
    Frame frame = frame_of(shot);
    add_elongations(frame, now, solids);
    add_plastic(frame, now, solids);
    use(std::move(frame));
    frames.take();
  };
  const auto hand_over_sample = [&](const Snapshot& shot) {
    sampling.see(sampler(shot));
    samples.take();
  };
  const bool planes = std::any_of(solids.begin(), solids.end(), is_plane);
  const auto see = [&](const Snapshot& shot) {
    while (shot.time == 0) {  // the free flight before, whichever comes first
      const double frame = frames.before_the_run(), sample = samples.before_the_run();
      if (std::min(frame, sample) >= 0) break;
      if (frame <= sample)
        hand_over_frame(moved_back(shot, start, frame), shot);
      else
        hand_over_sample(moved_back(shot, start, sample));
    }
    if (frames.due(shot.time)) hand_over_frame(shot, shot);
    if (samples.due(shot.time)) hand_over_sample(shot);
  };
  const auto look = [&](const Snapshot& shot) { planes ? see(with_planes(shot, scene, solids)) : see(shot); };
  const Observer observer{std::max(frames.end(), samples.end()) + start.step,
                          [&](double time) { return frames.due(time) || samples.due(time); }, look, true};
  run_scene(solids, scene, stop, &observer);
  return !stop;
}

}  // namespace ricochet
