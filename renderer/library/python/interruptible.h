// SPDX-License-Identifier: MIT
// Runs work without the interpreter's lock; Ctrl-C stops it.
#pragma once

#include <chrono>
#include <thread>

#include "renderer/library/python/interpreter_lock.h"

namespace minkray_python {

inline void check(int code) {
  if (code != MINKRAY_OK) throw minkray::Error(code);
}

/// Lets Ctrl-C stop long calls: signals are checked by the calling thread, which also calls the
/// caller's progress function, if there is one, with the part that is done. If that returns true,
/// or raises, the work is stopped.
class Interruptible {
 public:
  explicit Interruptible(int threads, py::object progress = py::none())
      : progress_(std::move(progress)) {
    options_ = {sizeof options_, threads, 0, &Interruptible::look, this};
  }
  const minkray_options* options() const { return &options_; }

  /// Runs the work without the interpreter's lock; answers its code.
  template <class Work>
  void run(Work&& work) {
    int code = MINKRAY_OK;
    {
      const Unlocked unlock;
      code = work(options());
    }
    if (code == MINKRAY_STOPPED && PyErr_Occurred()) throw py::error_already_set();
    check(code);
    if (!progress_.is_none()) progress_(1.0);
  }

 private:
  static int look(void* user, double done) {
    auto* self = static_cast<Interruptible*>(user);
    if (std::this_thread::get_id() != self->caller_) return 0;
    // Limits how often the lock is taken to a rate that is not noticeable.
    const Clock::time_point now = Clock::now();
    if (now < self->next_look_) return 0;
    self->next_look_ = now + std::chrono::milliseconds(20);
    const Locked lock;
    if (!lock || PyErr_CheckSignals() != 0) return 1;
    return self->progress_.is_none() ? 0 : self->tell(done);
  }
  int tell(double done) const {
    try {
      return py::bool_(progress_(done)) ? 1 : 0;
    } catch (py::error_already_set& error) {
      error.restore();  // `run` throws it again
      return 1;
    }
  }
  using Clock = std::chrono::steady_clock;
  Clock::time_point next_look_ = Clock::now();
  std::thread::id caller_ = std::this_thread::get_id();
  minkray_options options_;
  py::object progress_;  ///< None: no callback
};

}  // namespace minkray_python
