// SPDX-License-Identifier: MIT
#include "tests/soak/memory.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <thread>

namespace soak {
namespace {

/// In bytes. All that a round allocates is freed at its end, but what threads that live on keep:
/// small blocks in glibc's caches of the threads (switched off by the task: GLIBC_TUNABLES),
/// oneTBB's queues. A leak of a pointer's 32 bytes per round is twice this within an hour of rounds
/// of a second and a half.
constexpr double most_in_use_growth = 64 * 1024;

/// In bytes: memory that an allocator may hold back, as rounds differ in what runs together.
/// Resident memory varied by 1 MiB, and with oneTBB's leak of 8 KiB per call grew by 1 MiB in four
/// rounds.
constexpr double most_resident_growth = 4 * 1024 * 1024;

std::size_t entries(const char* folder) {
  const std::filesystem::directory_iterator all(folder);
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

template <class Number>
double median(const std::vector<Held>& rounds, std::size_t first, std::size_t count,
              Number Held::*number) {
  std::vector<double> numbers;
  for (std::size_t i = first; i < first + count; ++i)
    numbers.push_back(static_cast<double>(rounds[i].*number));
  std::ranges::nth_element(numbers, numbers.begin() + static_cast<std::ptrdiff_t>(count / 2));
  return numbers[count / 2];
}

}  // namespace

Held held_now(double seconds) {
  Held held;
  held.seconds = seconds;
  const struct mallinfo2 allocated = ::mallinfo2();
  held.in_use = allocated.uordblks + allocated.hblkhd;
  std::size_t pages = 0, resident_pages = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident_pages;
  held.resident = resident_pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  held.files = entries("/proc/self/fd");
  held.threads = entries("/proc/self/task");
  return held;
}

std::string what_grew(const std::vector<Held>& rounds) {
  std::size_t warm = 2;
  while (warm < rounds.size() && rounds[warm].seconds < rounds.back().seconds / 10) ++warm;
  if (rounds.size() < warm + 4) return "too few rounds to tell";
  const std::size_t quarter = (rounds.size() - warm) / 4;
  const auto growth = [&](auto number) {
    return median(rounds, rounds.size() - quarter, quarter, number) -
           median(rounds, warm, quarter, number);
  };
  std::string grew;
  const auto tell = [&](double by, double most, const char* what) {
    if (by > most)
      grew += std::string(grew.empty() ? "" : "; ") + what + " by " +
              std::to_string(static_cast<long long>(by)) + ", more than " +
              std::to_string(static_cast<long long>(most));
  };
  tell(growth(&Held::in_use), most_in_use_growth, "bytes in use");
  tell(growth(&Held::resident), most_resident_growth, "resident bytes");
  tell(growth(&Held::files), 0, "open files");
  // oneTBB starts its workers when they are first wanted, and on a busy machine later than that.
  tell(growth(&Held::threads), std::thread::hardware_concurrency() + 2, "threads");
  return grew;
}

}  // namespace soak
