#pragma once
// The kernels of an impact without effects, called by hand: what the engine is held against.

#include "impact/engine.hpp"
#include "impact/launch/launch.hpp"

namespace ricochet::test {

/// Full lanes of one scene, moved by a composition of kicks and drifts: contact and sweeps, and nothing else.
class BareSteps {
 public:
  BareSteps(const Solids& solids, const Scene& scene) : state_(solids, scene.method(), {}) {
    const Start start = launch(scene, solids);
    for (int lane = 0; lane < lanes; ++lane) state_.place(lane, start, {});
  }

  [[gnu::noinline]] void one_bare_step() {
    const Lane<lanes>& h = state_.h;
    for (const Stage& stage : state_.method.stages) {
      state_.contacts.push(state_.bodies, state_.contact_energy);
      for (Motion<lanes>& body : state_.bodies)
        kick_and_drift(body, Lane<lanes>(stage.kick * h), Lane<lanes>(stage.drift * h));
    }
  }

  double contact_energy() const { return state_.contact_energy[0][0]; }

 private:
  State<lanes> state_;
};

}  // namespace ricochet::test
