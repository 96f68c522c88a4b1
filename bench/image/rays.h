// SPDX-License-Identifier: MIT
// The rays that are cast: of the scene's camera, from where those arrive to the light, and to all
// sides. Which hits they start from makes all the difference there is between tracers.
#pragma once

#include "bench/image/tracer.h"
#include "renderer/image/image.h"
#include "renderer/rays/camera.h"

namespace minkray::bench {

/// Rays from the points where other rays arrived.
struct SecondaryRays {
  std::vector<Ray<float>> rays;
  std::vector<std::uint32_t> leaves;
  std::vector<std::uint32_t> from;  ///< by ray: the index of the hit it starts from
};

/// A tile's camera rays: sample by sample, in blocks of 8 x 8 pixels made of blocks of 4 x 2, so
/// that neighbours make packets. `pixel_of` gets their pixels.
void camera_rays(const Camera& camera, const PixelRect& tile, int samples,
                 std::vector<Ray<float>>& rays, std::vector<std::array<int, 2>>& pixel_of);

/// Height above a surface at which rays begin: beyond the error of any mesh, and far below what is
/// visible.
float lift_for(const Scene& scene);

/// A direction for each hit: `towards` the light for all, or, without one, one of the hemisphere
/// with the density of the cosine, by the ray's number and `seed`.
void secondary_rays(const Tracer& tracer, std::span<const Ray<float>> rays,
                    std::span<const FirstHit> hits, float lift,
                    const std::optional<Vec3<float>>& towards, std::uint64_t seed,
                    SecondaryRays& secondary);

/// Tiles in rows: big enough for streams.
inline constexpr int tile_side = 32;

std::vector<PixelRect> tiles_of(const Resolution& resolution);

}  // namespace minkray::bench
