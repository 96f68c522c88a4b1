// SPDX-License-Identifier: MIT
#include "renderer/base/interrupt.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <mutex>

namespace minkray {
namespace {

constexpr std::array signals = {SIGINT, SIGTERM, SIGHUP};

/// Signal handling is process-wide, and so is the state before the first guard.
std::mutex mutex;
int guards = 0;
std::array<struct sigaction, signals.size()> before = {};

/// Signal handlers can reach nothing but a global.
std::atomic<int> received_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free);

void note(int signal) {
  received_signal = signal;
}

}  // namespace

InterruptGuard::InterruptGuard() {
  const std::lock_guard lock(mutex);
  if (guards++ > 0) return;
  struct sigaction noting = {};
  noting.sa_handler = note;
  sigemptyset(&noting.sa_mask);
  noting.sa_flags = 0;  // interrupts blocking calls (waiting for a pipe's reader)
  for (std::size_t i = 0; i < signals.size(); ++i) {
    sigaction(signals[i], nullptr, &before[i]);
    if (before[i].sa_handler != SIG_IGN) sigaction(signals[i], &noting, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  {
    const std::lock_guard lock(mutex);
    if (--guards > 0) return;
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before[i], nullptr);
  }
  end_if_interrupted();
}

bool InterruptGuard::interrupted() {
  return received_signal != 0;
}

void InterruptGuard::end_if_interrupted() {
  const int signal = received_signal;
  if (signal == 0) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace minkray
