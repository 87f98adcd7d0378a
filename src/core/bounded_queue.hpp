#pragma once
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

namespace ricochet {

/// Hands things from one thread to another, in order, and lets the giver wait while `most` are on their way.
template <class Thing>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t most) : most_(most) {}

  /// False if the queue is closed: the thing is dropped.
  bool push(Thing thing) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return closed_ || things_.size() < most_; });
    if (closed_) return false;
    things_.push_back(std::move(thing));
    changed_.notify_all();
    return true;
  }

  /// The next thing; none if none comes within that time.
  template <class Duration>
  std::optional<Thing> pop(Duration patience) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [&] { return closed_ || !things_.empty(); });
    return taken();
  }

  /// True once the queue is closed and empty.
  bool over() {
    const std::lock_guard lock(mutex_);
    return closed_ && things_.empty();
  }

  /// The next thing; none once the queue is closed and empty.
  std::optional<Thing> pop() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return closed_ || !things_.empty(); });
    return taken();
  }

  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

 private:
  std::optional<Thing> taken() {
    if (things_.empty()) return std::nullopt;
    Thing thing = std::move(things_.front());
    things_.pop_front();
    changed_.notify_all();
    return thing;
  }

  const std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Thing> things_;
  bool closed_ = false;
};

}  // namespace ricochet
