// SPDX-License-Identifier: MIT
// Everything that determines a picture, as texts: written to the headers of OpenEXR files, and
// compared when shares are merged.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/film/render.h"

namespace minkray {

using Facts = std::map<std::string, std::string>;

namespace fact {

inline constexpr const char* software = "software";  ///< the standard attribute's name
inline constexpr const char* command = "minkray.command";
inline constexpr const char* scene = "minkray.scene";  ///< a hash: of its file and its meshes
inline constexpr const char* resolution = "minkray.resolution";
inline constexpr const char* crop = "minkray.crop";
inline constexpr const char* samples = "minkray.samples";
inline constexpr const char* seed = "minkray.seed";
inline constexpr const char* solver = "minkray.solver";
inline constexpr const char* bounces = "minkray.bounces";
inline constexpr const char* integrator = "minkray.integrator";
inline constexpr const char* limits = "minkray.limits";      ///< of bright light, of noise
inline constexpr const char* denoised = "minkray.denoised";  ///< "yes", or missing
inline constexpr const char* aov = "minkray.aov";            ///< names between commas
inline constexpr const char* tile = "minkray.tile";
inline constexpr const char* sample_share = "minkray.sample_share";

}  // namespace fact

/// The facts of a picture, without command, data channels, tile and share of the samples.
Facts picture_facts(const Scene& scene, const World& world, const RenderOptions& options);

/// The names of the facts that all shares of one picture have in common.
std::vector<std::string> common_facts();

/// Lists the differences in the named facts, for a message: "minkray.seed is 3, not 4"; empty if
/// there are none.
std::string difference(const Facts& found, const Facts& wanted,
                       const std::vector<std::string>& names);

/// "64x48" and "0,0,64,48", there and back. Throws BadInput if they are anything else.
Resolution resolution_of(const Facts& facts);
PixelRect crop_of(const Facts& facts);
int samples_of(const Facts& facts);

/// The fact, or an empty text.
std::string text_of(const Facts& facts, const std::string& name);

}  // namespace minkray
