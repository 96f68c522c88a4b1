// SPDX-License-Identifier: MIT
#include "core/parallel/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace minkray {

void for_parts(std::size_t count, std::size_t grain,
               const std::function<void(std::size_t, std::size_t)>& body) {
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, grain),
      [&](const tbb::blocked_range<std::size_t>& part) { body(part.begin(), part.end()); },
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

}  // namespace minkray
