// SPDX-License-Identifier: MIT
// Progress on a terminal's stderr: how much is done, rays per second, time left, noise. Nothing at
// all if stderr is not a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace minkray {

class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
  /// Leaves the terminal's line empty.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(double fraction, std::uint64_t rays);
  /// From then on it is shown: the noise of a picture, as a part of its brightness.
  void set_noise(double noise) { noise_ = noise; }

 private:
  using Clock = std::chrono::steady_clock;
  bool shown_;
  bool line_is_dirty_ = false;
  double noise_ = -1;  ///< negative: not known
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_ = begin_;
};

/// What the line says after so many seconds; noise is left out if it is negative.
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
