// SPDX-License-Identifier: MIT
// Doing things on several threads: by oneTBB, which parallel.cpp alone sees, or under
// ThreadSanitizer by the standard library's threads (parallel_std.cpp).
#pragma once

#include <cstddef>
#include <functional>

namespace minkray {

/// Calls body(begin, end) for consecutive index ranges of [0, count) of at most `grain` items,
/// possibly at once. An exception of a body is passed on.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls `work` where parallel_for uses at most `threads` threads; 0: one per core.
void with_threads(int threads, const std::function<void()>& work);

/// Number of threads that parallel_for may use here.
int thread_count();

}  // namespace minkray
