// SPDX-License-Identifier: MIT
// Pictures and shares of pictures as OpenEXR images. Files with all samples of their pixels have
// the planes R, G, B and A. A share of the samples has the sums of its blocks, which are added when
// all shares are there (renderer/film/share.h).
#pragma once

#include "renderer/film/labels.h"
#include "renderer/io/exr.h"
#include "renderer/share/picture_facts.h"

namespace minkray {

/// The planes, the windows and the facts of a rendering with these options.
ExrImage exr_of(const Rendering& rendering, const RenderOptions& options, Facts facts);

/// The name of a plane of a block's sums; the channel is 'R', 'G' or 'B'.
std::string block_plane_name(int block, char channel);

/// The image of three planes of floats. Throws BadInput if one is missing.
Image image_of(const ExrImage& exr, const std::string& red, const std::string& green,
               const std::string& blue);

/// The planes .R, .G and .B of a name.
Image image_of(const ExrImage& exr, const std::string& name);

/// The names that the planes of Rendering::direct and variance begin with.
inline constexpr const char* direct_planes = "direct";
inline constexpr const char* variance_planes = "variance";

/// The integers of a plane. Throws BadInput if there is none of that name.
const std::vector<std::uint32_t>& integers_of(const ExrImage& exr, const std::string& name);

/// Number of the samples' rays that met an object: a plane in shares of the samples.
inline constexpr const char* met_plane = "met";

/// The fraction of the samples that met an object, as the plane A has it.
std::vector<float> coverage(const std::vector<std::uint32_t>& met, int samples);

/// Cost of a rendering, and the labels of its picture, as texts for the header.
inline constexpr const char* counts_fact = "minkray.counts";
std::string counts_text(const RayCounts& counts);
RayCounts counts_of(const Facts& facts);

inline constexpr const char* labels_fact = "minkray.labels";
std::string labels_text(const std::vector<Label>& labels);
std::vector<Label> labels_of(const Facts& facts);

/// Seconds that the rendering took, seconds of all processors together, and on how many threads.
inline constexpr const char* seconds_fact = "minkray.seconds";
inline constexpr const char* cpu_seconds_fact = "minkray.cpu_seconds";
inline constexpr const char* threads_fact = "minkray.threads";

}  // namespace minkray
