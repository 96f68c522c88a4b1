// SPDX-License-Identifier: MIT
#include "renderer/interrupt.h"

#include <atomic>

namespace minkray {
namespace {

/// Signal handlers can reach nothing but a global.
std::atomic<int> received_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free);

void note(int signal) {
  received_signal = signal;
}

}  // namespace

InterruptGuard::InterruptGuard() {
  struct sigaction noting = {};
  noting.sa_handler = note;
  sigemptyset(&noting.sa_mask);
  noting.sa_flags = SA_RESTART;
  const auto take_over = [&](int signal, struct sigaction& before) {
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &noting, nullptr);
  };
  take_over(SIGINT, before_int_);
  take_over(SIGTERM, before_term_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &before_int_, nullptr);
  sigaction(SIGTERM, &before_term_, nullptr);
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
