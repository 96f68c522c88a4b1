// SPDX-License-Identifier: MIT
// parallel.h without oneTBB, for ThreadSanitizer, which does not see what Debian's library does:
// here it sees all of it. Threads are started for each for_parts, which costs too much for other
// builds.
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "core/parallel/parallel.h"

namespace minkray {
namespace {

/// More than one on any machine: races are looked for.
constexpr int fewest_threads = 4;

/// The threads that work on one with_threads.
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

/// The team of this thread; none outside with_threads and for_parts.
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

int one_per_core() {
  return std::max(fewest_threads, static_cast<int>(std::thread::hardware_concurrency()));
}

/// The parts of one for_parts, taken by whoever is free. Every atomic is relaxed: parts of
/// different threads must not look ordered, for oneTBB does not promise that.
class Parts {
 public:
  Parts(std::size_t count, std::size_t grain,
        const std::function<void(std::size_t, std::size_t)>& body)
      : count_(count), grain_(grain), body_(body) {}

  void take_all(Team& team) {
    const InTeam here(team);
    try {
      for (;;) {
        const std::size_t begin = next_.fetch_add(grain_, std::memory_order_relaxed);
        if (begin >= count_ || failed_.load(std::memory_order_relaxed)) return;
        body_(begin, std::min(begin + grain_, count_));
      }
    } catch (...) {
      failed_.store(true, std::memory_order_relaxed);
      const std::lock_guard lock(mutex_);
      if (!exception_) exception_ = std::current_exception();
    }
  }

  /// After all threads were joined.
  void pass_exception_on() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  const std::size_t count_, grain_;
  const std::function<void(std::size_t, std::size_t)>& body_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::exception_ptr exception_;
};

}  // namespace

void for_parts(std::size_t count, std::size_t grain,
               const std::function<void(std::size_t, std::size_t)>& body) {
  if (!team_here) return with_threads(one_per_core(), [&] { for_parts(count, grain, body); });
  Team& team = *team_here;
  Parts parts(count, grain, body);
  std::vector<std::thread> helpers;
  const std::size_t part_count = (count + grain - 1) / grain;
  while (helpers.size() + 1 < part_count && team.take_one())
    helpers.emplace_back([&] { parts.take_all(team); });
  parts.take_all(team);
  for (std::thread& helper : helpers) helper.join();
  team.idle.fetch_add(static_cast<int>(helpers.size()), std::memory_order_relaxed);
  parts.pass_exception_on();
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

}  // namespace minkray
