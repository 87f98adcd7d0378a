#pragma once
// The effects that a scene may name. What is not named is not computed: the engine loops over an empty list.

#include <array>
#include <concepts>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "body/springs/memory.hpp"
#include "contact/contact_laws.hpp"
#include "effect/element/absorbing_edges.hpp"
#include "effect/element/yielding.hpp"
#include "effect/node/absorbing.hpp"
#include "effect/node/drag.hpp"
#include "effect/node/gravity.hpp"
#include "effect/node/moving_anchor.hpp"
#include "effect/spring/breaking.hpp"
#include "effect/spring/damping.hpp"
#include "effect/spring/plastic.hpp"
#include "effect/start/thermal.hpp"

namespace ricochet {

/// A new effect is its header and its name here; everything else (the Lua function, its checks and documentation, the
/// column of its energy, the tests of all effects) follows from what it says it is, by the concepts below.
using Effect = std::variant<Gravity, Drag, Absorbing, MovingAnchor, Damping, Plastic, Breaking, Adhesion, Friction,
                            Thermal, Yielding, AbsorbingEdges>;

inline constexpr std::size_t effect_kinds = std::variant_size_v<Effect>;

/// A force on nodes that has a potential energy; evaluated with all others.
template <class E>
concept NodeForce = requires(const E& effect, Motion<1>& body) {
  effect.add_forces(body);
  { effect.energy(body) } -> std::convertible_to<Lane<1>>;
};

/// Takes from each node a share of its velocity, by a rate that depends on its place at rest; solved exactly beside the
/// step.
template <class E>
concept NodeDamping = requires(const E& effect, const Solid& solid) {
  { effect.rates(solid) } -> std::same_as<std::vector<double>>;
};

/// Takes energy from the relative motion of the ends of springs, beside the step.
template <class E>
concept SpringDamping = requires(const E& effect, Motion<1>& body, const Springs& springs, const Lane<1>& h) {
  {
    effect.damp(body, springs, h, true, [](int) { return 1.0; })
    } -> std::convertible_to<Lane<1>>;
};

/// Takes energy from the rates of strain of elements, beside the step.
template <class E>
concept ElementDamping = requires(const E& effect, Motion<1>& body, const Elements& elements, const Lane<1>& h) {
  { effect.damp(body, elements, h, true) } -> std::convertible_to<Lane<1>>;
};

/// Springs that remember: what is left of each depends on two numbers, which change as it is stretched. One to a body.
template <class E>
concept SpringChange = requires(const E& effect, const Spring& spring, const Lane<1>& stretch,
                                SpringMemory<1>& memory) {
  { effect.rest(stretch, memory) } -> std::same_as<SpringRest<Lane<1>>>;
  { effect.change(Linear{}, spring, stretch, memory) } -> std::convertible_to<Lane<1>>;
  { effect.exceeded(0.0) } -> std::same_as<bool>;
};

/// Moves a body's anchors.
template <class E>
concept AnchorMotion = requires(const E& effect) {
  { effect.displacement(0.0) } -> std::same_as<Vec2>;
  { effect.velocity(0.0) } -> std::same_as<Vec2>;
};

/// A potential of a node and a cell of another surface, beside the repulsion.
template <class E>
concept PairForceEffect = std::constructible_from<PairForce, E>;

/// Acts between surfaces by what they remember of each other.
template <class E>
concept PairMemory = std::same_as<E, GripLaw>;

/// Only sets how an impact starts.
template <class E>
concept AtStart = requires {
  E::only_at_start;
};

/// Lets elements flow, by a law of its own.
template <class E>
concept ElementFlow = requires {
  E::lets_elements_flow;
};

/// Lets waves out through edges of elements.
template <class E>
concept EdgeDamping = requires(const E& effect, const Solid& solid) {
  { effect.dashpots(solid) } -> std::same_as<std::vector<EdgeDashpot>>;
};

/// Acts on springs.
template <class E>
concept OnSprings = SpringDamping<E> || SpringChange<E>;

/// Acts on springs, and on what else may hold a body together only if that is elements that it damps; a body of another
/// interior refuses it.
template <class E>
bool acts_inside(const Solid& solid) {
  return !OnSprings<E> || solid.springs() || (ElementDamping<E> && solid.elements());
}

/// Scenes that differ in its numbers alone can still share a batch.
template <class E>
concept OwnNumbers = AtStart<E> || AnchorMotion<E>;

/// Brings energy beside that of the launch, or lowers the wall that the contact is.
template <class E>
concept BringsEnergy = NodeForce<E> || PairForceEffect<E> || AnchorMotion<E> || AtStart<E>;

inline std::string name_of(const Effect& effect) {
  return std::visit([]<class E>(const E&) { return std::string(E::name); }, effect);
}

/// How anchors move: the numbers of the effect that moves them.
using AnchorCourse = MovingAnchor;

/// The bodies that an effect acts on, of `count`; one without a choice acts on what holds anchors: the target.
std::vector<int> bodies_of(const Effect& effect, int count);

/// What acts between surfaces.
ContactLaws contact_laws(std::span<const Effect> effects);

/// True for an effect that depends on velocities, on the past or on time: it is computed beside the step, or by a step
/// that evaluates each place once, which is of order 2.
inline bool is_split(const Effect& effect) {
  return std::visit([]<class E>(const E&) { return !(NodeForce<E> || PairForceEffect<E> || AtStart<E>); }, effect);
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

/// Why effects cannot act on these bodies or beside this contact; empty if they can.
std::string conflict_with(std::span<const Effect> effects, std::span<const Solid* const> solids,
                          const ExponentialRepulsion& contact);

/// Acceleration of a body that touches nothing. [c^2/R] `body`: its index, of `count`.
Vec3 fall_of(std::span<const Effect> effects, int body, int count);

/// The effect that lets the elements of a body flow, or nullptr. `body`: its index, of `count`.
const Yielding* flowing(std::span<const Effect> effects, int body, int count);

/// Where anchors are moved to before an impact begins. [R]
Vec2 displacement_at_start(std::span<const Effect> effects);

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
