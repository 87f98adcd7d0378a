#pragma once
// The sweeps over springs that remember (plastic, breaking), written once for every such effect: what differs from the
// springs' own law is added to it, so that the sweep of springs.hpp knows nothing of memories.

#include <array>
#include <vector>

#include "force/spring/rest.hpp"
#include "force/springs.hpp"

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

/// Calls `use(law, i, s, spring, d, r)` for every spring, by rising s: d the vector from node i to the other end, r its
/// length.
template <int W, class Use>
void each_spring(const Moving<W>& body, Use&& use) {
  const Lattice& lattice = *body.lattice;
  with_spring_law(lattice, [&](const auto& law) {
    for (int i = 0; i < lattice.free; ++i)
      for (int s = lattice.first[i]; s < lattice.first[i + 1]; ++s) {
        const Spring spring = lattice.spring[s];
        const Lane<W> dx = body.position.x(spring.other) - body.position.x(i),
                      dy = body.position.y(spring.other) - body.position.y(i);
        use(law, i, s, spring, dx, dy, Lane<W>((dx * dx + dy * dy).sqrt()));
      }
  });
}

/// Adds to the forces what the effect makes of the tensions, after memories have changed if they do so at every
/// evaluation; returns the energy lost by that. [m0 c^2]
template <int W, class E>
Lane<W> add_changed_forces(const E& effect, Moving<W>& body, std::vector<SpringMemory<W>>& memory) {
  Lane<W> lost = Lane<W>::Zero();
  each_spring(body, [&](const auto& law, int i, int s, const Spring& spring, const Lane<W>& dx, const Lane<W>& dy,
                        const Lane<W>& r) {
    const Lane<W> stretch = r - spring.length;
    if constexpr (!E::changes_at_step_ends) lost += spring.stiffness * effect.change(law, spring, stretch, memory[s]);
    const Lane<W> more =
        (body.stiffness * spring.stiffness) * (tension_of(effect, law, stretch, memory[s]) - law.tension(stretch)) / r;
    body.force.x(i) += more * dx;
    body.force.y(i) += more * dy;
    body.force.x(spring.other) -= more * dx;
    body.force.y(spring.other) -= more * dy;
  });
  return body.stiffness * lost;
}

/// Lets memories change at the positions that springs have now; returns the energy lost. [m0 c^2]
template <int W, class E>
Lane<W> change_springs(const E& effect, const Moving<W>& body, std::vector<SpringMemory<W>>& memory) {
  Lane<W> lost = Lane<W>::Zero();
  each_spring(body,
              [&](const auto& law, int, int s, const Spring& spring, const Lane<W>&, const Lane<W>&, const Lane<W>& r) {
                lost += spring.stiffness * effect.change(law, spring, Lane<W>(r - spring.length), memory[s]);
              });
  return body.stiffness * lost;
}

/// By how much the energy of the springs differs from spring_energy(body). [m0 c^2]
template <int W, class E>
Lane<W> spring_energy_change(const E& effect, const Moving<W>& body, const std::vector<SpringMemory<W>>& memory) {
  Lane<W> sum = Lane<W>::Zero();
  each_spring(body,
              [&](const auto& law, int, int s, const Spring& spring, const Lane<W>&, const Lane<W>&, const Lane<W>& r) {
                const Lane<W> stretch = r - spring.length;
                sum += spring.stiffness * (energy_of(effect, law, stretch, memory[s]) - law.energy(stretch));
              });
  return body.stiffness * sum;
}

}  // namespace ricochet
