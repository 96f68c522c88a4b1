// SPDX-License-Identifier: MIT
#include "renderer/cli/progress_line.h"

#include <unistd.h>

#include <cstdio>

namespace minkray {

ProgressLine::ProgressLine(bool wanted) : shown_(wanted && ::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (line_is_dirty_) std::fputs("\r\x1b[K", stderr);
}

void ProgressLine::show(double fraction, std::uint64_t rays) {
  constexpr auto pause = std::chrono::milliseconds(100);
  const Clock::time_point now = Clock::now();
  if (!shown_ || now - last_ < pause) return;
  last_ = now;
  line_is_dirty_ = true;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const auto left = static_cast<long>(seconds * (1 - fraction) / fraction);
  std::fprintf(stderr, "\r\x1b[K%5.1f %%  %.2f Mray/s  %ld:%02ld left", 100 * fraction,
               static_cast<double>(rays) / seconds / 1e6, left / 60, left % 60);
  std::fflush(stderr);
}

}  // namespace minkray
