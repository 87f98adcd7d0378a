#include "body/springs/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/springs/tangent.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/streams.hpp"

namespace ricochet {
namespace {

// The stiffness of a place is that at the middle of its ends' values, relative to the body's number.
double stiffness_of(const Body& body, int a, int b) {
  if (body.node_stiffness.empty()) return 1;
  return (body.node_stiffness[at(a)] + body.node_stiffness[at(b)]) / 2 / body.numbers.stiffness;
}

Springs join(const Body& body, const NodePlan& plan, const std::vector<std::pair<int, int>>& edges,
             const std::vector<int>& number, const Solid& solid) {
  std::vector<Spring> all;
  std::vector<int> next(plan.points.size(), -1);  // along the rim
  for (const auto& [from, to] : plan.rim_cells) next[at(from)] = to;
  for (const auto& [a, b] : edges) {
    const auto [low, high] = std::minmax(number[at(a)], number[at(b)]);
    if (low >= solid.free) continue;
    const Vec2 d = solid.points[at(high)] - solid.points[at(low)];
    const bool on_rim = next[at(a)] == b || next[at(b)] == a;
    all.push_back({low, high, on_rim, std::sqrt(d.x() * d.x() + d.y() * d.y()), stiffness_of(body, a, b)});
  }
  std::sort(all.begin(), all.end(),
            [](const Spring& a, const Spring& b) { return std::pair(a.node, a.other) < std::pair(b.node, b.other); });
  Springs springs;
  springs.law = static_cast<const SpringLawNumbers&>(body.numbers);
  springs.uniform = body.node_stiffness.empty();
  springs.first.assign(plan.points.size() + 1, 0);
  for (const Spring& spring : all) {
    springs.list.push_back(spring);
    ++springs.first[at(spring.node) + 1];
  }
  for (std::size_t i = 0; i + 1 < springs.first.size(); ++i) springs.first[i + 1] += springs.first[i];
  return springs;
}

void prestress(const Body& body, Solid& solid, Springs& springs) {
  const BodyNumbers& numbers = body.numbers;
  Random random(static_cast<std::uint64_t>(numbers.seed), streams::prestress);
  for (std::size_t s = 0; s < springs.list.size(); ++s)
    springs.list.set_length(s, springs.list[s].length * std::max(0.1, 1 + numbers.prestress * random.normal()));
  try {
    relax(solid, springs);
  } catch (const Error& error) {
    throw FieldError(
        "prestress",
        fmt::format("{} is too much for this lattice ({} nodes, seed {}): {}; lower it or take another seed",
                    numbers.prestress, numbers.nodes, numbers.seed, error.what()));
  }
  with_spring_law(springs.law, [&](const auto& law) {
    each_spring(springs, solid.free, [&](int i, int, const Spring& spring) {
      const double x = (solid.points[at(spring.other)] - solid.points[at(i)]).norm() - spring.length;
      springs.rest_energy += spring.stiffness * law.energy(x);
    });
  });
}

}  // namespace

Springs build_springs(const Body& body, const NodePlan& plan, JoinedNodes& joined) {
  Solid& solid = *joined.solid;
  Springs springs = join(body, plan, joined.edges, joined.number, solid);
  if (body.numbers.prestress > 0) prestress(body, solid, springs);
  return springs;
}

}  // namespace ricochet
