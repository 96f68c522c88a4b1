// SPDX-License-Identifier: MIT
#include "core/parallel/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace minkray {
namespace {

/// Tells ThreadSanitizer, which does not see into oneTBB's library, that parts begin after the fork
/// and are over at the join. Of parts that run at once it says nothing: races between them are
/// found. In other builds it is nothing.
class ForkAndJoin {
 public:
#if defined(__SANITIZE_THREAD__)
  ForkAndJoin() {
    __tsan_release(&fork_);
  }
  ~ForkAndJoin() {
    __tsan_acquire(&join_);
  }
  ForkAndJoin(const ForkAndJoin&) = delete;
  ForkAndJoin& operator=(const ForkAndJoin&) = delete;

  class Part {
   public:
    explicit Part(ForkAndJoin& of) : of_(of) { __tsan_acquire(&of.fork_); }
    ~Part() { __tsan_release(&of_.join_); }
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

   private:
    ForkAndJoin& of_;
  };

 private:
  char fork_ = 0, join_ = 0;
#else
  struct Part {
    explicit Part(ForkAndJoin&) {}
  };
#endif
};

}  // namespace

void run_both(const std::function<void()>& first, const std::function<void()>& second) {
  ForkAndJoin threads;
  const auto part = [&](const std::function<void()>& work) {
    const ForkAndJoin::Part here(threads);
    work();
  };
  tbb::parallel_invoke([&] { part(first); }, [&] { part(second); });
}

void for_parts(std::size_t count, std::size_t grain,
               const std::function<void(std::size_t, std::size_t)>& body) {
  ForkAndJoin threads;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, grain),
      [&](const tbb::blocked_range<std::size_t>& part) {
        const ForkAndJoin::Part here(threads);
        body(part.begin(), part.end());
      },
      tbb::simple_partitioner());
}

void with_threads(int threads, const std::function<void()>& work) {
  if (threads == 0) return work();
  // Without this, oneTBB starts no more threads than there are cores.
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  ForkAndJoin one_more;  // an arena may hand the work to another thread
  tbb::task_arena(threads).execute([&] {
    const ForkAndJoin::Part here(one_more);
    work();
  });
}

int thread_count() {
  return tbb::this_task_arena::max_concurrency();
}

}  // namespace minkray
