// SPDX-License-Identifier: MIT
// Kinds of rays that an object is visible to.
#pragma once

#include <array>
#include <string_view>

#include "core/support/named_kind.h"
#include "core/world/instances.h"

namespace minkray {

/// Kinds of rays in pictures, as bits of RayKinds.
inline constexpr RayKinds camera_rays = 1, shadow_rays = 2, scattered_rays = 4;

inline constexpr std::array<NamedKind<RayKinds>, 3> ray_kinds_names = {{
    {camera_rays, "camera", "visible to the camera"},
    {shadow_rays, "shadow", "casts shadows"},
    {scattered_rays, "scattered", "visible in mirrors, through glass and to scattered light"},
}};

}  // namespace minkray
