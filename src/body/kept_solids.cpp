#include "body/kept_solids.hpp"

#include <list>
#include <map>
#include <mutex>
#include <string>

#include "core/hash.hpp"

namespace ricochet {
namespace {

constexpr int most_nodes = 300'000;

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
    nodes_ += solid->nodes();
    while (nodes_ > most_nodes) {
      nodes_ -= latest_.back().solid->nodes();
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
  int nodes_ = 0;
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
