// SPDX-License-Identifier: MIT
// Border to other languages: no exception crosses it; error messages are kept as text.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "renderer/library/handles/c_header.h"

namespace minkray {

/// An error with the code that the caller gets.
class CallError : public std::runtime_error {
 public:
  CallError(minkray_code code, const std::string& what) : std::runtime_error(what), code_(code) {}
  minkray_code code() const { return code_; }

 private:
  minkray_code code_;
};

/// "FUNCTION: ARGUMENT: must be ...": what functions of the border throw; `call` adds the function.
[[noreturn]] void wrong_use(const std::string& what);

/// Throws unless the pointer is set.
[[noreturn]] void wrong_null(const char* argument);
inline void require(const void* pointer, const char* argument) {
  if (!pointer) [[unlikely]]
    wrong_null(argument);
}

/// Throws unless an array of `count` items of this size fits in memory: a negative count,
/// converted to unsigned, does not.
void require_room(std::size_t count, std::size_t bytes_each, const char* argument);

/// The code of what is being thrown right now, whose text is kept for this thread.
int keep_error(const char* function) noexcept;

const char* last_error() noexcept;

/// Runs the work of a function of the border; the answer is its code.
template <class Work>
int call(const char* function, Work&& work) noexcept {
  try {
    work();
    return MINKRAY_OK;
  } catch (...) {
    return keep_error(function);
  }
}

}  // namespace minkray
