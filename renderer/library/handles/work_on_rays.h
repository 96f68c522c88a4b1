// SPDX-License-Identifier: MIT
// Runs work on many rays on several threads, with progress reports and cancellation.
#pragma once

#include <functional>

#include "renderer/library/handles/c_header.h"

namespace minkray {

/// Rays that one thread takes at once; a multiple of most_rays_at_once.
inline constexpr std::size_t rays_a_part = 2048;

/// Throws CallError unless this number of threads is valid.
int checked_threads(int threads);

/// Number of threads that the options specify; throws CallError if they are wrong. The options may
/// be null.
int threads_of(const minkray_options* options);

/// Reports progress to the caller; returns true if the caller wants to stop. Throws CallError if
/// the callback throws.
bool wants_stop(const minkray_options* options, double done);

/// Calls body(begin, end) for parts of [0, count), at once. Throws CallError if the options are
/// wrong, or if the caller stops it.
void work_on_rays(std::size_t count, const minkray_options* options,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Likewise, for parts of `part_size` items: few for those that take long.
void work_on_parts(std::size_t count, std::size_t part_size, const minkray_options* options,
                   const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls body(begin, end) likewise, for groups of at most `group` that follow each other: in order,
/// or if they are to be gathered, some of them in turns (gather.h).
void work_on_groups(std::size_t count, std::size_t group, bool gathered,
                    const minkray_options* options,
                    const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace minkray
