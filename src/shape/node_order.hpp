#pragma once
#include <utility>
#include <vector>

namespace ricochet {

/// Reverse Cuthill-McKee order of a graph of `nodes` nodes: order[k] is the old number of the node that becomes number
/// k. Joined nodes come near each other, which keeps a sweep over springs inside the cache. Depends on nothing but its
/// arguments. [Cuthill & McKee 1969; A. George 1971]
std::vector<int> reverse_cuthill_mckee(int nodes, const std::vector<std::pair<int, int>>& edges);

}  // namespace ricochet
