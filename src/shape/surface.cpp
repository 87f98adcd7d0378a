#include "shape/surface.hpp"

#include <numbers>

namespace ricochet {

Cells<2> ring(int count, int first) {
  Cells<2> cells;
  for (int k = 0; k < count; ++k) cells.push_back({first + k, first + (k + 1 < count ? k + 1 : 0)});
  return cells;
}

void Rim::add(const Points& chain) {
  const Cells<2> more = ring(static_cast<int>(chain.size()), static_cast<int>(points.size()));
  points.insert(points.end(), chain.begin(), chain.end());
  cells.insert(cells.end(), more.begin(), more.end());
}

std::vector<Chain> chains_of(const Cells<2>& cells) {
  std::vector<Chain> chains;
  int end = -1;
  for (const auto& [from, to] : cells) {
    if (from != end || chains.back().closed) chains.push_back({{from}, false});
    Chain& chain = chains.back();
    if (to == chain.node.front())
      chain.closed = true;
    else
      chain.node.push_back(to);
    end = to;
  }
  return chains;
}

const std::vector<int>& surface_nodes(const Surface& surface) {
  static const std::vector<int> none;
  const auto* mesh = std::get_if<Mesh<2>>(&surface);
  return mesh ? mesh->node : none;
}

std::vector<double> rim_shares(const Mesh<2>& mesh, const Points& places) {
  std::vector<double> shares(mesh.node.size(), 0.0);
  for (const auto& [a, b] : mesh.cell) {
    const double half = (places[static_cast<std::size_t>(a)] - places[static_cast<std::size_t>(b)]).norm() / 2;
    shares[static_cast<std::size_t>(a)] += half;
    shares[static_cast<std::size_t>(b)] += half;
  }
  return shares;
}

std::vector<double> ring_shares(const Mesh<2>& mesh, const Points& places) {
  std::vector<double> shares(mesh.node.size(), 0.0);
  for (const auto& [a, b] : mesh.cell) {
    const Vec2 &p = places[static_cast<std::size_t>(a)], &q = places[static_cast<std::size_t>(b)];
    const double sixth = 2 * std::numbers::pi * (p - q).norm() / 6;
    shares[static_cast<std::size_t>(a)] += sixth * (2 * p.x() + q.x());
    shares[static_cast<std::size_t>(b)] += sixth * (p.x() + 2 * q.x());
  }
  return shares;
}

}  // namespace ricochet
