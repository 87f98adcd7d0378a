#pragma once
// One impact in the hands of a test, which may change its state and look at it between any two steps.

#include "impact/engine.hpp"
#include "scenes.hpp"

namespace ricochet::test {

using LatticePointer = std::shared_ptr<const Lattice>;

/// Positions, velocities and energies of one impact, step by step.
class Alone {
 public:
  Alone(LatticePointer projectile, LatticePointer target, Scene scene)
      : projectile_(std::move(projectile)),
        target_(std::move(target)),
        scene_(std::move(scene)),
        engine_(*projectile_, *target_, scene_.method(), scene_.effects) {
    if (engine_.begin(0, scene_, 0)) throw Error("the projectile passes by the target");
  }
  Alone(const Alone&) = delete;
  explicit Alone(const Scene& scene) : Alone(build_lattice(*scene.projectile), build_lattice(*scene.target), scene) {}

  void steps(std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) engine_.advance_one_step();
  }
  Snapshot now() { return engine_.snapshot(0); }
  double step() const { return engine_.run(0).start.step; }
  Engine<1>& engine() { return engine_; }

  /// The motion runs backwards from here.
  void reverse() {
    engine_.change([](Engine<1>::Bodies& bodies) {
      for (Moving<1>& body : bodies)
        for (int i = 0; i < body.lattice->free; ++i) {
          body.velocity.x(i) *= -1;
          body.velocity.y(i) *= -1;
        }
    });
  }

 private:
  LatticePointer projectile_, target_;
  Scene scene_;
  Engine<1> engine_;
};

/// A disk about the origin that flies, spins and vibrates by itself, far above the wall that a scene must have.
/// Vibration: of this speed at every node [c].
inline std::unique_ptr<Alone> free_disk(const std::string& method, double theta, const Vec2& velocity, double spin,
                                        double vibration, int nodes = 60) {
  Scene scene;
  scene.projectile = disk(nodes, 1e4, 0.03, 1);
  scene.target = wall(60, 400, 0, 1);
  scene.integration.method = method;
  scene.integration.theta = theta;
  auto alone = std::make_unique<Alone>(scene);
  alone->engine().change([&](Engine<1>::Bodies& bodies) {
    for (int i = 0; i < bodies[1].lattice->nodes(); ++i) bodies[1].position.y(i) -= 10;
    Moving<1>& body = bodies[0];
    Random random(5, 3);
    const Vec2 centre = body.lattice->centre();
    for (int i = 0; i < body.lattice->nodes(); ++i) {
      body.position.set(i, 0, body.lattice->points[static_cast<std::size_t>(i)] - centre);
      const double x = random.normal(), y = random.normal();
      body.velocity.set(i, 0,
                        velocity + spin * perpendicular(body.lattice->points[static_cast<std::size_t>(i)] - centre) +
                            vibration * Vec2(x, y));
    }
  });
  return alone;
}

}  // namespace ricochet::test
