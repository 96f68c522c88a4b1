// SPDX-License-Identifier: MIT
// Loops on several threads. Uses oneTBB, which only parallel.cpp includes. Under ThreadSanitizer,
// uses the threads of the standard library instead (parallel_std.cpp).
#pragma once

#include <cstddef>
#include <functional>

namespace minkray {

/// Calls body(begin, end) for consecutive index ranges of [0, count) of at most `grain` items,
/// possibly in parallel. Exceptions of a body reach the caller.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls `work`, in which parallel_for uses at most `threads` threads; 0: one per core.
void with_threads(int threads, const std::function<void()>& work);

/// Number of threads that parallel_for may use.
int thread_count();

}  // namespace minkray
