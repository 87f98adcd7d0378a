#pragma once
// How a state moves: what compose.hpp asks of a system, for every body and contact of the list, and one step.

#include "impact/broken.hpp"
#include "impact/state.hpp"
#include "integrate/compose.hpp"
#include "integrate/multirate.hpp"

namespace ricochet {

template <int W>
class Moving {
 public:
  explicit Moving(State<W>& state) : state_(state), unseen_(state.contact_energy) {
    if (state.method.multirate()) {
      const MultirateRoles roles;
      multirate_.emplace(roles, *state.solids[roles.fast], *state.solids[roles.slow]);
    }
  }

  /// Takes a lane that was just placed to where a run stays.
  void begin(int lane) {
    for (std::size_t b = 0; b < state_.bodies.size(); ++b) {  // what a snapshot sees before the first step
      Motion<W>&body = state_.bodies[b], &end = state_.end[b];
      end.stiffness[lane] = body.stiffness[lane];
      for (int c = 0; c < body.q.size(); ++c) {
        end.q[c][lane] = body.q[c][lane];
        end.v[c][lane] = body.v[c][lane];
      }
    }
    if (state_.effects.split()) return;
    Lane<W> alone = Lane<W>::Zero();  // a step of 0 leaves the other lanes as they are, bit for bit
    alone[lane] = state_.h[lane];
    get_ahead(state_.method, alone, Mover{*this, state_.bodies});
  }

  /// `seen`: a look or a snapshot follows.
  void advance_one_step(bool seen) {
    passing_end_ = seen && state_.method.multirate();
    const Mover mover{*this, state_.bodies};
    const Lane<W>& h = state_.h;
    if (state_.effects.split()) {
      // What depends on velocities is split off the step, half before and half after it; both find the ends of steps.
      state_.effects.dissipate(state_.bodies, h / 2, true);
      get_ahead(state_.method, h, mover);
      step(state_.method, h, mover);
      fall_back(state_.bodies);
      state_.effects.dissipate(state_.bodies, h / 2, false);
    } else {
      step(state_.method, h, mover);
    }
    passing_end_ = false;
  }

  /// The state at the end of the last step, in `end`. A multirate method has left it there when it passed.
  void go_to_step_end() {
    if (state_.method.multirate()) return;
    copy_to_end();
    if (!state_.effects.split()) fall_back(state_.end);
    for (Motion<W>& body : state_.end) settle(body);
  }

  /// From the state in `end`, which somebody has changed, on.
  void resume_from_end() {
    for (std::size_t b = 0; b < state_.bodies.size(); ++b) {
      state_.bodies[b].q = state_.end[b].q;
      state_.bodies[b].v = state_.end[b].v;
      state_.bodies[b].modal.state = state_.end[b].modal.state;
    }
    if (!state_.effects.split()) get_ahead(state_.method, state_.h, Mover{*this, state_.bodies});
  }

 private:
  /// What compose.hpp moves.
  struct Mover {
    Moving& moving;
    Motions<W>& bodies;

    State<W>& state() const { return moving.state_; }
    void push() const { state().contacts.push(bodies, state().contact_energy); }

    void kick_and_drift(const Lane<W>& kick, const Lane<W>& drift) const {
      ActingEffects<W>& effects = state().effects;
      const bool shakes = effects.shakes();
      if (shakes) effects.release_anchors(bodies);
      push();
      if (!effects.empty()) effects.add_forces(bodies);
      for (Motion<W>& body : bodies) ricochet::kick_and_drift(body, kick, drift);
      moving.find_broken(bodies);
      if (!shakes) return;
      effects.book_anchors(bodies, kick);
      effects.drift_anchors(bodies, drift);
    }
    void drift(const Lane<W>& by) const {
      for (Motion<W>& body : bodies) ricochet::drift(body, by);
      if (state().effects.shakes()) state().effects.drift_anchors(bodies, by);
    }
    // A kick of displacements that were 0, and a drift with them for a unit of time.
    void displace(const Lane<W>& by) const {
      swap_velocities();
      kick_and_drift(by, Lane<W>::Ones());
      swap_velocities();
    }
    void put_back() const {
      for (std::size_t b = 0; b < bodies.size(); ++b)
        for (int c = 0; c < bodies[b].solid->free_coordinates(); ++c)
          ricochet::put_back(bodies[b].q, state().displacement[b], c);
    }

