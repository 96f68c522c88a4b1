// SPDX-License-Identifier: MIT
#include "bench/image/rays.h"

#include <numbers>

#include "bench/image/subject.h"
#include "core/derived/shape_bounds.h"
#include "renderer/rays/sampler.h"
#include "renderer/surfaces/reflection.h"

namespace minkray::bench {

void camera_rays(const Camera& camera, const PixelRect& tile, int samples,
                 std::vector<Ray<float>>& rays, std::vector<std::array<int, 2>>& pixel_of) {
  rays.clear();
  pixel_of.clear();
  const auto add = [&](int x, int y, int sample) {
    if (x >= tile.x1 || y >= tile.y1) return;
    Sampler sampler(0, x, y, static_cast<std::uint32_t>(sample));
    const std::array<double, 2> u = sampler.next();
    const Ray<double> ray = camera.ray(x + u[0], y + u[1]);
    rays.push_back({ray.origin.cast<float>(), ray.direction.cast<float>()});
    pixel_of.push_back({x, y});
  };
  // 4 x 2 pixels for packets of eight, 8 of those for tracers that take 64 rays together.
  for (int sample = 0; sample < samples; ++sample)
    for (int y = tile.y0; y < tile.y1; y += 8)
      for (int x = tile.x0; x < tile.x1; x += 8)
        for (int i = 0; i < 64; ++i)
          add(x + i % 4 + i / 8 % 2 * 4, y + i / 4 % 2 + i / 16 * 2, sample);
}

float lift_for(const Scene& scene) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Shape& shape : shapes_of(scene))
    smallest = std::min(smallest, ball_around(bounds_of(shape)).radius);
  return static_cast<float>(1e-3 * smallest);
}

void secondary_rays(const Tracer& tracer, std::span<const Ray<float>> rays,
                    std::span<const FirstHit> hits, float lift,
                    const std::optional<Vec3<float>>& towards, std::uint64_t seed,
                    SecondaryRays& secondary) {
  secondary.rays.clear();
  secondary.leaves.clear();
  secondary.from.clear();
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].found()) continue;
    const Vec3<float> n = tracer.world_normal(hits[i]);
    Vec3<float> direction;
    if (towards) {
      direction = *towards;
      if (!(n.dot(direction) > 0)) continue;
    } else {
      // A point of the unit sphere that touches the surface: its direction from there.
      Sampler sampler(seed, static_cast<int>(i), 0, 0);
      const std::array<double, 2> u = sampler.next();
      const double z = 1 - 2 * u[0], r = std::sqrt(std::max(0.0, 1 - z * z));
      const double phi = 2 * std::numbers::pi * u[1];
      const Vec3<float> on_sphere =
          Vec3<double>(r * std::cos(phi), r * std::sin(phi), z).cast<float>();
      // The pole opposite the normal would have no direction.
      direction = n + 0.9999f * on_sphere;
      direction.normalize();
    }
    secondary.rays.push_back({rays[i].at(hits[i].t) + lift * n, direction});
    secondary.leaves.push_back(hits[i].instance);
    secondary.from.push_back(static_cast<std::uint32_t>(i));
  }
}

std::vector<PixelRect> tiles_of(const Resolution& resolution) {
  std::vector<PixelRect> tiles;
  for (int y = 0; y < resolution.height; y += tile_side)
    for (int x = 0; x < resolution.width; x += tile_side)
      tiles.push_back({x, y, std::min(x + tile_side, resolution.width),
                       std::min(y + tile_side, resolution.height)});
  return tiles;
}

}  // namespace minkray::bench
