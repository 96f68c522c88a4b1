// SPDX-License-Identifier: MIT
// Mattes of every object for compositing: per pixel, which objects its samples hit and how often
// (Friedman and Jones, "Fully Automatic ID Mattes with Support for Motion Blur and Transparency",
// 2015, and the Cryptomatte specification 1.2). Casts the picture's camera rays again, so edges,
// lenses and shutters match.
#pragma once

#include <map>

#include "renderer/film/render.h"
#include "renderer/io/exr.h"

namespace minkray {

/// The name that the planes begin with.
inline constexpr const char* cryptomatte_layer = "CryptoObject";

/// MurmurHash3 of 32 bits (Appleby), and the float of its bits, which is always a normal number.
std::uint32_t cryptomatte_hash(std::string_view name);
float cryptomatte_id(std::string_view name);

struct Cryptomatte {
  /// CryptoObject00.R and .G are the id of the object that covers most of the pixel and how much,
  /// .B and .A the next one, and so on for six objects.
  std::vector<ExrPlane> planes;
  /// Attributes for the header: the manifest has the objects' names; particles have that of their
  /// set.
  std::map<std::string, std::string> texts;
};

/// Measures the region of `options` on all threads. The result is incomplete if the watch stopped
/// it.
Cryptomatte measure_cryptomatte(const Scene& scene, const World& world,
                                const RenderOptions& options, const RenderWatch& watch = {});

}  // namespace minkray
