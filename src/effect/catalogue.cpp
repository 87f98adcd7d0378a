#include "effect/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ricochet {
namespace {

template <class E>
std::string line_of(const E& effect) {
  std::string text = E::name;
  for (const auto& member : E::fields())
    std::visit([&](auto place) { text += fmt::format(" {} = {}", member.field.name, effect.*place); }, member.place);
  return text + "\n";
}

// The bodies that an effect acts on; those without a choice meet every other of their kind.
std::string named_bodies(const Effect& effect) {
  return std::visit(
      []<class E>(const E& e) -> std::string {
        if constexpr (requires { e.on; })
          return e.on;
        else
          return "both";
      },
      effect);
}

// Why an effect cannot act on the bodies that it names.
template <class E>
std::string conflict_with_bodies(const E& e, std::span<const Solid* const> solids) {
  const Effect effect(e);
  bool finds_one = PairForceEffect<E> || PairMemory<E>;
  if (finds_one && solids.front()->axisymmetric)
    return fmt::format(
        "{} acts on all rim nodes alike, and those of an axisymmetric body are rings of other areas; "
        "leave it out",
        E::name);
  for (const int b : bodies_of(effect, static_cast<int>(solids.size()))) {
    const Solid& solid = *solids[static_cast<std::size_t>(b)];
    if (solid.modes() && !(PairForceEffect<E> || PairMemory<E>))
      return fmt::format(
          "{} acts inside bodies, and the {} moves as its modes; let it act on another body, leave it "
          "out, or give interior = \"{}\"",
          E::name, body_name(static_cast<std::size_t>(b)), solid.joined().springs() ? "springs" : "elements");
    if constexpr (requires { E::needs_anchors; })
      if (!solid.anchored())
        return fmt::format("{} needs a {} with anchored nodes, and this one is free", E::name,
                           body_name(static_cast<std::size_t>(b)));
    if (AnchorMotion<E> && solid.nodes() == 0)
      return fmt::format("{} moves nodes, and a plane has none; give a {} with interior = \"rigid\"", E::name,
                         body_name(static_cast<std::size_t>(b)));
    if constexpr (AnchorMotion<E>)
      if (solid.axisymmetric && e.direction() != Vec2(0, 1))
        return fmt::format("{} takes the {} off its axis; give along = \"normal\"", E::name,
                           body_name(static_cast<std::size_t>(b)));
    if ((ElementDamping<E> || AtStart<E>)&&solid.axisymmetric)
      return fmt::format("{} is of bodies in the plane, and the {} is axisymmetric; leave it out", E::name,
                         body_name(static_cast<std::size_t>(b)));
    if (EdgeDamping<E> && solid.springs())
      return fmt::format(
          "{} acts on elements, and the {} is of springs; give it interior = \"elements\", or name absorbing instead",
          E::name, body_name(static_cast<std::size_t>(b)));
    if constexpr (EdgeDamping<E>)
      if (solid.elements() && e.dashpots(solid).empty())
        return fmt::format(
            "{}: the {} has no free edge that faces away from the projectile; hold no node of its sides and of what "
            "lies below, or leave it out",
            E::name, body_name(static_cast<std::size_t>(b)));
    if (ElementFlow<E> && solid.springs())
      return fmt::format(
          "{} acts on elements, and the {} is of springs; give it interior = \"elements\", or name "
          "plastic instead",
          E::name, body_name(static_cast<std::size_t>(b)));
    if (solid.free > 0 && !acts_inside<E>(solid))
      return fmt::format("{} acts on springs, and the {} has none; let it act on another body, or leave it out",
                         E::name, body_name(static_cast<std::size_t>(b)));
    finds_one = finds_one || AnchorMotion<E> || (solid.free > 0 && acts_inside<E>(solid));
  }
  if (finds_one) return "";
  return fmt::format("{} acts on {}, and the {} is rigid: leave it out", E::name,
                     SpringChange<E>                    ? "springs"
                     : ElementFlow<E> || EdgeDamping<E> ? "elements"
                                                        : "what moves inside a body",
                     body_name(solids.size() - 1));
}

// Why springs that remember cannot start as prestress has stretched them.
template <class E>
std::string conflict_with_prestress(const E& e, std::span<const Solid* const> solids) {
  for (const int b : bodies_of(Effect(e), static_cast<int>(solids.size()))) {
    const Solid& solid = *solids[static_cast<std::size_t>(b)];
    const Springs* springs = solid.springs();
    if (!springs || springs->rest_energy == 0) continue;
    std::string conflict;
    each_spring(*springs, solid.free, [&](int, int, const Spring& spring) {
      const Vec2 d =
          solid.points[static_cast<std::size_t>(spring.other)] - solid.points[static_cast<std::size_t>(spring.node)];
      const double strain = d.norm() / spring.length - 1;
      if (conflict.empty() && e.exceeded(strain))
        conflict = fmt::format(
            "{}: prestress strains a spring of the {} by {:.3g} at rest, beyond its limit; lower prestress or raise "
            "the limit",
            E::name, body_name(static_cast<std::size_t>(b)), strain);
    });
    if (!conflict.empty()) return conflict;
  }
  return "";
}

}  // namespace

