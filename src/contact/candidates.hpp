#pragma once
#include <vector>

#include "shape/placed_surface.hpp"

namespace ricochet {

/// A node of one surface and a cell of the other, by their places in their surfaces.
struct Candidate {
  int node, cell;
};

/// Every node at most `distance` from a cell of a surface, with that cell, by rising node, then cell.
inline std::vector<Candidate> candidates_within(const Points& nodes, const PlacedSurface& surface, double distance) {
  std::vector<Candidate> candidates;
  std::vector<int> cells;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    cells.clear();
    surface.within(nodes[i], distance, cells);
    for (const int cell : cells) candidates.push_back({static_cast<int>(i), cell});
  }
  return candidates;
}

}  // namespace ricochet
