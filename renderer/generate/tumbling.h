// SPDX-License-Identifier: MIT
// A scene with keyframes: bodies of many shapes that fly apart, tumbling.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/json/json.h"

namespace minkray {

/// Greatest number of bodies. All are written into the scene file with their keys; a larger file
/// could not be read.
inline constexpr std::size_t most_tumbling = 100000;

/// A block of `count` bodies bursts at 0 s and falls for two seconds; nothing collides.
Json tumbling_scene(std::size_t count, std::uint64_t seed);

}  // namespace minkray
