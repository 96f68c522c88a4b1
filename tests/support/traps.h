// SPDX-License-Identifier: MIT
// Tests if a calculation would be stopped by floating-point traps: invalid operations (0 * inf,
// inf - inf, comparisons with NaN) and divisions by zero.
#pragma once

#include <cfenv>
#include <csetjmp>
#include <csignal>

namespace minkray::testing {
namespace detail {
inline thread_local sigjmp_buf after_trap;
inline void leave_by_trap(int) {
  siglongjmp(after_trap, 1);
}
}  // namespace detail

/// Runs `calculate` with traps on: false if it was trapped, and abandoned at that point. The
/// functions that it calls must own nothing then. x86 and GNU C library only; elsewhere nothing is
/// trapped.
template <class Calculate>
bool runs_without_trap(const Calculate& calculate) {
#if defined(__GLIBC__) && defined(__x86_64__)
  struct sigaction handler = {}, before = {};
  handler.sa_handler = detail::leave_by_trap;
  sigaction(SIGFPE, &handler, &before);
  volatile bool finished = false;
  std::feclearexcept(FE_ALL_EXCEPT);  // exceptions already raised would trap at the next operation
  if (sigsetjmp(detail::after_trap, 1) == 0) {
    feenableexcept(FE_INVALID | FE_DIVBYZERO);
    calculate();
    finished = true;
  }
  fedisableexcept(FE_ALL_EXCEPT);
  std::feclearexcept(FE_ALL_EXCEPT);
  sigaction(SIGFPE, &before, nullptr);
  return finished;
#else
  calculate();
  return true;
#endif
}

}  // namespace minkray::testing
