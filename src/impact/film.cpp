#include "impact/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/turn.hpp"
#include "impact/batch.hpp"
#include "impact/launch.hpp"

namespace ricochet {
namespace {

// How closely a course is followed. [R/c]
constexpr double course_spacing = 0.1;

void append(std::vector<Eigen::Vector2f>& all, const Points& points) {
  for (const Vec2& p : points) all.push_back(p.cast<float>());
}

Frame frame_of(const Snapshot& shot) {
  Frame frame;
  frame.time = shot.time;
  frame.step = shot.step;
  append(frame.position, shot.projectile);
  append(frame.position, shot.target);
  append(frame.velocity, shot.projectile_velocity);
  append(frame.velocity, shot.target_velocity);
  append(frame.contact_force, shot.projectile_force);
  append(frame.contact_force, shot.target_force);
  const Ledger& e = shot.energy;
  frame.energy = {e.projectile_translation,
                  e.projectile_rotation,
                  e.projectile_vibration,
                  e.target_translation,
                  e.target_rotation,
                  e.target_vibration,
                  e.contact,
                  e.total()};
  return frame;
}

// The projectile's nodes as they were before, when it flew and turned freely.
Frame moved_back(const Snapshot& shot, const Start& start, double time) {
  Snapshot earlier = shot;
  const double c = std::cos(start.spin * time), s = std::sin(start.spin * time);
  Vec2 centre = Vec2::Zero();
  for (const Vec2& p : shot.projectile) centre += p / static_cast<double>(shot.projectile.size());
  for (Vec2& p : earlier.projectile) p = centre + time * start.velocity + turned(p - centre, c, s);
  for (Vec2& v : earlier.projectile_velocity) v = start.velocity + turned(v - start.velocity, c, s);
  earlier.time = time;
  earlier.step = static_cast<std::int64_t>(std::floor(time / start.step));
  return frame_of(earlier);
}

// Elastic elongations where the past of a spring counts, one after another for both bodies.
void add_elongations(Frame& frame, const Snapshot& shot, const Lattice& projectile, const Lattice& target) {
  if (shot.springs[0].empty() && shot.springs[1].empty()) return;
  for (int b : {0, 1}) {
    const Lattice& lattice = b == 0 ? projectile : target;
    const auto& rests = shot.springs[static_cast<std::size_t>(b)];
    const Points& places = b == 0 ? shot.projectile : shot.target;
    for (std::size_t s = 0; s < lattice.spring.size(); ++s) {
      const Spring spring = lattice.spring[s];
      if (rests.empty())
        frame.elongation.push_back(
            static_cast<float>((places[spring.node] - places[spring.other]).norm() - spring.length));
      else
        frame.elongation.push_back(rests[s].share > 0 ? static_cast<float>(rests[s].elastic)
                                                      : std::numeric_limits<float>::quiet_NaN());
    }
  }
}

}  // namespace

FrameMesh frame_mesh(const Scene& scene, const Lattice& projectile, const Lattice& target) {
  FrameMesh mesh;
  mesh.projectile_nodes = projectile.nodes();
  mesh.mass = {projectile.mass, target.mass};
  mesh.quartic = {projectile.quartic, target.quartic};
  const Vec2 velocity = scene.launch.velocity();
  mesh.psi1 = velocity.y() < 0 ? velocity.x() / -velocity.y() : not_given;
  int offset = 0;
  for (int b : {0, 1}) {
    const Lattice& lattice = b == 0 ? projectile : target;
    const double stiffness = (b == 0 ? scene.projectile : scene.target)->numbers.stiffness;
    for (int i = 0; i < lattice.nodes(); ++i) {
      mesh.rest.push_back(lattice.points[i]);
      mesh.anchored.push_back(i >= lattice.free);
      for (int s = lattice.first[i]; s < lattice.first[i + 1]; ++s) {
        const Spring spring = lattice.spring[s];
        mesh.springs.push_back({i + offset, spring.other + offset});
        mesh.length.push_back(spring.length);
        mesh.stiffness.push_back(spring.stiffness * stiffness);
      }
    }
    for (const Triangle& t : lattice.triangles) mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    for (const int node : lattice.rim) mesh.rims[static_cast<std::size_t>(b)].push_back(node + offset);
    offset += lattice.nodes();
  }
  return mesh;
}

Course follow_course(const Lattice& projectile, const Lattice& target, const Scene& scene,
                     const std::atomic<bool>& stop) {
  const Start start = launch(scene, projectile, target);
  if (!start.touches) throw FieldError("scene", "the projectile passes by the target: there is nothing to show");
  Course course;
  course.step = start.step;
  double most = 0;
  bool touched = false;
  const auto look = [&](const Snapshot& shot) {
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
  course.outcome = run_scene(projectile, target, scene, stop, &observer);
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

bool film_scene(const Lattice& projectile, const Lattice& target, const Scene& scene, const std::vector<double>& times,
                const std::atomic<bool>& stop, const std::function<void(Frame)>& use) {
  const Start start = launch(scene, projectile, target);
  if (!start.touches) throw FieldError("scene", "the projectile passes by the target: there is nothing to show");
  std::size_t next = 0;
  const auto is_due = [&](double time) { return next < times.size() && time >= times[next] - start.step / 2; };
  const auto look = [&](const Snapshot& shot) {
    const auto hand_over = [&](Frame frame) {
      add_elongations(frame, shot, projectile, target);
      use(std::move(frame));
      ++next;
    };
    while (next < times.size() && shot.time == 0 && times[next] < -start.step / 2)
      hand_over(moved_back(shot, start, times[next]));
    if (is_due(shot.time)) hand_over(frame_of(shot));
  };
  const Observer observer{times.empty() ? 0 : times.back() + start.step, is_due, look, true};
  run_scene(projectile, target, scene, stop, &observer);
  return !stop;
}

}  // namespace ricochet
