#include "core/spelling.hpp"

#include <algorithm>

namespace ricochet {
namespace {

// No name is longer; a longer word is none misspelt, and comparing takes as long as both lengths' product.
constexpr std::size_t longest = 100;

// Optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours each cost 1.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

}  // namespace

std::vector<std::string> nearest_names(std::string_view word, std::span<const std::string> names) {
  if (word.size() > longest) return {};
  const std::string typed = lower(word);
  std::vector<std::string> best;
  std::size_t best_distance = std::max<std::size_t>(1, typed.size() / 3);
  for (const std::string& name : names) {
    if (name.size() > longest) continue;
    const std::size_t distance = edit_distance(typed, lower(name));
    // An abbreviation (or the singular of a plural) counts as near, however much is missing.
    const bool prefix = typed.size() >= 3 && (lower(name).starts_with(typed) || typed.starts_with(lower(name)));
    const std::size_t cost = prefix ? std::min<std::size_t>(distance, 1) : distance;
    if (cost > best_distance || std::find(best.begin(), best.end(), name) != best.end()) continue;
    if (cost < best_distance) best.clear();
    best.push_back(name);
    best_distance = cost;
  }
  std::sort(best.begin(), best.end());  // tables of Lua have no order
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> names) {
  const std::vector<std::string> near = nearest_names(word, names);
  if (near.empty()) return "";
  std::string text = "'" + near[0] + "'";
  for (std::size_t i = 1; i < std::min<std::size_t>(near.size(), 3); ++i) text += " or '" + near[i] + "'";
  return " (did you mean " + text + "?)";
}

}  // namespace ricochet
