// SPDX-License-Identifier: MIT
// Who is told of every ray of a picture and its answer. An observer changes nothing.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "renderer/base/real.h"

namespace minkray {

enum class RayKind : unsigned char { camera, shadow, ambient, indirect };

inline constexpr std::array<std::string_view, 4> ray_kind_names = {"camera", "shadow", "ambient",
                                                                   "indirect"};

/// Any number of threads may tell it at once.
class RayObserver {
 public:
  virtual ~RayObserver() = default;

  /// The ray leaves the instance `skip`; the answer is that of World::closest_hit, or of
  /// World::occluded.
  virtual void closest(RayKind kind, const Ray<Real>& ray, std::uint32_t skip,
                       const WorldHit<Real>& answer) = 0;
  virtual void occluded(RayKind kind, const Ray<Real>& ray, std::uint32_t skip, bool answer) = 0;
};

}  // namespace minkray
