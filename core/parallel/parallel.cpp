// SPDX-License-Identifier: MIT
#include "core/parallel/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/parallel/parallel_pipeline.h"

namespace minkray {
namespace {

/// Arenas that no thread uses, kept for reuse. oneTBB (2021.8) does not free the 8 KiB of an arena
/// that had workers, so a program that casts a batch of rays a million times would lose 8 GB. For
/// the same reason, no work runs in the implicit arena of a thread, which is lost when the thread
/// ends.
class Arenas {
 public:
  /// Calls `work` in an arena that no other thread has called into.
  void execute(int threads, const std::function<void()>& work) {
    Arena arena = take(threads);
    struct Guard {
      ~Guard() { arenas.put(threads, std::move(arena)); }
      Arenas& arenas;
      int threads;
      Arena& arena;
    } guard{*this, threads, arena};
    arena->execute(work);
  }

 private:
  using Arena = std::unique_ptr<tbb::task_arena>;

  Arena take(int threads) {
    const std::lock_guard lock(mutex_);
    std::vector<Arena>& idle = idle_[threads];
    if (idle.empty())
      return std::make_unique<tbb::task_arena>(threads == 0 ? int{tbb::task_arena::automatic}
                                                            : threads);
    Arena arena = std::move(idle.back());
    idle.pop_back();
    return arena;
  }
  void put(int threads, Arena arena) {
    const std::lock_guard lock(mutex_);
    idle_[threads].push_back(std::move(arena));
  }

  std::mutex mutex_;
  std::map<int, std::vector<Arena>> idle_;  ///< by number of threads; 0: one per core
};

/// Never destroyed, since threads may still work when the program ends.
Arenas& arenas() {
  static auto& kept = *new Arenas;
  return kept;
}

/// True if this thread called into one of the arenas. False for workers, which are in an arena,
/// too.
thread_local bool has_called = false;

void in_arena(int threads, const std::function<void()>& work) {
  arenas().execute(threads, [&] {
    struct Guard {
      ~Guard() { has_called = before; }
      bool before;
    } guard{std::exchange(has_called, true)};
    work();
  });
}

/// Calls `work` in the arena of this thread. If the thread has no arena, calls it in an idle one.
void in_some_arena(const std::function<void()>& work) {
  const bool is_worker = tbb::this_task_arena::current_thread_index() > 0;
  if (has_called || is_worker) return work();
  in_arena(0, work);
}

}  // namespace

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  in_some_arena([&] {
    // An exception elsewhere in a pipeline must not cancel this loop, which would return as if all
    // of its work were done.
    tbb::task_group_context context(tbb::task_group_context::isolated);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, grain),
        [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); },
        tbb::simple_partitioner(), context);
  });
}

void with_threads(int threads, const std::function<void()>& work) {
  if (threads == 0) return in_some_arena(work);
  // Without this, oneTBB starts no more threads than there are cores.
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  in_arena(threads, work);
}

int thread_count() {
  return tbb::this_task_arena::max_concurrency();
}

void pipeline_of_any(std::size_t most, const std::function<std::shared_ptr<void>()>& read,
                     const std::function<void(void*)>& work,
                     const std::function<void(void*)>& write) {
  using Item = std::shared_ptr<void>;
  in_some_arena([&] {
    tbb::parallel_pipeline(
        most,
        tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order,
                                     [&](tbb::flow_control& flow) {
                                       Item item = read();
                                       if (!item) flow.stop();
                                       return item;
                                     }) &
            tbb::make_filter<Item, Item>(tbb::filter_mode::parallel,
                                         [&](Item item) {
                                           // Otherwise a thread that waits in `work` might read
                                           // another item, and wait for that.
                                           tbb::this_task_arena::isolate([&] { work(item.get()); });
                                           return item;
                                         }) &
            tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order,
                                         [&](const Item& item) { write(item.get()); }));
  });
}

}  // namespace minkray
