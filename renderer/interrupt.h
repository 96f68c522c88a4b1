// SPDX-License-Identifier: MIT
// Ctrl-C and a polite kill: finish what must be finished, then end as the signal wants.
#pragma once

#include <csignal>

namespace minkray {

/// While one exists, SIGINT and SIGTERM are noted instead of ending the process; where they were
/// ignored (nohup) they stay so. There must not be two at once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether a signal came.
  static bool interrupted();

  /// If a signal came, ends the process as that signal does by default, so that shells and makes
  /// learn of it. Destroy everything that matters before.
  static void end_if_interrupted();

 private:
  struct sigaction before_int_ = {};
  struct sigaction before_term_ = {};
};

}  // namespace minkray
