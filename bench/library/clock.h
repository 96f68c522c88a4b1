// SPDX-License-Identifier: MIT
// Processor time of all threads of this process: other work on the machine hardly shows in it, and
// a library that used more threads than one would pay for them.
#pragma once

#include <ctime>

namespace bench {

inline double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Seconds since it was made.
class Clock {
 public:
  double processor() const { return processor_seconds() - processor_; }

 private:
  double processor_ = processor_seconds();
};

}  // namespace bench
