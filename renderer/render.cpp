// SPDX-License-Identifier: MIT
#include "renderer/render.h"

#include "renderer/camera.h"
#include "renderer/filter.h"

namespace minkray {

RenderWorld make_world(const Scene& scene, const CastOptions<Real>& options) {
  std::vector<PreparedShape<Real>> instances;
  instances.reserve(scene.objects.size());
  for (const Object& object : scene.objects) instances.emplace_back(object.shape, object.pose);
  return RenderWorld(std::move(instances), options);
}

Rendering render(const Scene& scene, const RenderWorld& world, const RenderOptions& options,
                 const RenderWatch& watch) {
  const Camera camera(scene.camera, options.resolution);
  const PixelFilter filter;
  const Integrator integrator(scene, world, options.integrator);
  const PixelRect part = options.part();

  Rendering rendering;
  Image& image = rendering.image = Image(part.width(), part.height());
  const auto render_pixel = [&](int x, int y, RayCounts& counts) {
    Colour sum = Colour::Zero();
    for (int sample = 0; sample < options.samples && !watch.stopped(); ++sample) {
      Sampler sampler(options.seed, x, y, static_cast<std::uint32_t>(sample));
      const std::array<double, 2> u = sampler.next();
      const Ray<Real> ray =
          camera.ray(x + 0.5 + filter.offset(u[0]), y + 0.5 + filter.offset(u[1]));
      sum += integrator.radiance(ray, sampler, counts);
    }
    return Colour(sum / options.samples);
  };
  rendering.complete = for_tiles(part, rendering.counts, watch, [&](const PixelRect& tile) {
    RayCounts counts;
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        image.at(x - part.x0, y - part.y0) = render_pixel(x, y, counts).cast<float>();
    return counts;
  });
  return rendering;
}

}  // namespace minkray
