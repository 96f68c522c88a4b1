// SPDX-License-Identifier: MIT
// Doing things on several threads. oneTBB is seen by parallel.cpp alone.
#pragma once

#include <cstddef>
#include <functional>

namespace minkray {

/// Runs both, possibly at once.
void run_both(const std::function<void()>& first, const std::function<void()>& second);

/// Calls body(begin, end) for consecutive parts of [0, count) of at most `grain` items, possibly at
/// once. An exception of a body is passed on.
void for_parts(std::size_t count, std::size_t grain,
               const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls `work` where run_both and for_parts use at most `threads` threads; 0: one per core.
void with_threads(int threads, const std::function<void()>& work);

/// How many threads run_both and for_parts may use here.
int thread_count();

}  // namespace minkray
