#include "body/kept_solids.hpp"

#include <list>
#include <map>
#include <mutex>
#include <string>

#include "core/hash.hpp"

namespace ricochet {
namespace {

// Numbers, of 8 bytes each, that a node with its springs or elements has about; shapes of modes come beside.
constexpr std::size_t per_node = 25;
constexpr std::size_t most_numbers = 300'000 * per_node;

std::size_t numbers_in(const Solid& solid) {
  std::size_t count = per_node * static_cast<std::size_t>(solid.nodes());
  if (const Modes* modes = solid.modes())
    count += modes->all.shape.size() + modes->rim.shape.size() + numbers_in(*modes->of);
  return count;
}

/// The solids asked for last, the latest first.
class Kept {
 public:
  std::shared_ptr<const Solid> find(const std::string& name) {
    const std::lock_guard lock(mutex_);
    const auto found = place_.find(name);
    if (found == place_.end()) return nullptr;
    latest_.splice(latest_.begin(), latest_, found->second);
    return found->second->solid;
  }

  void keep(const std::string& name, const std::shared_ptr<const Solid>& solid) {
    const std::lock_guard lock(mutex_);
    if (place_.contains(name)) return;  // another thread was faster
    latest_.push_front({name, solid});
    place_[name] = latest_.begin();
    numbers_ += numbers_in(*solid);
    while (numbers_ > most_numbers) {
      numbers_ -= numbers_in(*latest_.back().solid);
      place_.erase(latest_.back().name);
      latest_.pop_back();
    }
  }

 private:
  struct Entry {
    std::string name;
    std::shared_ptr<const Solid> solid;
  };
  std::mutex mutex_;
  std::list<Entry> latest_;
  std::map<std::string, std::list<Entry>::iterator> place_;
  std::size_t numbers_ = 0;
};

}  // namespace

std::shared_ptr<const Solid> kept_solid(const Body& body) {
  static Kept kept;
  const std::string name = hash_text(body.geometry_text());
  if (auto solid = kept.find(name)) return solid;
  auto solid = build_solid(body);
  kept.keep(name, solid);
  return solid;
}

}  // namespace ricochet
