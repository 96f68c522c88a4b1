// SPDX-License-Identifier: MIT
// Implements parallel.h without oneTBB for ThreadSanitizer, which cannot check Debian's library.
// Starts threads for each parallel_for, which would be too slow for other builds.
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "core/parallel/parallel.h"
#include "core/parallel/parallel_pipeline.h"

namespace minkray {
namespace {

/// Several threads on any machine, so that races are found.
constexpr int fewest_threads = 4;

/// The threads of one call of with_threads.
struct Team {
  explicit Team(int threads) : count(threads), idle(threads - 1) {}

  const int count;
  std::atomic<int> idle;

  bool take_one() {
    int left = idle.load(std::memory_order_relaxed);
    while (left > 0 && !idle.compare_exchange_weak(left, left - 1, std::memory_order_relaxed)) {
    }
    return left > 0;
  }
};

/// The team of this thread; none outside with_threads and parallel_for.
thread_local Team* team_here = nullptr;

class InTeam {
 public:
  explicit InTeam(Team& team) : before_(team_here) { team_here = &team; }
  ~InTeam() { team_here = before_; }
  InTeam(const InTeam&) = delete;
  InTeam& operator=(const InTeam&) = delete;

 private:
  Team* before_;
};

/// Keeps the first of several threads' exceptions.
class FirstException {
 public:
  /// Must be called in a catch block.
  void take() {
    failed_.store(true, std::memory_order_relaxed);
    const std::lock_guard lock(mutex_);
    if (!exception_) exception_ = std::current_exception();
  }
  bool failed() const { return failed_.load(std::memory_order_relaxed); }
  /// Must be called after all threads were joined.
  void pass_on() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::exception_ptr exception_;
};

/// Calls work() in this thread and, at the same time, in up to `helpers` idle threads of the team.
void on_team(Team& team, std::size_t helpers, const std::function<void()>& work) {
  std::vector<std::thread> threads;
  while (threads.size() < helpers && team.take_one())
    threads.emplace_back([&] {
      const InTeam here(team);
      work();
    });
  work();
  for (std::thread& thread : threads) thread.join();
  team.idle.fetch_add(static_cast<int>(threads.size()), std::memory_order_relaxed);
}

int one_per_core() {
  return std::max(fewest_threads, static_cast<int>(std::thread::hardware_concurrency()));
}

/// The index ranges of one parallel_for, taken by any free thread. All atomic operations are
/// relaxed: ThreadSanitizer must not assume an order of ranges that oneTBB does not guarantee.
class Ranges {
 public:
  Ranges(std::size_t count, std::size_t grain,
         const std::function<void(std::size_t, std::size_t)>& body)
      : count_(count), grain_(grain), body_(body) {}

  void take_all() {
    try {
      for (;;) {
        const std::size_t begin = next_.fetch_add(grain_, std::memory_order_relaxed);
        if (begin >= count_ || exception_.failed()) return;
        body_(begin, std::min(begin + grain_, count_));
      }
    } catch (...) {
      exception_.take();
    }
  }
  void pass_exception_on() const { exception_.pass_on(); }

 private:
  const std::size_t count_, grain_;
  const std::function<void(std::size_t, std::size_t)>& body_;
  std::atomic<std::size_t> next_ = 0;
  FirstException exception_;
};

}  // namespace

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  if (!team_here) return with_threads(one_per_core(), [&] { parallel_for(count, grain, body); });
  Ranges ranges(count, grain, body);
  const std::size_t range_count = (count + grain - 1) / grain;
  if (range_count > 0) on_team(*team_here, range_count - 1, [&] { ranges.take_all(); });
  ranges.pass_exception_on();
}

void with_threads(int threads, const std::function<void()>& work) {
  if (threads == 0) return work();
  Team team(threads);
  const InTeam here(team);
  work();
}

int thread_count() {
  return team_here ? team_here->count : one_per_core();
}

void pipeline_of_any(std::size_t most, const std::function<std::shared_ptr<void>()>& read,
                     const std::function<void(void*)>& work,
                     const std::function<void(void*)>& write) {
  if (!team_here)
    return with_threads(one_per_core(), [&] { pipeline_of_any(most, read, work, write); });
  std::mutex reading, writing;
  std::condition_variable written;
  bool at_end = false;  // guarded by `reading`, as is read_count
  std::size_t read_count = 0;
  std::size_t written_count = 0;  // guarded by `writing`
  FirstException exception;
  on_team(*team_here, most - 1, [&] {
    while (!exception.failed()) {
      try {
        std::shared_ptr<void> item;
        std::size_t number = 0;
        {
          const std::lock_guard lock(reading);
          if (!at_end) item = read();
          at_end = !item;
          if (at_end) return;
          number = read_count++;
        }
        work(item.get());
        std::unique_lock lock(writing);
        written.wait(lock, [&] { return written_count == number || exception.failed(); });
        if (exception.failed()) return;
        write(item.get());
        ++written_count;
      } catch (...) {
        const std::lock_guard lock(writing);  // so that no waiting thread misses the change
        exception.take();
      }
      written.notify_all();
    }
  });
  exception.pass_on();
}

}  // namespace minkray
