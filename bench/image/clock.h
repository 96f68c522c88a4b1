// SPDX-License-Identifier: MIT
// Seconds of the wall's clock and of the processors, counted together.
#pragma once

#include <chrono>
#include <ctime>

namespace minkray::bench {

/// Seconds since construction. Work on one thread is measured by its processor time, which hardly
/// depends on the machine's other work; work on several, by the wall clock.
class Clock {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  double processor_seconds() const {
    return static_cast<double>(std::clock() - processor_begin_) / CLOCKS_PER_SEC;
  }
  double seconds_on(int threads) const { return threads == 1 ? processor_seconds() : seconds(); }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::clock_t processor_begin_ = std::clock();
};

}  // namespace minkray::bench
