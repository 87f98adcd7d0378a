#include "force/catalogue.hpp"

#include <fmt/format.h>

namespace ricochet {

std::string text_of(std::span<const Effect> effects) {
  std::string text;
  for (const Effect& effect : effects)
    std::visit(
        [&]<class E>(const E& e) {
          text += E::name;
          for (const auto& member : E::fields()) std::visit([&](auto place) { text += fmt::format(" {} = {}", member.field.name, e.*place); }, member.place);
          text += "\n";
        },
        effect);
  return text;
}

}  // namespace ricochet
