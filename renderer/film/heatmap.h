// SPDX-License-Identifier: MIT
// Cost of each pixel's camera ray, as numbers and as a picture with a scale.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "renderer/film/render.h"
#include "renderer/image/image.h"

namespace minkray {

/// Quantities of a camera ray that a heatmap can show.
enum class HeatChannel { iterations, supports, nodes, casts, path, status };

struct HeatChannelDescription {
  HeatChannel kind;
  std::string_view name;
  std::string_view unit;
  std::string_view doc;
};

inline constexpr std::array heat_channels = {
    HeatChannelDescription{HeatChannel::iterations, "iterations", "solver iterations per ray",
                           "solver iterations, summed over all casts of the ray"},
    HeatChannelDescription{HeatChannel::supports, "supports", "support points per ray",
                           "support points, summed over all casts of the ray"},
    HeatChannelDescription{HeatChannel::nodes, "nodes", "nodes visited per ray",
                           "visited BVH nodes (up to 8 boxes each), those of meshes included"},
    HeatChannelDescription{HeatChannel::casts, "casts", "casts per ray",
                           "shapes, planes and triangles of meshes that the ray is cast at"},
    HeatChannelDescription{HeatChannel::path, "path", "last stage needed by any cast",
                           "last stage that any cast needed: 0 closed form (filter), 1 osculating "
                           "ellipsoids (model), 2 GJK, 3 GJK with more digits (finer)"},
    HeatChannelDescription{HeatChannel::status, "status", "status of the cast",
                           "hit, miss, inside, or exhausted if any cast did not converge"},
};

inline const HeatChannelDescription& description_of(HeatChannel channel) {
  return *std::ranges::find(heat_channels, channel, &HeatChannelDescription::kind);
}

/// The statuses that the status channel distinguishes, in the order of its numbers.
inline constexpr std::array heat_statuses = {Status::miss, Status::hit, Status::inside,
                                             Status::exhausted};

/// One number a pixel, rows from the top.
struct HeatField {
  int width = 0, height = 0;
  std::vector<float> values;
  QueryCounts work;  ///< of all rays together
  bool complete = false;
};

/// Channel to show unless one is chosen: planes and meshes have no iterations.
HeatChannel default_channel(const Scene& scene);

/// Casts one ray through each pixel's centre (samples 1), or samples evenly spread over it: counts
/// are averaged, and the gravest status wins.
HeatField measure_heat(const Scene& scene, const World& world, HeatChannel channel,
                       const RenderOptions& options, const RenderWatch& watch = {});

struct HeatSummary {
  double least = 0, mean = 0, most = 0;
};
HeatSummary summary_of(const HeatField& field);

/// The values as a table of the terminal: least, mean and most and a histogram, or for status how
/// many pixels of each.
std::string heat_report(const HeatField& field, HeatChannel channel);

/// One panel of a heat picture.
struct HeatPanel {
  std::string title;
  const HeatField* field;
};

/// The panels side by side on one scale, above a colour bar with numbers and unit.
Image heat_picture(const std::vector<HeatPanel>& panels, HeatChannel channel);

/// The numbers in all three channels, panels side by side, for formats that keep floats.
Image heat_numbers(const std::vector<HeatPanel>& panels);

}  // namespace minkray
