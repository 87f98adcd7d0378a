#pragma once
// What is told of an impact at a moment, as numbers: the points of a series.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/field.hpp"
#include "impact/launch/start.hpp"
#include "impact/scene.hpp"
#include "impact/snapshot.hpp"
#include "record/stress.hpp"

namespace ricochet {

/// A body at a moment; a held one has no rigid motion.
struct BodySample {
  Vec2 centre, velocity;  ///< of mass [R], [c]
  double angle = 0;       ///< that it has turned by since time 0, counter-clockwise: what fits its nodes best [rad]
  double spin = 0;        ///< [c/R]
  BodyEnergy energy;
  GreatestStress stress;  ///< pressures of space: a plane body's over its thickness [m0 c^2/R^3]
  Points outline;         ///< places of the nodes of its surface, along it, NaN between chains; of a plane none [R]
};

struct Sample {
  double time = 0;  ///< since the surfaces came within reach of each other [R/c]
  std::int64_t step = 0;
  BodySample projectile, target;
  Vec2 force = Vec2::Zero();                 ///< of contact on the projectile [m0 c^2/R]
  double overlap = 0, indentation = 0;       ///< [R]
  double first_touch = 0, touch_height = 0;  ///< as known by then: when it was, how far the centres were apart [R/c, R]
  double contact_length = 0;                 ///< [R]
  double contact_energy = 0, effects_energy = 0, total_energy = 0;  ///< [m0 c^2]

  /// Every number of it by name, the time first.
  static const std::vector<std::pair<Field, std::function<double(const Sample&)>>>& fields();
  static const std::function<double(const Sample&)>& value_named(const std::string& name);
};

/// Makes samples of what an observer sees of one run, at rising times. Refers to the scene and the solids.
class Sampler {
 public:
  Sampler(const Scene& scene, const Solids& solids, const Start& start);
  Sample operator()(const Snapshot& shot);

 private:
  double height_at(double first_touch) const;
  GreatestStress stress_of(std::size_t body, const BodyShot& shot) const;

  const Scene& scene_;
  const Solids& solids_;
  const Start& start_;
  double last_time_;
  std::vector<double> angle_, spin_;  // [body] at the last time
};

/// When the first touch was is settled by the greatest load, which comes after it: the overlaps of samples in the order
/// of time, by what the last of them knows.
void settle_overlaps(std::vector<Sample>& samples);

}  // namespace ricochet
