// SPDX-License-Identifier: MIT
// Lines of the page's casts, one JSON object each: a shape's meshes ("kind": "shape"), the mesh
// around a triangle ("body"), a ray's replay ("ray"), a pair of objects ("pair"). Shapes and bodies
// come once, before the first ray at them.
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

  /// The lines of a cast at a part. `solver` is its number on the page.
  std::string ray(const SceneCasts& casts, std::size_t solver, const ShownPart& part,
                  const PixelRay& pixel);

 private:
  /// The number of the part's shape. Adds its line, unless it is known.
  std::size_t shape_of(const SceneCasts& casts, const ShownPart& part, std::string& lines);
  std::size_t number_of(const Json& mesh, std::string& lines);
  /// The number of the mesh around a triangle.
  std::size_t body_of(const SceneCasts& casts, const ShownPart& part, std::string& lines);

  int directions_;
  std::map<std::uint32_t, std::size_t> shape_of_definition_;
  std::map<std::string, std::size_t> shape_of_mesh_;  ///< by its text: many objects are alike
  std::map<const TriangleMesh*, std::size_t> bodies_;
};

}  // namespace minkray
