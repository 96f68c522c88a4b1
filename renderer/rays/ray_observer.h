// SPDX-License-Identifier: MIT
// Receives every traced ray of a picture and its result. Must not affect rendering.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/world/world.h"
#include "renderer/scene/visible_to.h"

namespace minkray {

enum class RayKind : unsigned char { camera, shadow, ambient, indirect };

inline constexpr std::array<std::string_view, 4> ray_kind_names = {"camera", "shadow", "ambient",
                                                                   "indirect"};

/// Objects that a ray of the kind may meet.
constexpr RayKinds kinds_of(RayKind kind) {
  return kind == RayKind::camera   ? camera_rays
         : kind == RayKind::shadow ? shadow_rays
                                   : scattered_rays;
}

/// Any number of threads may call it at once.
class RayObserver {
 public:
  virtual ~RayObserver() = default;

  /// The ray leaves the instance `skip`; the answer is that of World::closest_hit, or of
  /// World::occluded.
  virtual void closest(RayKind kind, const Ray<double>& ray, std::uint32_t skip,
                       const WorldHit& answer) = 0;
  virtual void occluded(RayKind kind, const Ray<double>& ray, std::uint32_t skip, bool answer) = 0;
};

}  // namespace minkray
