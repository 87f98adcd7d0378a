#pragma once
// How the threads of a team share the sweep over one large body. Its springs or elements ("members") are a list by
// node, each held by its lowest: a share is a stretch of nodes, whose forces it sums by rising number of the member,
// as a sweep of one thread does, and which it alone moves. So the bits are those of one thread.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/team.hpp"

namespace ricochet {

struct Share {
  int begin, end;  ///< the free nodes that it moves
  int limit;       ///< it sums the forces of nodes begin ... limit - 1: the last share those of held nodes too
  int crossing;    ///< members of nodes begin ... crossing - 1 reach no node from `limit` on
  std::vector<int> from_before;  ///< members of earlier nodes that reach into it, by rising number
};

/// A body's sweep, shared.
struct Sharing {
  Team* team;
  std::vector<Share> shares;  ///< [part of the team]
};

/// Bodies of fewer members are swept sooner than a team has met.
inline constexpr std::size_t least_shared = 50'000;

/// Stretches with about as many members each. `first`: [node + 1] first member of a node; `nodes`: [member] its nodes
/// by rising number.
template <std::size_t N>
std::vector<Share> shares_of(const std::vector<int>& first, int free, int all, int parts,
                             const std::array<int, N>* nodes) {
  const auto row = [&](int node) { return first[static_cast<std::size_t>(node)]; };
  std::vector<Share> shares;
  for (int part = 0; part < parts; ++part) {
    Share share{shares.empty() ? 0 : shares.back().end, free, all, 0, {}};
    if (part + 1 < parts) {
      const auto wanted = static_cast<int>(static_cast<std::int64_t>(row(free)) * (part + 1) / parts);
      const auto cut = std::lower_bound(first.begin() + share.begin, first.begin() + free, wanted);
      share.end = share.limit = static_cast<int>(cut - first.begin());
    }
    int m = row(share.begin);
    while (m < row(share.end) && nodes[m].back() < share.limit) ++m;
    const auto after = std::upper_bound(first.begin() + share.begin, first.begin() + share.end, m);
    share.crossing = m == row(share.end) ? share.end : static_cast<int>(after - first.begin()) - 1;
    const auto is_reached = [&](int node) { return node >= share.begin && node < share.limit; };
    for (int k = 0; k < row(share.begin); ++k)
      if (std::any_of(nodes[k].begin() + 1, nodes[k].end(), is_reached)) share.from_before.push_back(k);
    shares.push_back(std::move(share));
  }
  return shares;
}

}  // namespace ricochet
