// SPDX-License-Identifier: MIT
// Ctrl-C and SIGTERM: finishes what must be finished, then ends by the signal.
#pragma once

namespace minkray {

/// While one exists, SIGINT, SIGTERM and SIGHUP are noted instead of ending the process; where they
/// were ignored (nohup) they stay so. When the last one goes, a signal that was noted has its way.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// True if a signal came.
  static bool interrupted();

  /// If a signal came, ends the process as that signal does by default, so that shells and makes
  /// learn of it. Destroy everything that matters before.
  static void end_if_interrupted();
};

}  // namespace minkray
