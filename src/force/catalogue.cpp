#include "force/catalogue.hpp"

#include <fmt/format.h>

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
std::string bodies_of(const Effect& effect) {
  return std::visit(
      []<class E>(const E& e) -> std::string {
        if constexpr (requires { e.on; })
          return e.on;
        else
          return "both";
      },
      effect);
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

std::string conflict_of(std::span<const Effect> effects) {
  const auto name = [](const Effect& effect) {
    return std::string(std::visit([]<class E>(const E&) { return E::name; }, effect));
  };
  const auto remembers = [](const Effect& effect) {
    return std::visit([]<class E>(const E&) { return SpringChange<E>; }, effect);
  };
  if (find_effect<Absorbing>(effects) && find_effect<MovingAnchor>(effects))
    return "absorbing damps against a wall at rest, and moving_anchor moves it; name one of them";
  for (std::size_t i = 0; i < effects.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::string a = bodies_of(effects[i]), b = bodies_of(effects[j]);
      if (a != b && a != "both" && b != "both") continue;
      if (effects[i].index() == effects[j].index())
        return fmt::format("{} is named twice for the same body; name it once, or once for each body",
                           name(effects[i]));
      if (remembers(effects[i]) && remembers(effects[j]))
        return fmt::format("{} and {} are both laws of a body's springs; name one of them for a body", name(effects[j]),
                           name(effects[i]));
    }
  return "";
}

}  // namespace ricochet
