// SPDX-License-Identifier: MIT
// Python's lock, released and taken so that the interpreter may end while a thread is running. A
// thread that requests the lock of an ending interpreter is killed, which C++ cannot unwind. So
// before the interpreter ends, other threads stop for the rest of the process.
#pragma once

#include <optional>

#include "renderer/library/python/arrays.h"

namespace minkray_python {

/// Releases the lock of this thread, which holds it, for as long as it exists.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  ~Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* state_;
};

/// Takes the lock on any thread for as long as it exists; false if the interpreter is ending.
class Locked {
 public:
  Locked();
  ~Locked();
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;
  explicit operator bool() const { return state_.has_value(); }

 private:
  bool is_outer_ = false;
  std::optional<PyGILState_STATE> state_;
};

/// True if another thread is ending the interpreter.
bool is_interpreter_ending();

/// Makes the interpreter notify the module before it ends.
void watch_end_of_interpreter();

}  // namespace minkray_python
