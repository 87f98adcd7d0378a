#pragma once
#include <barrier>
#include <functional>
#include <thread>
#include <vector>

namespace ricochet {

/// Threads that do one thing together, over and over: the caller's and others, which wait in between.
class Team {
 public:
  /// Of `size` threads, the caller's among them.
  explicit Team(int size) : size_(size), all_(size) {
    try {
      for (int part = 1; part < size; ++part) others_.emplace_back([this, part] { wait_for_work(part); });
    } catch (...) {  // no thread was left: those that are there end
      for (int part = static_cast<int>(others_.size()) + 1; part < size; ++part) all_.arrive_and_drop();
      meet();
      throw;
    }
  }
  ~Team() {
    if (others_.empty()) return;
    work_ = nullptr;
    meet();
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int size() const { return size_; }

  /// Calls work(part) for every part 0 ... size - 1, each on a thread of its own, and returns when all have ended.
  /// `work` must not throw.
  void run(const std::function<void(int)>& work) {
    work_ = &work;
    meet();
    work(0);
    meet();
  }

  /// Within that work: waits until every part has come as far.
  void meet() { all_.arrive_and_wait(); }

 private:
  void wait_for_work(int part) {
    for (;;) {
      meet();
      if (!work_) return;
      (*work_)(part);
      meet();
    }
  }

  int size_;
  std::barrier<> all_;
  const std::function<void(int)>* work_ = nullptr;  // nullptr where they meet: no more
  std::vector<std::jthread> others_;
};

}  // namespace ricochet
