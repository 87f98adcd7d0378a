#include "shape/node_order.hpp"

#include <algorithm>
#include <numeric>

namespace ricochet {
namespace {

using Graph = std::vector<std::vector<int>>;

// Breadth-first numbering from `start`, neighbours by rising degree; appended to `order`. Returns how many it added.
std::size_t number_from(int start, const Graph& graph, std::vector<bool>& seen, std::vector<int>& order) {
  const std::size_t first = order.size();
  order.push_back(start);
  seen[static_cast<std::size_t>(start)] = true;
  for (std::size_t next = first; next < order.size(); ++next)
    for (const int neighbour : graph[static_cast<std::size_t>(order[next])])
      if (!seen[static_cast<std::size_t>(neighbour)]) {
        seen[static_cast<std::size_t>(neighbour)] = true;
        order.push_back(neighbour);
      }
  return order.size() - first;
}

}  // namespace

std::vector<int> reverse_cuthill_mckee(int nodes, const std::vector<std::pair<int, int>>& edges) {
  Graph graph(static_cast<std::size_t>(nodes));
  for (const auto& [a, b] : edges) {
    graph[static_cast<std::size_t>(a)].push_back(b);
    graph[static_cast<std::size_t>(b)].push_back(a);
  }
  const auto by_degree = [&](int a, int b) {
    return std::pair(graph[static_cast<std::size_t>(a)].size(), a) <
           std::pair(graph[static_cast<std::size_t>(b)].size(), b);
  };
  for (auto& neighbours : graph) std::sort(neighbours.begin(), neighbours.end(), by_degree);

  std::vector<int> starts(static_cast<std::size_t>(nodes)), order;
  std::iota(starts.begin(), starts.end(), 0);
  std::sort(starts.begin(), starts.end(), by_degree);
  std::vector<bool> seen(static_cast<std::size_t>(nodes), false);
  for (const int start : starts) {
    if (seen[static_cast<std::size_t>(start)]) continue;
    // One breadth-first pass finds a node at the far end of the component: a better start than any of low degree.
    std::vector<bool> trial_seen = seen;
    std::vector<int> trial;
    number_from(start, graph, trial_seen, trial);
    number_from(trial.back(), graph, seen, order);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace ricochet