std::string text_of(std::span<const Effect> effects) {
  std::string text;
  for (const Effect& effect : effects) std::visit([&](const auto& e) { text += line_of(e); }, effect);
  return text;
}

std::string batch_text_of(std::span<const Effect> effects) {
  std::string text;
  for (const Effect& effect : effects)
    std::visit([&]<class E>(const E& e) { text += OwnNumbers<E> ? std::string(E::name) + "\n" : line_of(e); }, effect);
  return text;
}

std::vector<int> bodies_of(const Effect& effect, int count) {
  const std::string on = std::visit(
      []<class E>(const E& e) -> std::string {
        if constexpr (requires { e.on; })
          return e.on;
        else
          return "target";
      },
      effect);
  std::vector<int> bodies;
  if (on != "target") bodies.push_back(0);
  for (int b = 1; b < count && on != "projectile"; ++b) bodies.push_back(b);
  return bodies;
}

ContactLaws contact_laws(std::span<const Effect> effects) {
  ContactLaws laws;
  for (const Effect& effect : effects)
    std::visit(
        [&]<class E>(const E& e) {
          if constexpr (PairForceEffect<E>) laws.forces.push_back(e);
          if constexpr (PairMemory<E>) laws.grip = e;
        },
        effect);
  return laws;
}

Vec3 fall_of(std::span<const Effect> effects, int body, int count) {
  Vec3 fall = Vec3::Zero();
  for (const Effect& effect : effects)
    std::visit(
        [&]<class E>(const E& e) {
          if constexpr (requires { e.fall(); }) {
            const std::vector<int> on = bodies_of(effect, count);
            if (std::find(on.begin(), on.end(), body) != on.end()) fall += e.fall();
          }
        },
        effect);
  return fall;
}

const Yielding* flowing(std::span<const Effect> effects, int body, int count) {
  for (const Effect& effect : effects)
    if (const auto* yielding = std::get_if<Yielding>(&effect)) {
      const std::vector<int> on = bodies_of(effect, count);
      if (std::find(on.begin(), on.end(), body) != on.end()) return yielding;
    }
  return nullptr;
}

Vec2 displacement_at_start(std::span<const Effect> effects) {
  Vec2 displacement = Vec2::Zero();
  for (const Effect& effect : effects)
    std::visit(
        [&]<class E>(const E& e) {
          if constexpr (AnchorMotion<E>) displacement += e.displacement(0);
        },
        effect);
  return displacement;
}

std::string conflict_with(std::span<const Effect> effects, std::span<const Solid* const> solids,
                          const ExponentialRepulsion& contact) {
  for (const Effect& effect : effects) {
    const std::string conflict = std::visit(
        [&]<class E>(const E& e) -> std::string {
          if (std::string of_bodies = conflict_with_bodies(e, solids); !of_bodies.empty()) return of_bodies;
          if constexpr (SpringChange<E>) return conflict_with_prestress(e, solids);
          if constexpr (requires { e.conflict_with(contact); })
            if (const std::string beside = e.conflict_with(contact); !beside.empty())
              return std::string(E::name) + ": " + beside;
          return "";
        },
        effect);
    if (!conflict.empty()) return conflict;
  }
  return "";
}

std::string conflict_of(std::span<const Effect> effects) {
  const auto remembers = [](const Effect& effect) {
    return std::visit([]<class E>(const E&) { return SpringChange<E>; }, effect);
  };
  if (find_effect<Absorbing>(effects) && find_effect<MovingAnchor>(effects))
    return "absorbing damps against a wall at rest, and moving_anchor moves it; name one of them";
  if (find_effect<AbsorbingEdges>(effects) && find_effect<MovingAnchor>(effects))
    return "absorbing_edges damps against a wall at rest, and moving_anchor moves it; name one of them";
  for (std::size_t i = 0; i < effects.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::string a = named_bodies(effects[i]), b = named_bodies(effects[j]);
      if (a != b && a != "both" && b != "both") continue;
      if (effects[i].index() == effects[j].index())
        return fmt::format("{} is named twice for the same body; name it once, or once for each body",
                           name_of(effects[i]));
      if (remembers(effects[i]) && remembers(effects[j]))
        return fmt::format("{} and {} are both laws of a body's springs; name one of them for a body",
                           name_of(effects[j]), name_of(effects[i]));
    }
  return "";
}

}  // namespace ricochet
