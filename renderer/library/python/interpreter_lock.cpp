// SPDX-License-Identifier: MIT
#include "renderer/library/python/interpreter_lock.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

namespace minkray_python {
namespace {

/// Time that the end of the interpreter waits for running support functions.
constexpr std::chrono::seconds longest_wait(5);

/// State shared by all threads; never destroyed, since some threads may be blocked until the
/// process ends.
struct Gate {
  std::mutex mutex;  ///< held while the lock is waited for, and never by one who holds the lock
  bool is_ending = false;
  std::thread::id ending;
  std::atomic<int> inside = 0;  ///< threads of no interpreter that hold the lock, or are about to

  bool is_open() const { return !is_ending || ending == std::this_thread::get_id(); }
};

Gate& gate() {
  static Gate& made = *new Gate;
  return made;
}

void end() {
  PyThreadState* const state = PyEval_SaveThread();
  {
    const std::lock_guard lock(gate().mutex);
    gate().is_ending = true;
    gate().ending = std::this_thread::get_id();
  }
  const auto latest = std::chrono::steady_clock::now() + longest_wait;
  while (gate().inside > 0 && std::chrono::steady_clock::now() < latest)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  PyEval_RestoreThread(state);
}

}  // namespace

Unlocked::~Unlocked() {
  {
    const std::lock_guard lock(gate().mutex);
    if (gate().is_open()) {
      PyEval_RestoreThread(state_);
      return;
    }
  }
  for (;;) pause();
}

Locked::Locked() {
  if (PyGILState_Check()) {
    state_ = PyGILState_Ensure();
    return;
  }
  const std::lock_guard lock(gate().mutex);
  if (!gate().is_open()) return;
  is_outer_ = true;
  ++gate().inside;
  state_ = PyGILState_Ensure();
}

Locked::~Locked() {
  if (!state_) return;
  PyGILState_Release(*state_);
  if (is_outer_) --gate().inside;
}

bool is_interpreter_ending() {
  const std::lock_guard lock(gate().mutex);
  return !gate().is_open();
}

void watch_end_of_interpreter() {
  py::module_::import("atexit").attr("register")(py::cpp_function(&end));
}

}  // namespace minkray_python
