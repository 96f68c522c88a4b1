// SPDX-License-Identifier: MIT
#include "core/parallel/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "core/parallel/parallel_pipeline.h"

namespace minkray {

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, grain),
      [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); },
      tbb::simple_partitioner());
}

void with_threads(int threads, const std::function<void()>& work) {
  if (threads == 0) return work();
  // Without this, oneTBB starts no more threads than there are cores.
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena(threads).execute(work);
}

int thread_count() {
  return tbb::this_task_arena::max_concurrency();
}

void pipeline_of_any(std::size_t most, const std::function<std::shared_ptr<void>()>& read,
                     const std::function<void(void*)>& work,
                     const std::function<void(void*)>& write) {
  using Item = std::shared_ptr<void>;
  tbb::parallel_pipeline(
      most,
      tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
        Item item = read();
        if (!item) flow.stop();
        return item;
      }) & tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, [&](Item item) {
        work(item.get());
        return item;
      }) & tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order, [&](const Item& item) {
        write(item.get());
      }));
}

}  // namespace minkray
