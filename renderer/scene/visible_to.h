// SPDX-License-Identifier: MIT
// Kinds of rays that an object is visible to.
#pragma once

#include <array>
#include <string_view>

#include "core/world/instances.h"

namespace minkray {

/// Kinds of rays in pictures, as bits of RayKinds.
inline constexpr RayKinds camera_rays = 1, shadow_rays = 2, scattered_rays = 4;

struct RayKindsName {
  RayKinds kinds;
  std::string_view name;
  std::string_view doc;
};

inline constexpr std::array<RayKindsName, 3> ray_kinds_names = {{
    {camera_rays, "camera", "it is seen where nothing is between"},
    {shadow_rays, "shadow", "it keeps the light of lamps from others"},
    {scattered_rays, "scattered",
     "it is seen in mirrors and through glass, and by rays that surfaces scatter"},
}};

}  // namespace minkray
