#pragma once
// One impact in the hands of a test, which may change its state and look at it between any two steps.

#include "core/rng.hpp"
#include "impact/engine.hpp"
#include "scenes.hpp"

namespace ricochet::test {

using SolidPointer = std::shared_ptr<const Solid>;

/// Positions, velocities and energies of one impact, step by step.
class Alone {
 public:
  Alone(BuiltSolids solids, Scene scene)
      : solids_(std::move(solids)), scene_(std::move(scene)), engine_(solids_, scene_.method(), scene_.effects) {
    if (engine_.begin(0, scene_, 0)) throw Error("the projectile passes by the target");
  }
  Alone(SolidPointer projectile, SolidPointer target, Scene scene)
      : Alone(BuiltSolids({std::move(projectile), std::move(target)}), std::move(scene)) {}
  Alone(const Alone&) = delete;
  explicit Alone(const Scene& scene) : Alone(BuiltSolids(scene), scene) {}

  void steps(std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) engine_.advance_one_step();
  }
  Snapshot now() { return engine_.snapshot(0); }
  double step() const { return engine_.run(0).start.step; }
  Engine<1>& engine() { return engine_; }

  /// The motion runs backwards from here.
  void reverse() {
    engine_.change([](Motions<1>& bodies) {
      for (Motion<1>& body : bodies)
        for (int c = 0; c < body.solid->free_coordinates(); ++c) body.v[c] *= -1;
    });
  }

 private:
  BuiltSolids solids_;
  Scene scene_;
  Engine<1> engine_;
};

/// A disk about the origin that flies, spins and vibrates by itself, far above the wall that a scene must have.
/// Vibration: of this speed at every node [c].
inline std::unique_ptr<Alone> free_disk(const std::string& method, double theta, const Vec2& velocity, double spin,
                                        double vibration, int nodes = 60) {
  Scene scene = paper_scene();
  scene.projectile = disk(nodes, 1e4, 0.03, 1);
  scene.target = wall(60, 400, 0, 1);
  scene.integration.method = method;
  scene.integration.theta = theta;
  auto alone = std::make_unique<Alone>(scene);
  alone->engine().change([&](Motions<1>& bodies) {
    for (int i = 0; i < bodies[1].solid->nodes(); ++i) bodies[1].q[2 * i + 1] -= 10.0;
    Motion<1>& body = bodies[0];
    Random random(5, 3);
    const Vec2 centre = body.solid->centre();
    for (int i = 0; i < body.solid->nodes(); ++i) {
      body.q.set(i, 0, body.solid->points[static_cast<std::size_t>(i)] - centre);
      const double x = random.normal(), y = random.normal();
      body.v.set(i, 0,
                 velocity + spin * perpendicular(body.solid->points[static_cast<std::size_t>(i)] - centre) +
                     vibration * Vec2(x, y));
    }
  });
  return alone;
}

}  // namespace ricochet::test
