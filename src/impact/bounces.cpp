#include "impact/bounces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "impact/axes.hpp"
#include "impact/engine.hpp"
#include "impact/launch/launch.hpp"

namespace ricochet {
namespace {

// A touch that lasts longer is no bounce. [R/c]
constexpr double longest_touch = 100;

/// Follows one run from touch to touch.
class Follower {
 public:
  Follower(const Solids& solids, const Scene& scene, const Start& start, const std::atomic<bool>& stop)
      : engine_(solids, scene.method(), scene.effects),
        start_(start),
        fall_(normal(free_fall(scene, solids, role::projectile)) - normal(free_fall(scene, solids, role::target))),
        stop_(stop) {
    engine_.begin(0, scene, 0, start);
    see();
  }

  /// The next bounce; none if it cannot be followed to its top: `reason` then tells why.
  std::optional<Bounce> next() {
    Bounce bounce{};
    const int touches = touch().count();
    if (!advance([&] { return touch().count() > touches; }, [&] { watch_fall(); })) return std::nullopt;
    see();
    bounce.time = time();
    bounce.speed = -speed_;
    const double touched_at = height_;
    parted_.reset();
    bool rose = false;
    const auto watch_touch = [&] {
      rose = rose || speed_ > 0;
      if (rose && speed_ <= 0 && !touch().touching())
        reason = fmt::format("it rose no farther than the reach of the contact, {:.3g} R", start_.contact.reach);
      if (time() - bounce.time > longest_touch)
        reason = fmt::format("the bodies had not parted {:g} R/c after their touch", longest_touch);
    };
    if (!advance([&] { return parted_.has_value(); }, watch_touch)) return std::nullopt;
    // It has fallen on since the first load was seen: the touch began a little later.
    const double began = touch().last_begin();
    bounce.speed -= fall_ * (began - bounce.time);
    bounce.time = began;
    bounce.e = *parted_ / bounce.speed;
    const auto watch_rise = [&] { bounce.height = std::max(bounce.height, height_ - touched_at); };
    if (!advance([&] { return speed_ <= 0; }, watch_rise)) return std::nullopt;
    return bounce;
  }

  std::string reason;  ///< why no bounce follows

 private:
  const Run& run() const { return engine_.run(0); }
  const TouchClock& touch() const { return run().clock(); }
  double time() const { return run().time(); }

  void see() {
    const std::vector<RigidShot> rigid = engine_.snapshot(0).rigid;
    const RigidShot &projectile = rigid[role::projectile], &target = rigid[role::target];
    height_ = normal(projectile.centre) - normal(target.centre);
    speed_ = normal(projectile.velocity) - normal(target.velocity);
  }

  // Past the side of a target that is not wide enough.
  void watch_fall() {
    if (height_ < start_.overlap_height - run().projectile_radius) reason = "the projectile fell past the target";
  }

  // Looks at the engine, and lets `watch` look at what is seen.
  template <class Watching>
  void look(Watching watch) {
    see();
    for (const auto& [lane, outcome] : engine_.look())
      if (outcome.status == Status::finished)
        parted_ = outcome.vn;
      else
        reason = fmt::format("the run ended {}: {}", name_of(outcome.status), outcome.reason);
    if (parted_ && time() > start_.time_limit)
      reason = fmt::format("the time_limit of {:g} R/c was over", start_.time_limit);
    watch();
  }

  // Steps until `there` holds, watching at every look. False if a reason to end comes first.
  template <class There, class Watching>
  bool advance(There there, Watching watch) {
    while (!there()) {
      engine_.advance_one_step();
      engine_.look_closely();
      if (++steps_ % engine_.steps_between_looks() != 0) continue;
      look(watch);
      if (stop_) reason = "interrupted";
      if (!reason.empty() && !there()) return false;
    }
    return true;
  }

  Engine<1> engine_;
  Start start_;
  double fall_;  // the acceleration of the projectile that the target sees, along the normal [c^2/R]
  const std::atomic<bool>& stop_;
  std::int64_t steps_ = 0;
  double height_ = 0, speed_ = 0;  // of the projectile's centre over the target's, when last seen [R, c]
  std::optional<double> parted_;   // the speed at parting, since the last touch
};

Start start_of(const Scene& scene, const Solids& solids) {
  check_bounces(scene);
  Start start = launch(scene, solids);
  // The usual limit is that of one impact.
  if (std::isnan(scene.integration.time_limit)) start.time_limit = std::numeric_limits<double>::infinity();
  return start;
}

}  // namespace

void check_bounces(const Scene& scene) {
  const int count = static_cast<int>(scene.bodies().size());
  if (fall_of(scene.effects, role::projectile, count) == Vec3::Zero())
    throw FieldError("effects",
                     "bounces need gravity on the projectile, which brings it back; add ricochet.gravity { g = 1e-3 }");
}

Bounces follow_bounces(const Solids& solids, const Scene& scene, int count, double least_height,
                       const std::atomic<bool>& stop) {
  const Start start = start_of(scene, solids);
  Bounces bounces;
  if (!start.touches) {
    bounces.reason = "the projectile passes by the target";
    return bounces;
  }
  const double least = std::isnan(least_height) ? start.contact.reach : least_height;
  Scene parting = scene;
  parting.ending = {};
  Follower follower(solids, parting, start, stop);
  for (int k = 1; k <= count && bounces.reason.empty(); ++k) {
    if (const auto bounce = follower.next()) {
      bounces.list.push_back(*bounce);
      if (k < count && bounce->height < least)
        bounces.reason = fmt::format("bounce {} rises by {:.3g} R, less than {:.3g} R", k, bounce->height, least);
    } else {
      bounces.reason = fmt::format("bounce {} does not end: {}", k, follower.reason);
    }
  }
  return bounces;
}

}  // namespace ricochet
