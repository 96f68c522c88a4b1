// SPDX-License-Identifier: MIT
// Shared by several kinds of work.
#include "tests/soak/work.h"

namespace soak {

std::string source_file(const std::string& name) {
  return MINKRAY_SOURCE_FOLDER "/" + name;
}

bool stopped_after(double part, int threads, const std::function<void(const mk::Options&)>& call) {
  struct Watch {
    double part;
    bool asked;
  } watch = {part, false};
  mk::Options options;
  options.threads = threads;
  options.user = &watch;
  options.progress = [](void* user, double done) {
    auto& watching = *static_cast<Watch*>(user);
    if (done >= watching.part) watching.asked = true;
    return watching.asked ? 1 : 0;
  };
  bool stopped = false;
  try {
    call(options);
  } catch (const mk::Error& error) {
    if (error.code() != MINKRAY_STOPPED) throw;
    stopped = true;
  }
  expect(stopped == watch.asked, "a call must end as stopped if and only if it was asked to");
  return stopped;
}

}  // namespace soak
