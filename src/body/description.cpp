#include "body/description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/hash.hpp"

namespace ricochet {
namespace {

// A member of what BodyNumbers inherits is a member of it.
template <class Value>
Value BodyNumbers::*inherited(Value SpringLawNumbers::*where) {
  return where;
}

// The first number always; what laws came to know later only where it says something, so that older texts stay.
std::string text_of_law(const SpringLawNumbers& law) {
  const SpringLawNumbers usual;
  std::string text;
  for (const auto& member : SpringLawNumbers::fields())
    std::visit(
        [&](auto where) {
          if (text.empty() || law.*where != usual.*where) text += fmt::format(" {} {}", member.field.name, law.*where);
        },
        member.place);
  return text;
}

}  // namespace

const std::vector<Member<BodyNumbers>>& BodyNumbers::fields() {
  static const std::vector<Member<BodyNumbers>> list = [] {
    std::vector<Member<BodyNumbers>> of_body{
        {{"nodes", "integer", "", "number of mass points, those on the outline included", {4, 1e7}, "800"},
         &BodyNumbers::nodes},
        {{"placement",
          "string",
          "",
          "how the interior nodes are placed; uniform, at independent random points, leaves voids, light nodes beside "
          "narrow triangles, and folds early",
          any_number,
          "poisson_disk",
          false,
          {"uniform", "poisson_disk", "triangular"}},
         &BodyNumbers::placement},
        {{"seed", "integer", "", "chooses the random lattice", {0, 9007199254740992.0}, "1"}, &BodyNumbers::seed},
        {{"stiffness", "number", "m0 c^2/R^2", "spring constant ka of T = ka x + kb x^3", positive, "10000"},
         &BodyNumbers::stiffness},
        {{"density", "number", "m0/R^2",
          "mass of the area: a node weighs a third of each triangle at it; default 800/pi, of which 800 nodes in a "
          "disk weigh m0 each on average, unless mass is given",
          positive, "", true},
         &BodyNumbers::density},
        {{"mass", "number", "m0", "mass of every node alike, whatever area is its own; instead of density", positive,
          "", true},
         &BodyNumbers::mass},
        {{"roughness", "number", "R",
          "standard deviation of the rim along its outward normal; anchored rim nodes stay smooth", not_negative, "0"},
         &BodyNumbers::roughness},
        {{"prestress",
          "number",
          "",
          "standard deviation of the springs' rest lengths over their own; the lattice is relaxed to where they "
          "balance",
          {0, 0.3},
          "0"},
         &BodyNumbers::prestress},
        {{"interior",
          "string",
          "",
          "what holds it together; rigid: nothing moves inside, for a target",
          any_number,
          "springs",
          false,
          {"springs", "rigid"}},
         &BodyNumbers::interior},
    };
    const auto after_stiffness =
        std::find_if(of_body.begin(), of_body.end(), [](const auto& member) { return member.field.name == "density"; });
    std::vector<Member<BodyNumbers>> of_law;
    for (const auto& member : SpringLawNumbers::fields())
      std::visit([&](auto where) { of_law.push_back({member.field, inherited(where)}); }, member.place);
    of_body.insert(after_stiffness, of_law.begin(), of_law.end());
    return of_body;
  }();
  return list;
}

std::string body_name(std::size_t body) {
  static const char* names[] = {"projectile", "target"};
  return body < std::size(names) ? names[body] : fmt::format("body {}", body + 1);
}

double BodyNumbers::area_density() const {
  return !std::isnan(mass) ? not_given : std::isnan(density) ? usual_density : density;
}

std::string Body::geometry_text() const {
  if (plane)
    return fmt::format("plane {} {} {} {}", plane->normal.x(), plane->normal.y(), plane->normal.z(), plane->offset);
  std::string outline_text, anchor_text, stiffness_text, density_text;
  for (const Vec2& p : outline) outline_text += fmt::format("{} {};", p.x(), p.y());
  for (const bool held : anchored) anchor_text += held ? '1' : '0';
  if (rigid())
    return fmt::format("rigid outline {} anchored {} nodes {} seed {} roughness {}", hash_text(outline_text),
                       hash_text(anchor_text), numbers.nodes, numbers.seed, numbers.roughness);
  for (const double k : node_stiffness) stiffness_text += fmt::format("{};", k);
  for (const double density : node_density) density_text += fmt::format("{};", density);
  const std::string weight = !std::isnan(numbers.mass) ? fmt::format("mass {}", numbers.mass)
                             : node_density.empty()    ? fmt::format("density {}", numbers.area_density())
                                                       : fmt::format("densities {}", hash_text(density_text));
  return fmt::format("outline {} anchored {} stiffness {} nodes {} placement {} seed {} roughness {}{} {} prestress {}",
                     hash_text(outline_text), hash_text(anchor_text), hash_text(stiffness_text), numbers.nodes,
                     numbers.placement, numbers.seed, numbers.roughness, text_of_law(numbers), weight,
                     numbers.prestress);
}

}  // namespace ricochet
