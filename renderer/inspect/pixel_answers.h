// SPDX-License-Identifier: MIT
// Data that the page shows for each pixel: the cast that `minkray trace` prints, and the cost of
// its ray with each solver.
#pragma once

#include "renderer/film/render.h"
#include "renderer/inspect/planes.h"
#include "renderer/inspect/scene_casts.h"

namespace minkray {

/// Data of the cast that the page shows at a pixel, by the first solver.
struct ShownCast {
  std::uint32_t object = 0;      ///< 1 + the instance; 0: no cast is shown
  std::uint32_t part = no_part;  ///< number of the triangle, if the instance is a mesh
  bool has_steps = false;        ///< the cast can be replayed
  std::uint8_t status = 0;       ///< index in heat_statuses
  double t = 0;
  double below = 0, above = 0;  ///< distance of the bounds of t from it
  Vec3<double> normal = Vec3<double>::Zero();
  int iterations = 0, supports = 0;

  ShownPart shown() const { return {std::size_t{object} - 1, part}; }
};

/// Work of that cast by one of the solvers.
struct ShownWork {
  int iterations = 0, supports = 0;
};

/// Total cost of a pixel's ray, by one solver.
struct RayCost {
  QueryCounts work;
  Path last_path = Path::filter;
  double nanoseconds = 0;  ///< the least of some tries
};

struct PixelAnswers {
  Resolution resolution;
  std::vector<ShownCast> shown;  ///< by pixel, in rows
  std::vector<std::vector<ShownWork>>
      work;  ///< of the cast that is shown; by solver, then by pixel
  std::vector<std::vector<RayCost>> of_ray;  ///< the same of the whole ray
  bool complete = false;
};

/// Casts the rays through the centres of all pixels; all threads.
PixelAnswers measure_pixels(const Scene& scene, const std::vector<const SceneCasts*>& solvers,
                            const Resolution& resolution, const RenderWatch& watch);

/// The cast that is shown for a ray: the page's data of a pixel.
ShownCast shown_cast(const SceneCasts& casts, const Ray<double>& ray, std::size_t most_looked_at);

/// Number of instances searched for the hardest miss of a pixel in a picture, and of a single one.
inline constexpr std::size_t most_looked_at_in_picture = 400;
inline constexpr std::size_t most_looked_at_alone = 1000000;

PackedPlanes packed(const PixelAnswers& answers);

}  // namespace minkray
