// SPDX-License-Identifier: MIT
// Lines of the page's casts, one JSON object each: a shape's meshes ("kind": "shape"), a ray's
// replay ("ray"), a pair of objects ("pair"). A shape comes once, before its first ray.
#pragma once

#include <map>
#include <string>

#include "renderer/inspect/scene_casts.h"
#include "renderer/json/json.h"

namespace minkray {

/// A ray of the picture: the pixel, and where it passes through it.
struct PixelRay {
  double x, y;  ///< pixel centres lie at halves
  Ray<double> ray;
};

class ReplayLines {
 public:
  /// `directions` are those of the meshes.
  explicit ReplayLines(int directions) : directions_(directions) {}

  /// The lines of a cast at an instance. `solver` is its number on the page.
  std::string ray(const SceneCasts& casts, std::size_t solver, std::size_t instance,
                  const PixelRay& pixel);

 private:
  int directions_;
  std::map<std::uint32_t, std::size_t> shape_of_definition_;
  std::map<std::string, std::size_t> shape_of_mesh_;  ///< by its text: many objects are alike
};

}  // namespace minkray
