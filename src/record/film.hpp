#pragma once
// An impact as frames (core/frame.hpp), for pictures and trajectory files.

#include <atomic>
#include <functional>
#include <vector>

#include "core/frame.hpp"
#include "impact/launch/start.hpp"
#include "impact/outcome.hpp"
#include "impact/scene.hpp"
#include "record/series.hpp"

namespace ricochet {

/// What one has to know of an impact to choose the times of its frames. Times since the rims came within reach. [R/c]
struct Course {
  Outcome outcome;
  double step = 0;
  double first_touch = 0, last_touch = 0;  ///< within 0.1
  double touched = Outcome::undefined;     ///< when they first touched, to a step; NaN if they never did
  double tightest = 0;                     ///< when contact holds the most energy
};

/// All bodies of a scene as one mesh.
FrameMesh frame_mesh(const Scene& scene, const Solids& solids);

/// The same with what was learned of its course.
FrameMesh frame_mesh(const Scene& scene, const Solids& solids, const Course& course);

/// One body alone, in no scene.
FrameMesh body_mesh(const Solid& solid, double stiffness);

/// Runs a scene once without frames. Throws FieldError "scene" if the projectile passes by.
Course follow_course(const Solids& solids, const Scene& scene, const std::atomic<bool>& stop);

/// `count` times from `from` to `until` [R/c]: equally spaced, but `slow_motion` times denser while the bodies touch.
/// Throws FieldError "frames" if they are closer than a time step.
std::vector<double> frame_times(const Course& course, double from, double until, int count, double slow_motion);

/// Rising times at which a run is sampled, beside its frames. [R/c]
struct Sampling {
  std::vector<double> times;
  std::function<void(const Sample&)> see;
};

/// Runs a scene and hands over its frames at rising times, each at the step that ends nearest. Frames before 0 are free
/// flight. It goes on past the end of the impact if the times do, and ends with the last of them. Returns false if
/// `stop` ended it.
bool film_scene(const Solids& solids, const Scene& scene, const std::vector<double>& times,
                const std::atomic<bool>& stop, const std::function<void(Frame)>& use, const Sampling& sampling = {});

}  // namespace ricochet
