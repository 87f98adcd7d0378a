#pragma once
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace ricochet {

/// How many threads `asked` means; 0: as many as the machine has.
inline std::size_t threads_of(int asked) {
  return asked > 0 ? static_cast<std::size_t>(asked) : std::max(1u, std::thread::hardware_concurrency());
}

/// Calls work(item) for every item, in order as threads become free, on `threads` threads (0: as many as the machine
/// has). The first exception keeps further items from starting and is thrown once all threads have ended.
template <class Item, class Do>
void in_parallel(std::vector<Item>& items, int threads, Do&& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex failing;
  std::exception_ptr failure;
  const auto take_items = [&] {
    for (std::size_t i; (i = next++) < items.size();) try {
        work(items[i]);
      } catch (...) {
        const std::lock_guard lock(failing);
        if (!failure) failure = std::current_exception();
        next = items.size();
      }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t n = std::min(threads_of(threads), items.size()); n > 1; --n) others.emplace_back(take_items);
    take_items();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace ricochet
