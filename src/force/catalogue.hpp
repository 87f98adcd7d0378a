#pragma once
// The effects that a scene may name. What is not named is not computed: the engine loops over an empty list.

#include <array>
#include <concepts>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "force/contact/adhesion.hpp"
#include "force/contact/friction.hpp"
#include "force/node/absorbing.hpp"
#include "force/node/drag.hpp"
#include "force/node/gravity.hpp"
#include "force/node/moving_anchor.hpp"
#include "force/spring/breaking.hpp"
#include "force/spring/damping.hpp"
#include "force/spring/plastic.hpp"
#include "force/spring_memory.hpp"
#include "force/start/thermal.hpp"

namespace ricochet {

/// A new effect is its header and its name here; everything else (the Lua function, its checks and documentation, the
/// column of its energy, the tests of all effects) follows from what it says it is, by the concepts below.
using Effect =
    std::variant<Gravity, Drag, Absorbing, MovingAnchor, Damping, Plastic, Breaking, Adhesion, Friction, Thermal>;

inline constexpr std::size_t effect_kinds = std::variant_size_v<Effect>;

/// A force on nodes that has a potential energy; evaluated with all others.
template <class E>
concept NodeForce = requires(const E& effect, Moving<1>& moving) {
  effect.add_forces(0, moving);
  { effect.energy(0, moving) } -> std::convertible_to<Lane<1>>;
};

/// Takes from each node a share of its velocity, by a rate that depends on its place at rest; solved exactly beside the
/// step.
template <class E>
concept NodeDamping = requires(const E& effect, const Lattice& lattice) {
  { effect.rates(0, lattice) } -> std::same_as<std::vector<double>>;
};

/// Takes energy from the relative motion of the ends of springs, beside the step.
template <class E>
concept SpringDamping = requires(const E& effect, Moving<1>& moving, const Lane<1>& h) {
  {
    effect.damp(0, moving, h, true, [](int) { return 1.0; })
    } -> std::convertible_to<Lane<1>>;
};

/// Springs that remember: what is left of each depends on two numbers, which change as it is stretched. One to a body.
template <class E>
concept SpringChange = requires(const E& effect, const Spring& spring, const Lane<1>& stretch,
                                SpringMemory<1>& memory) {
  { effect.rest(stretch, memory) } -> std::same_as<SpringRest<Lane<1>>>;
  { effect.change(Linear{}, spring, stretch, memory) } -> std::convertible_to<Lane<1>>;
  { effect.exceeded(0.0) } -> std::same_as<bool>;
};

/// Moves the target's anchors.
template <class E>
concept AnchorMotion = requires(const E& effect) {
  { effect.displacement(0.0) } -> std::same_as<Vec2>;
  { effect.velocity(0.0) } -> std::same_as<Vec2>;
};

/// A potential of a rim node and a rim segment, beside the repulsion.
template <class E>
concept PairForce = requires(const E& effect) {
  { effect.energy(0.0) } -> std::same_as<double>;
  { effect.force(0.0) } -> std::same_as<double>;
};

/// Acts between rims by what they remember of each other.
template <class E>
concept PairMemory = requires(const E& effect) {
  effect.slide(0.0, 0.0, 0.0, 1.0);
};

/// Only sets how an impact starts.
template <class E>
concept AtStart = std::same_as<E, Thermal>;

/// Scenes that differ in its numbers alone can still share a batch.
template <class E>
concept OwnNumbers = AtStart<E> || AnchorMotion<E>;

/// True for an effect that depends on velocities, on the past or on time: it is computed beside the step, or by a step
/// that evaluates each place once, which is of order 2.
inline bool is_split(const Effect& effect) {
  return std::visit([]<class E>(const E&) { return !(NodeForce<E> || PairForce<E> || AtStart<E>); }, effect);
}

/// The order to which outcomes converge beside an effect, whatever the method; 0: that of the method.
inline int order_beside(const Effect& effect) {
  return std::visit(
      []<class E>(const E& e) {
        if constexpr (requires { E::order; })
          return E::order;
        else
          return is_split(Effect(e)) ? 2 : 0;
      },
      effect);
}

/// The first effect of a kind, or nullptr.
template <class E>
const E* find_effect(std::span<const Effect> effects) {
  for (const Effect& effect : effects)
    if (const E* found = std::get_if<E>(&effect)) return found;
  return nullptr;
}

/// Why effects cannot stand together; empty if they can.
std::string conflict_of(std::span<const Effect> effects);

/// Calls `use` with a default-made effect of every kind.
template <class Use>
void each_effect_kind(Use&& use) {
  [&]<std::size_t... i>(std::index_sequence<i...>) { (use(std::variant_alternative_t<i, Effect>{}), ...); }
  (std::make_index_sequence<effect_kinds>{});
}

/// "gravity g = 0.1 on = projectile" for every effect, a line each.
std::string text_of(std::span<const Effect> effects);

/// The same, without the numbers in which scenes of one batch may differ.
std::string batch_text_of(std::span<const Effect> effects);

}  // namespace ricochet