    auto displaceable() const {
      return displaceable_by([this] { push(); });
    }
    template <class Push>
    Displaceable<W, Push> displaceable_by(Push push) const {
      return {bodies, state().displacement, push};
    }
    void displace_fast(const Lane<W>& by) const {
      moving.multirate_->displace(displaceable(), by);
      moving.find_broken(bodies);
    }
    void put_back_fast() const { moving.multirate_->put_back(displaceable()); }
    void fast(const Lane<W>& kick, const Lane<W>& drift) const {
      moving.multirate_->kick(displaceable(), kick, drift);
      moving.find_broken(bodies);
    }
    // A step ends in the middle of the slow kick, where no drift is under way.
    void displace_slow(const Lane<W>& kick, const Lane<W>& gradient, double mixed) const {
      if (moving.passing_end_) moving.copy_to_end();
      // The contact's energy in the fast part counts, not here.
      const auto push_unseen = [this] { state().contacts.push(bodies, moving.unseen_); };
      moving.multirate_->displace_slow(displaceable_by(push_unseen), kick, gradient, mixed);
      moving.find_broken(bodies);
    }
    void slow(const Lane<W>& kick, const Lane<W>& drift, const Lane<W>& outer_drift) const {
      moving.multirate_->kick_slow(displaceable(), kick, drift, outer_drift);
      moving.find_broken(bodies);
      if (!moving.passing_end_) return;
      for (std::size_t b = 0; b < bodies.size(); ++b)
        for (int c = 0; c < bodies[b].solid->free_coordinates(); ++c) {
          Lane<W>& half_kicked = state().end[b].v[c];
          half_kicked = 0.5 * (half_kicked + bodies[b].v[c]);
        }
    }

    void remember() const { moving.remembered_ = bodies; }
    // Through a kick of velocities that were 0, for a unit of time.
    void evaluate(std::size_t stage) const {
      if (moving.rates_.size() <= stage) moving.rates_.resize(stage + 1);
      std::vector<Rates>& rates = moving.rates_[stage];
      rates.resize(bodies.size());
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        rates[b].velocity = bodies[b].v;
        bodies[b].v.resize(bodies[b].solid->coordinates());  // to zero
      }
      kick_and_drift(Lane<W>::Ones(), Lane<W>::Zero());
      for (std::size_t b = 0; b < bodies.size(); ++b) rates[b].acceleration = bodies[b].v;
    }
    void combine(const Lane<W>& h, const std::vector<double>& weights) const {
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        Motion<W>& body = bodies[b];
        body.q = moving.remembered_[b].q;
        body.v = moving.remembered_[b].v;
        for (std::size_t stage = 0; stage < weights.size(); ++stage) {
          if (weights[stage] == 0) continue;
          const Lane<W> by = weights[stage] * h;
          const Rates& rates = moving.rates_[stage][b];
          for (int c = 0; c < body.solid->free_coordinates(); ++c) {
            body.q[c] += by * rates.velocity[c];
            body.v[c] += by * rates.acceleration[c];
          }
        }
      }
    }

    void swap_velocities() const {
      for (std::size_t b = 0; b < bodies.size(); ++b) std::swap(bodies[b].v, state().displacement[b]);
    }
  };

  struct Rates {
    Coordinates<W> velocity, acceleration;
  };

  void copy_to_end() {
    for (std::size_t b = 0; b < state_.bodies.size(); ++b) {  // forces are 0 in both
      state_.end[b].q = state_.bodies[b].q;
      state_.end[b].v = state_.bodies[b].v;
      state_.end[b].stiffness = state_.bodies[b].stiffness;
      state_.end[b].modal.state = state_.bodies[b].modal.state;
    }
  }

  // Undoes what get_ahead had done.
  void fall_back(Motions<W>& bodies) {
    const Lane<W> back = -state_.method.ahead_drift * state_.h;
    for (Motion<W>& body : bodies) drift(body, back);
    if (state_.effects.shakes()) state_.effects.drift_anchors(bodies, back);
    if (state_.method.ahead_kick == 0) return;
    const std::vector<Lane<W>> contact_energy = state_.contact_energy;
    Mover{*this, bodies}.kick_and_drift(-state_.method.ahead_kick * state_.h, Lane<W>::Zero());
    state_.contact_energy = contact_energy;
  }

  // Looks for lanes that have just broken.
  void find_broken(const Motions<W>& bodies) {
    Lane<W> pulse = Lane<W>::Zero();
    for (const Motion<W>& body : bodies) pulse += body.pulse;
    if ((pulse - pulse == 0).all()) return;
    for (int lane = 0; lane < W; ++lane) {
      std::optional<BodyNode>& broken = state_.broken[static_cast<std::size_t>(lane)];
      if (state_.h[lane] > 0 && !broken && !std::isfinite(pulse[lane])) broken = where_it_broke(bodies, lane);
    }
  }

  State<W>& state_;
  std::optional<Multirate<W>> multirate_;
  std::vector<Lane<W>> unseen_;            // [pair] energies that nobody reads
  Motions<W> remembered_;                  // of a Runge-Kutta step: its beginning
  std::vector<std::vector<Rates>> rates_;  // [stage][body]
  bool passing_end_ = false;               // a multirate method leaves the step's end in `end` when it passes
};

}  // namespace ricochet
