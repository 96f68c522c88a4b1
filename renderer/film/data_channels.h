// SPDX-License-Identifier: MIT
// AOVs (data channels): data per pixel other than the picture's colour. Most come from one
// unfiltered ray through the pixel's centre: its first hit, and the solver's cost. Some are means
// over all samples of the pixel.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/film/render.h"
#include "renderer/io/exr.h"

namespace minkray {

/// A channel that may be requested, and its planes in an OpenEXR file.
struct DataChannelDescription {
  std::string_view name;
  std::string_view planes;  ///< suffixes: "" for one plane, "XYZ" for .X, .Y and .Z
  std::string_view doc;
  enum class By : unsigned char { centre, samples } by = By::centre;
};

/// All data channels.
inline constexpr std::array data_channels = {
    DataChannelDescription{"Z", "", "depth along the camera's axis; infinite for a miss"},
    DataChannelDescription{"dist", "", "distance from the camera; infinite for a miss"},
    DataChannelDescription{"N", "XYZ", "outward unit normal in world coordinates; 0 for a miss"},
    DataChannelDescription{"P", "XYZ", "hit point in world coordinates; 0 for a miss"},
    DataChannelDescription{"id.object", "",
                           "1 + index of the object in the scene; 0 for a miss (integer)"},
    DataChannelDescription{"gjk.iterations", "",
                           "solver iterations, summed over all casts of the ray (integer)"},
    DataChannelDescription{"gjk.supports", "",
                           "support points, summed over all casts of the ray (integer)"},
    DataChannelDescription{
        "gjk.gap", "",
        "width of the interval that contains the hit's ray parameter t; 0 for a miss"},
    DataChannelDescription{"albedo", "RGB", "colour of the surface's material; 0 for a miss"},
    DataChannelDescription{"emission", "RGB", "light emitted by the surface; 0 for a miss"},
    DataChannelDescription{"thickness", "", "length of the ray inside the object; 0 for a miss"},
    DataChannelDescription{
        "uv", "UV",
        "texture coordinates of the mesh; if there are none, longitude and latitude around the "
        "object's origin; 0 for a miss"},
    DataChannelDescription{
        "motion", "XY",
        "motion of the hit point while the shutter is open, in pixels; 0 for a miss"},
    DataChannelDescription{"direct", "RGB", "direct light (scattered at most once)",
                           DataChannelDescription::By::samples},
    DataChannelDescription{"indirect", "RGB", "indirect light (scattered more than once)",
                           DataChannelDescription::By::samples},
    DataChannelDescription{"variance", "RGB",
                           "squared standard error of the pixel, estimated from its samples",
                           DataChannelDescription::By::samples},
    DataChannelDescription{"cryptomatte", "",
                           "Cryptomatte of all objects by name (planes CryptoObject00.R to "
                           "CryptoObject02.A; names in the header)",
                           DataChannelDescription::By::samples},
    DataChannelDescription{
        "status", "",
        "0 miss, 1 hit, 2 ray starts inside a shape, 3 a cast did not converge (integer)"},
};

/// Splits a comma-separated list of channel names; "all" means every channel. Throws WrongUsage,
/// with a list of the valid names, for an unknown name. Drops duplicates.
std::vector<std::string_view> parse_data_channels(const std::string& list);

/// True if the channel's planes store integers.
bool has_integers(std::string_view channel);

/// True if the names include direct, indirect or variance, which need
/// RenderOptions::light_channels.
bool are_light_channels_wanted(const std::vector<std::string_view>& channels);

/// Returns the planes of the channels that come from a rendering with light_channels.
std::vector<ExrPlane> light_planes(const Rendering& rendering,
                                   const std::vector<std::string_view>& channels);

/// Casts one ray through the centre of each pixel in the region of `options`, in all threads, and
/// returns the planes of the channels that come from these rays. Incomplete if the watch returned
/// stop.
std::vector<ExrPlane> measure_data_channels(const Scene& scene, const World& world,
                                            const std::vector<std::string_view>& channels,
                                            const RenderOptions& options,
                                            const RenderWatch& watch = {});

}  // namespace minkray
