// SPDX-License-Identifier: MIT
// Integrators and their options.
#pragma once

#include <array>
#include <string_view>

#include "renderer/light/ray_observer.h"

namespace minkray {

/// Which light a picture is made of.
enum class IntegratorKind : unsigned char { automatic, path, direct, ambient, normals };

struct IntegratorDescription {
  IntegratorKind kind;
  std::string_view name, doc;
};

/// The list of all there are.
inline constexpr std::array integrators = {
    IntegratorDescription{IntegratorKind::automatic, "auto",
                          "path where the scene has what only that shows, else ambient"},
    IntegratorDescription{IntegratorKind::path, "path",
                          "all light, by paths of any length; unbiased"},
    IntegratorDescription{IntegratorKind::direct, "direct",
                          "light that comes straight from lights and shining bodies"},
    IntegratorDescription{IntegratorKind::ambient, "ambient",
                          "direct light, --bounces, and then ambient occlusion"},
    IntegratorDescription{IntegratorKind::normals, "normals", "the normals' directions as colours"},
};

/// Kinds of light to follow, and how far.
struct IntegratorOptions {
  /// How often light may be scattered between surfaces before the environment's light is the last
  /// word; 0 is ambient occlusion.
  int bounces = 1;
  /// How many mirrors in a row are followed; behind the last, the environment is seen.
  int mirrors = 4;
  /// How many camera rays are traced together, with all rays that follow from them. The picture is
  /// the same bit for bit.
  int ray_group = 512;
  /// Called with every ray and its result, if not null.
  RayObserver* observer = nullptr;
  IntegratorKind kind = IntegratorKind::automatic;
  /// How often a path may be scattered, mirrored or refracted.
  int max_depth = 16;
  /// Light that comes by way of more than one surface counts for no more than this: fewer bright
  /// specks, and less light. 0: no limit.
  double clamp = 0;
};

}  // namespace minkray
