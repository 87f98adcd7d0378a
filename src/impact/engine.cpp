// The members of Engine<W>, for every lane width there is.

#include "impact/engine.hpp"

#include "impact/launch/launch.hpp"
#include "impact/launch/step.hpp"

namespace ricochet {

template <int W>
Engine<W>::Engine(const Solids& solids, const Method& method, const std::vector<Effect>& effects, int threads)
    : state_(solids, method, effects, W == 1 ? threads : 1), moving_(state_), watch_(state_) {}

template <int W>
std::optional<Outcome> Engine<W>::begin(int lane, const Scene& scene, std::size_t index) {
  const Start start = launch(scene, state_.solids);
  if (!start.touches) return passes_by();
  begin(lane, scene, index, start);
  return std::nullopt;
}

template <int W>
void Engine<W>::begin(int lane, const Scene& scene, std::size_t index, const Start& start) {
  state_.place(lane, start, scene.effects);
  watch_.begin(lane, scene, index, start);
  moving_.begin(lane);
}

template <int W>
void Engine<W>::advance_one_step(bool seen) {
  looks_closely_ = watch_.due();
  moving_.advance_one_step(seen || looks_closely_);
  watch_.count_step();
}

template <int W>
std::vector<typename Engine<W>::Ended> Engine<W>::look_closely() {
  if (!looks_closely_) return {};
  moving_.go_to_step_end();
  return watch_.look_closely();
}

template <int W>
std::vector<typename Engine<W>::Ended> Engine<W>::look() {
  moving_.go_to_step_end();
  return watch_.look();
}

template <int W>
Snapshot Engine<W>::snapshot(int lane) {
  moving_.go_to_step_end();
  const RigidMotions<W> motions = rigid_motions(state_.end);
  const Energies<W> energies(state_, state_.end, motions);
  Snapshot shot;
  shot.time = run(lane).time();
  shot.step = run(lane).steps;
  shot.energy = energies.ledger(lane, run(lane).effects_before);
  shot.first_touch = run(lane).clock().begin();
  for (const RigidMotion<W>& motion : motions)
    shot.rigid.push_back({{motion.centre.at[0][lane], motion.centre.at[1][lane]},
                          {motion.velocity.at[0][lane], motion.velocity.at[1][lane]},
                          motion.spin.at[2][lane]});
  Motions<W> pushed = state_.end;
  state_.contacts.push_copies(lane, pushed);
  for (std::size_t b = 0; b < pushed.size(); ++b) {
    const Motion<W>& body = state_.end[b];
    BodyShot& seen = shot.bodies.emplace_back();
    for (Points* points : {&seen.place, &seen.velocity, &seen.force})
      points->reserve(static_cast<std::size_t>(body.solid->nodes()));
    for (int i = 0; i < body.solid->nodes(); ++i) {
      seen.place.push_back(body.q.at(i, lane));
      seen.velocity.push_back(body.v.at(i, lane));
      seen.force.push_back(pushed[b].f.at(i, lane));
    }
    if (body.flow)
      for (const PlasticMemory<W>& m : body.flow->memory)
        seen.plastic.push_back({m.xx[lane], m.xy[lane], m.yy[lane], m.zz[lane], m.strain[lane]});
    const Springs* springs = body.solid->springs();
    if (!springs || !state_.effects.changes_springs(static_cast<int>(b))) continue;
    each_spring<2>(body, *springs,
                   [&](const auto&, int, int s, const Spring& spring, const Place<W, 2>&, const Lane<W>& r) {
                     const auto rest = state_.effects.rest(static_cast<int>(b), s, Lane<W>(r - spring.length));
                     seen.springs.push_back({rest.elastic[lane], rest.share[lane]});
                   });
  }
  return shot;
}

template <int W>
void Engine<W>::clear(int lane) {
  watch_.clear(lane);
  state_.clear(lane);
}

template <int W>
Handover Engine<W>::give(int lane) {
  Handover impact{run(lane), {}, state_.effects.anchor_course(lane)};
  state_.carry(lane, impact.carrier);
  return impact;
}

template <int W>
void Engine<W>::take(int lane, Handover&& impact) {
  impact.carrier.turn_round();
  watch_.run(lane) = std::move(impact.run);
  state_.set_laws(lane, run(lane).start);
  state_.effects.set_anchor_course(lane, impact.course);
  state_.carry(lane, impact.carrier);
}

template <int W>
int Engine<W>::steps_between_looks() const {
  return std::max(1, evaluations_between_looks / method().evaluations());
}

template <int W>
void Engine<W>::change(const std::function<void(Motions<W>&)>& by) {
  moving_.go_to_step_end();
  by(state_.end);
  moving_.resume_from_end();
}

// All in one unit: three would read the same headers and instantiate what knows no width three times over.
template class Engine<1>;
template class Engine<2>;
template class Engine<4>;

}  // namespace ricochet
