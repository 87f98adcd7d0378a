#pragma once
// The sweeps over springs that remember, written once for every effect that makes them so: what differs from the
// springs' own law is added to it, so that the sweep of sweep.hpp knows nothing of memories.

#include <array>
#include <vector>

#include "body/springs/rest.hpp"
#include "body/springs/sweep.hpp"

namespace ricochet {

/// What a spring remembers; its effect says what the two numbers are.
template <int W>
using SpringMemory = std::array<Lane<W>, 2>;

/// Tension and energy of a spring that remembers, per unit of k.
template <class E, class Law, class Number>
Number tension_of(const E& effect, const Law& law, const Number& stretch, const std::array<Number, 2>& memory) {
  const SpringRest<Number> rest = effect.rest(stretch, memory);
  return rest.share * law.tension(rest.elastic);
}
template <class E, class Law, class Number>
Number energy_of(const E& effect, const Law& law, const Number& stretch, const std::array<Number, 2>& memory) {
  const SpringRest<Number> rest = effect.rest(stretch, memory);
  return rest.share * law.energy(rest.elastic);
}

/// Adds to the forces what the effect makes of the tensions, after memories have changed if they do so at every
/// evaluation; returns the energy lost by that. [m0 c^2]
template <int D, int W, class E>
Lane<W> add_changed_forces(const E& effect, Motion<W>& body, const Springs& springs,
                           std::vector<SpringMemory<W>>& memory) {
  Lane<W> lost = Lane<W>::Zero();
  Place<W, D>* force = body.f.template places<D>();
  each_spring<D>(body, springs,
                 [&](const auto& law, int i, int s, const Spring& spring, const Place<W, D>& d, const Lane<W>& r) {
                   const Lane<W> stretch = r - spring.length;
                   if constexpr (!E::changes_at_step_ends)
                     lost += spring.stiffness * effect.change(law, spring, stretch, memory[s]);
                   const Lane<W> more = (body.stiffness * spring.stiffness) *
                                        (tension_of(effect, law, stretch, memory[s]) - law.tension(stretch)) / r;
                   force[i] += more * d;
                   force[spring.other] -= more * d;
                 });
  return body.stiffness * lost;
}

/// Lets memories change at the positions that springs have now; returns the energy lost. [m0 c^2]
template <int D, int W, class E>
Lane<W> change_springs(const E& effect, const Motion<W>& body, const Springs& springs,
                       std::vector<SpringMemory<W>>& memory) {
  Lane<W> lost = Lane<W>::Zero();
  each_spring<D>(body, springs,
                 [&](const auto& law, int, int s, const Spring& spring, const Place<W, D>&, const Lane<W>& r) {
                   lost += spring.stiffness * effect.change(law, spring, Lane<W>(r - spring.length), memory[s]);
                 });
  return body.stiffness * lost;
}

/// By how much the energy of the springs differs from spring_energy(body). [m0 c^2]
template <int D, int W, class E>
Lane<W> spring_energy_change(const E& effect, const Motion<W>& body, const Springs& springs,
                             const std::vector<SpringMemory<W>>& memory) {
  Lane<W> sum = Lane<W>::Zero();
  each_spring<D>(body, springs,
                 [&](const auto& law, int, int s, const Spring& spring, const Place<W, D>&, const Lane<W>& r) {
                   const Lane<W> stretch = r - spring.length;
                   sum += spring.stiffness * (energy_of(effect, law, stretch, memory[s]) - law.energy(stretch));
                 });
  return body.stiffness * sum;
}

}  // namespace ricochet
