// SPDX-License-Identifier: MIT
// Progress on a terminal's stderr: share done, rays per second, time left, noise. Prints nothing if
// stderr is not a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace minkray {

class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
  /// Clears the terminal's line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(double fraction, std::uint64_t rays);
  /// Shows from now on the noise of a picture, relative to its brightness.
  void set_noise(double noise) { noise_ = noise; }

 private:
  using Clock = std::chrono::steady_clock;
  bool shown_;
  bool line_is_dirty_ = false;
  double noise_ = -1;  ///< negative: unknown
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_ = begin_;
};

/// Text of the line after `seconds`; noise is left out if it is negative.
inline std::string progress_text(double fraction, std::uint64_t rays, double seconds,
                                 double noise) {
  const auto left = static_cast<long>(seconds * (1 - fraction) / fraction);
  char text[128];
  int length =
      std::snprintf(text, sizeof text, "%5.1f %%  %.2f Mray/s  %ld:%02ld left", 100 * fraction,
                    static_cast<double>(rays) / seconds / 1e6, left / 60, left % 60);
  std::string line(text, static_cast<std::size_t>(length));
  if (noise < 0) return line;
  length = std::snprintf(text, sizeof text, "  noise %.2g %%", 100 * noise);
  return line + std::string(text, static_cast<std::size_t>(length));
}

/// Measures seconds since a moment.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace minkray
