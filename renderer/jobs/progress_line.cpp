// SPDX-License-Identifier: MIT
#include "renderer/jobs/progress_line.h"

#include <unistd.h>

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
  std::fprintf(stderr, "\r\x1b[K%s", progress_text(fraction, rays, seconds, noise_).c_str());
  std::fflush(stderr);
}

}  // namespace minkray
