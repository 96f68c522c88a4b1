// SPDX-License-Identifier: MIT
// Integrators and their options.
#pragma once

#include <array>
#include <string_view>

#include "core/support/named_kind.h"
#include "renderer/rays/ray_observer.h"

namespace minkray {

/// Rendering method: the light that a picture shows.
enum class IntegratorKind : unsigned char { automatic, path, direct, ambient, normals };

/// All rendering methods.
inline constexpr std::array integrators = {
    NamedKind<IntegratorKind>{
        IntegratorKind::automatic, "auto",
        "path if a material or a light (image sky, sun sky) needs path tracing; otherwise ambient"},
    NamedKind<IntegratorKind>{IntegratorKind::path, "path", "path tracing of all light; unbiased"},
    NamedKind<IntegratorKind>{IntegratorKind::direct, "direct",
                              "direct light from lights and emissive objects"},
    NamedKind<IntegratorKind>{
        IntegratorKind::ambient, "ambient",
        "direct light and diffuse bounces (--bounces); after the last bounce, ambient occlusion"},
    NamedKind<IntegratorKind>{IntegratorKind::normals, "normals", "surface normals as colours"},
};

/// Kinds of light to follow, and how far.
struct IntegratorOptions {
  /// Largest number of scatterings between surfaces before the environment's light is used; 0 is
  /// ambient occlusion.
  int bounces = 1;
  /// Largest number of mirrors in a row; behind the last, the environment is seen.
  int mirrors = 4;
  /// Number of camera rays that are traced together, with all rays that follow from them. The
  /// picture is the same bit for bit.
  int ray_group = 512;
  /// Called with every ray and its result, if not null.
  RayObserver* observer = nullptr;
  IntegratorKind kind = IntegratorKind::automatic;
  /// Largest number of times that a path may be scattered, mirrored or refracted.
  int max_depth = 16;
  /// Clamps light that arrives via more than one surface: fewer fireflies, slightly darker
  /// (biased). 0: no limit.
  double clamp = 0;
};

}  // namespace minkray
