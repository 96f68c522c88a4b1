// SPDX-License-Identifier: MIT
// Parts of a range on several threads: each once, never on more threads than allowed.
#include "core/parallel/parallel.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/parallel/parallel_pipeline.h"

using namespace minkray;

namespace {

/// Counts the largest number of threads that are here at once.
class Crowd {
 public:
  void come() {
    const int here = ++here_;
    int most = most_;
    while (here > most && !most_.compare_exchange_weak(most, here)) {
    }
  }
  void go() { --here_; }
  int most() const { return most_; }

 private:
  std::atomic<int> here_ = 0, most_ = 0;
};

}  // namespace

TEST(Parallel, every_item_is_in_one_range_of_at_most_the_grain) {
  for (const int threads : {0, 1, 3})
    for (const std::size_t count : {0u, 1u, 7u, 64u, 1000u})
      for (const std::size_t grain : {1u, 7u, 2000u}) {
        std::vector<int> times(count, 0);  // written by ranges without a lock, read after them
        std::atomic<bool> fits = true;
        with_threads(threads, [&] {
          parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
            if (begin >= end || end - begin > grain) fits = false;
            for (std::size_t i = begin; i < end; ++i) ++times[i];
          });
        });
        EXPECT_TRUE(fits);
        EXPECT_EQ(std::count(times.begin(), times.end(), 1), static_cast<std::ptrdiff_t>(count));
      }
}

TEST(Parallel, loops_within_loops_keep_to_the_number_of_threads) {
  for (const int threads : {1, 2, 3}) {
    Crowd crowd;
    std::atomic<int> inner = 0;
    with_threads(threads, [&] {
      EXPECT_EQ(thread_count(), threads);
      parallel_for(8, 1, [&](std::size_t, std::size_t) {
        parallel_for(8, 1, [&](std::size_t, std::size_t) {
          crowd.come();
          std::this_thread::sleep_for(std::chrono::microseconds(200));
          ++inner;
          crowd.go();
        });
      });
    });
    EXPECT_EQ(inner, 64);
    EXPECT_LE(crowd.most(), threads);
  }
}

// Two ranges that wait for one another: on one thread they never would meet. (oneTBB was seen to
// take five seconds for the second thread on a busy machine.)
TEST(Parallel, ranges_run_at_once) {
  std::mutex mutex;
  std::condition_variable arrived;
  int here = 0;
  std::atomic<int> met = 0;
  with_threads(2, [&] {
    parallel_for(2, 1, [&](std::size_t, std::size_t) {
      std::unique_lock lock(mutex);
      ++here;
      arrived.notify_all();
      if (arrived.wait_for(lock, std::chrono::seconds(60), [&] { return here == 2; })) ++met;
    });
  });
  EXPECT_EQ(met, 2);
}

TEST(Parallel, an_exception_of_a_range_is_passed_on) {
  for (const int threads : {1, 4}) {
    with_threads(threads, [&] {
      EXPECT_THROW(parallel_for(100, 1,
                                [&](std::size_t begin, std::size_t) {
                                  if (begin == 41) throw std::runtime_error("of range 41");
                                }),
                   std::runtime_error);
      std::atomic<int> ranges = 0;
      parallel_for(100, 1, [&](std::size_t, std::size_t) { ++ranges; });
      EXPECT_EQ(ranges, 100) << "after an exception";
    });
  }
}

// Each call took 8 KiB for good, as oneTBB does not give back an arena that had workers, and so did
// each thread that worked without saying on how many threads.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Parallel, calls_and_threads_that_are_over_hold_no_memory) {
  std::atomic<long> sum = 0;
  const auto work = [&] {
    parallel_for(100, 1, [&](std::size_t begin, std::size_t) {
      for (std::size_t i = 0; i < 1000; ++i) sum += static_cast<long>(begin);
    });
  };
  const auto resident_kib = [] {
    long pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return resident * (::sysconf(_SC_PAGESIZE) / 1024);
  };
  const auto calls = [&](int count) {
    for (int i = 0; i < count; ++i) {
      with_threads(1 + i % 3, work);
      std::thread(work).join();
    }
  };
  calls(50);
  const long before = resident_kib();
  calls(1000);
  // 14 MB and more before; a MiB is what an allocator may well hold back.
  EXPECT_LT(resident_kib() - before, 1024);
  EXPECT_EQ(sum, 2 * 1050 * 4950 * 1000L);
}
#endif

TEST(ParallelPipeline, takes_things_in_the_order_they_were_made_in) {
  struct Item {
    int number, square;
  };
  for (const int threads : {1, 2, 5})
    for (const int count : {0, 1, 7, 300}) {
      int made = 0;
      std::vector<int> taken;  // without a lock: written by one at a time
      Crowd on_their_way, at_work;
      const auto read = [&] {
        if (made == count) return std::shared_ptr<Item>();
        on_their_way.come();
        return std::make_shared<Item>(Item{made++, 0});
      };
      const auto work = [&](Item& item) {
        at_work.come();
        // The later the quicker, so that they would overtake each other.
        std::this_thread::sleep_for(std::chrono::microseconds(item.number % 3 == 0 ? 200 : 0));
        item.square = item.number * item.number;
        at_work.go();
      };
      const auto write = [&](const Item& item) {
        taken.push_back(item.square);
        on_their_way.go();
      };
      with_threads(threads, [&] { parallel_pipeline<Item>(4, read, work, write); });
      ASSERT_EQ(taken.size(), static_cast<std::size_t>(count));
      for (int i = 0; i < count; ++i) ASSERT_EQ(taken[static_cast<std::size_t>(i)], i * i);
      EXPECT_LE(on_their_way.most(), 4);
      EXPECT_LE(at_work.most(), threads);
    }
}

TEST(ParallelPipeline, ends_with_the_first_exception) {
  for (const int threads : {1, 4})
    for (const int where : {0, 1, 2}) {  // in read, work, write
      int made = 0;
      const auto fail_at = [&](int place, int number) {
        if (place == where && number == 20) throw std::runtime_error("of number 20");
      };
      const auto read = [&] {
        fail_at(0, made);
        return std::make_shared<int>(made++);
      };
      with_threads(threads, [&] {
        EXPECT_THROW(parallel_pipeline<int>(
                         8, read, [&](int& item) { fail_at(1, item); },
                         [&](int& item) { fail_at(2, item); }),
                     std::runtime_error);
      });
      EXPECT_LT(made, 40);
    }
}

// The suite's success under ThreadSanitizer is meaningful only if a race between ranges would
// fail.
#if defined(__SANITIZE_THREAD__)
TEST(ParallelDeathTest, thread_sanitizer_sees_a_race_between_parts) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto race = [] {
    int sum = 0;
    std::atomic<int> here = 0;
    parallel_for(2, 1, [&](std::size_t, std::size_t) {
      // Both have begun; relaxed, so that nothing looks ordered by this.
      here.fetch_add(1, std::memory_order_relaxed);
      while (here.load(std::memory_order_relaxed) < 2) std::this_thread::yield();
      ++sum;
    });
    std::exit(sum == 0);
  };
  EXPECT_EXIT(race(), testing::ExitedWithCode(66), "data race");
}
#endif
