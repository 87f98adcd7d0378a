#include "effect/element/absorbing_edges.hpp"

#include <cmath>

namespace ricochet {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// What surrounds a node: its density, its modulus over the body's, means over its share of each element, and Lame's
// constants over that modulus.
struct Surroundings {
  std::vector<double> density, modulus;  // [node]
  std::vector<Lame> lame;                // [node]
};

// Means of the elements around, each by its modulus; where all have the same they are those, to the last bit.
std::vector<Lame> constants_around(const Solid& solid, const Elements& elements) {
  std::vector<Lame> means(at(solid.nodes()), elements.law.lame);
  if (elements.lame.empty()) return means;
  std::vector<double> weights(at(solid.nodes()), 0.0);
  for (std::size_t e = 0; e < elements.nodes.size(); ++e)
    for (const int i : elements.nodes[e]) {
      Lame& mean = means[at(i)];
      if (weights[at(i)] == 0) mean = elements.lame[e];
      const double share = elements.weight[e] / (weights[at(i)] += elements.weight[e]);
      mean.lambda += share * (elements.lame[e].lambda - mean.lambda);
      mean.mu += share * (elements.lame[e].mu - mean.mu);
    }
  return means;
}

Surroundings surroundings_of(const Solid& solid, const Elements& elements) {
  Surroundings around{std::vector<double>(at(solid.nodes()), 0.0), std::vector<double>(at(solid.nodes()), 0.0),
                      constants_around(solid, elements)};
  std::vector<double> volume(at(solid.nodes()), 0.0), strained(at(solid.nodes()), 0.0);
  for (const Triangle& t : solid.cells)
    for (std::size_t k = 0; k < t.size(); ++k)
      volume[at(t[k])] +=
          corner_share({solid.points[at(t[0])], solid.points[at(t[1])], solid.points[at(t[2])]}, k, solid.axisymmetric);
  for (std::size_t e = 0; e < elements.nodes.size(); ++e) {
    const double measure = measure_at_rest(solid, elements.nodes[e]);
    for (const int i : elements.nodes[e]) {
      strained[at(i)] += measure;
      around.modulus[at(i)] += elements.weight[e];
    }
  }
  for (int i = 0; i < solid.free; ++i) {
    around.density[at(i)] = solid.mass[i] / volume[at(i)];
    around.modulus[at(i)] /= strained[at(i)];
  }
  return around;
}

}  // namespace

std::vector<EdgeDashpot> AbsorbingEdges::dashpots(const Solid& solid) const {
  const Elements* elements = solid.elements();
  if (!elements) return {};
  constexpr double facing = 0.5;  // the height of a unit normal from which on an edge faces the projectile
  const auto& mesh = std::get<Mesh<2>>(solid.surface);
  const Surroundings around = surroundings_of(solid, *elements);
  std::vector<EdgeDashpot> of_nodes(at(solid.nodes()), EdgeDashpot{0, 0, 0, 0});
  for (const std::array<int, 2>& cell : mesh.cell) {
    Mesh<2> alone{{mesh.node[at(cell[0])], mesh.node[at(cell[1])]}, {{0, 1}}, {}};
    const Points ends{solid.points[at(alone.node[0])], solid.points[at(alone.node[1])]};
    const Vec2 along = (ends[1] - ends[0]).normalized(), normal(along.y(), -along.x());
    if (normal.y() >= facing) continue;
    const std::vector<double> share = solid.axisymmetric ? ring_shares(alone, ends) : rim_shares(alone, ends);
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t i = at(alone.node[k]);
      const auto [lambda, mu] = around.lame[i];
      const double root = impedance * share[k] * std::sqrt(around.density[i] * around.modulus[i]);
      const double across = root * std::sqrt(lambda + 2 * mu), sideways = root * std::sqrt(mu);
      of_nodes[i].xx += across * normal.x() * normal.x() + sideways * along.x() * along.x();
      of_nodes[i].xy += across * normal.x() * normal.y() + sideways * along.x() * along.y();
      of_nodes[i].yy += across * normal.y() * normal.y() + sideways * along.y() * along.y();
    }
  }
  std::vector<EdgeDashpot> list;
  for (int i = 0; i < solid.free; ++i) {
    EdgeDashpot dashpot = of_nodes[at(i)];
    if (dashpot.xx == 0 && dashpot.yy == 0) continue;
    dashpot.node = i;
    if (solid.axisymmetric && solid.points[at(i)].x() == 0) dashpot.xx = dashpot.xy = 0;  // it cannot leave the axis
    list.push_back(dashpot);
  }
  return list;
}

}  // namespace ricochet
