// SPDX-License-Identifier: MIT
// Many rays on several threads, with a caller who hears how it goes and may stop it.
#pragma once

#include <functional>

#include "renderer/library/c_header.h"

namespace minkray {

/// Rays that one thread takes at once; a multiple of most_rays_at_once.
inline constexpr std::size_t rays_a_part = 2048;

/// Calls body(begin, end) for parts of [0, count), at once. Throws CallError if the options are
/// wrong, or if the caller stops it.
void work_on_rays(std::size_t count, const minkray_options* options,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace minkray
