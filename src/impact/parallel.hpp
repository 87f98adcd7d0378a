#pragma once
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <vector>

namespace ricochet {

/// Calls work(item) for every item, on `threads` threads (0: all cores); the first exception ends it and is thrown.
template <class Item, class Do>
void in_parallel(std::vector<Item>& items, int threads, Do&& work) {
  const int count = threads > 0 ? threads : tbb::this_task_arena::max_concurrency();
  tbb::global_control allow(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
  tbb::task_arena arena(count);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, items.size(), 1), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) work(items[i]);
    }, tbb::simple_partitioner());
  });
}

}  // namespace ricochet
