// SPDX-License-Identifier: MIT
// Progress on a terminal's stderr: how much is done, rays per second, time left. Nothing at all if
// stderr is not a terminal.
#pragma once

#include <chrono>
#include <cstdint>

namespace minkray {

class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
  /// Leaves the terminal's line empty.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(double fraction, std::uint64_t rays);

 private:
  using Clock = std::chrono::steady_clock;
  bool shown_;
  bool line_is_dirty_ = false;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_ = begin_;
};

/// Seconds since a moment.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace minkray
