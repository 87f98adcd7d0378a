#include "impact/spread.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace ricochet {
namespace {

/// One quantity over a list of scenes.
struct Quantity {
  std::vector<std::size_t> rank;     ///< [scene] of its value among all values, from 0
  std::size_t last;                  ///< rank
  std::vector<std::size_t> taken{};  ///< ranks of the scenes taken

  // How much taking a scene adds: the distance of its value from those taken; 0 and less for one that is among them.
  double gain(std::size_t scene) const {
    constexpr double repeated = 1e-3;
    double nearest = 1, gain = 0;
    for (const std::size_t r : taken) {
      nearest = std::min(
          nearest, std::abs(static_cast<double>(r) - static_cast<double>(rank[scene])) / static_cast<double>(last));
      gain -= r == rank[scene] ? repeated : 0;
    }
    return gain + nearest;
  }
};

Quantity quantity(std::vector<std::size_t> ranks) {
  const std::size_t last = *std::max_element(ranks.begin(), ranks.end());
  return {std::move(ranks), last};
}

template <class Value>
Quantity ranked(const std::vector<Value>& values) {
  std::map<Value, std::size_t> ranks;
  for (const Value& value : values) ranks[value] = 0;
  std::size_t next = 0;
  for (auto& [value, rank] : ranks) rank = next++;
  std::vector<std::size_t> list;
  for (const Value& value : values) list.push_back(ranks[value]);
  return quantity(std::move(list));
}

// By where its text first occurs.
Quantity in_order(const std::vector<std::string>& texts) {
  std::map<std::string, std::size_t> ranks;
  std::vector<std::size_t> list;
  for (const std::string& text : texts) list.push_back(ranks.emplace(text, ranks.size()).first->second);
  return quantity(std::move(list));
}

std::vector<Quantity> quantities_of(const std::vector<const Scene*>& scenes) {
  std::vector<Quantity> all;
  const auto add = [&](Quantity quantity) {
    if (quantity.last > 0) all.push_back(std::move(quantity));
  };
  for (const auto& [field, place] : Launch::fields()) {
    std::vector<double> values;
    for (const Scene* scene : scenes) {
      const double value = scene->launch.*std::get<double Launch::*>(place);
      values.push_back(std::isnan(value) ? std::numeric_limits<double>::lowest() : value);
    }
    add(ranked(values));
  }
  std::vector<std::string> projectiles, targets, effects;
  for (const Scene* scene : scenes) {
    projectiles.push_back(scene->projectile->geometry_text());
    targets.push_back(scene->target->geometry_text());
    effects.push_back(text_of(scene->effects));
  }
  for (const auto& texts : {projectiles, targets, effects}) add(in_order(texts));
  return all;
}

}  // namespace

std::vector<std::size_t> spread_over(const std::vector<const Scene*>& scenes, std::size_t most) {
  std::vector<Quantity> quantities = quantities_of(scenes);
  std::vector<bool> is_taken(scenes.size(), false);
  std::vector<std::size_t> places;
  while (places.size() < std::min(most, scenes.size())) {
    std::size_t best = scenes.size();
    double best_gain = 0;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      if (is_taken[i]) continue;
      double gain = 0;
      for (const Quantity& quantity : quantities) gain += quantity.gain(i);
      if (best < scenes.size() && gain <= best_gain) continue;
      best = i;
      best_gain = gain;
    }
    is_taken[best] = true;
    places.push_back(best);
    for (Quantity& quantity : quantities) quantity.taken.push_back(quantity.rank[best]);
  }
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace ricochet
