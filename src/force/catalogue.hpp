#pragma once
// The effects that a scene may name. What is not named is not computed: the engine loops over an empty list.

#include <array>
#include <concepts>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "force/node/absorbing.hpp"
#include "force/node/drag.hpp"
#include "force/node/gravity.hpp"
#include "force/spring/damping.hpp"

namespace ricochet {

/// A new effect is its header and its name here; everything else (the Lua function, its checks and documentation, the column of its
/// energy, the tests of all effects) follows.
using Effect = std::variant<Gravity, Drag, Absorbing, Damping>;

inline constexpr std::size_t effect_kinds = std::variant_size_v<Effect>;

/// Has a potential energy; its force is evaluated with all others.
template <class E>
concept Conservative = requires(const E& effect, Moving<1>& moving) {
  effect.add_forces(0, moving);
  { effect.energy(0, moving) } -> std::convertible_to<Lane<1>>;
};

/// Takes from each node a share of its velocity, by a rate that depends on its place at rest; solved exactly beside the step.
template <class E>
concept NodeDamping = requires(const E& effect, const Lattice& lattice) {
  { effect.rates(0, lattice) } -> std::same_as<std::vector<double>>;
};

/// Takes energy from the relative motion of the ends of springs, beside the step.
template <class E>
concept SpringDamping = requires(const E& effect, Moving<1>& moving, const Lane<1>& h) {
  { effect.damp(0, moving, h, true) } -> std::convertible_to<Lane<1>>;
};

/// True for an effect that depends on velocities: a step is then split, half of it before and half after, which is of order 2.
inline bool is_split(const Effect& effect) {
  return std::visit([]<class E>(const E&) { return !Conservative<E>; }, effect);
}

/// Calls `use` with a default-made effect of every kind.
template <class Use>
void each_effect_kind(Use&& use) {
  [&]<std::size_t... i>(std::index_sequence<i...>) { (use(std::variant_alternative_t<i, Effect>{}), ...); }(std::make_index_sequence<effect_kinds>{});
}

/// "gravity g = 0.1 on = projectile" for every effect, a line each.
std::string text_of(std::span<const Effect> effects);

}  // namespace ricochet
