// SPDX-License-Identifier: MIT
// Runs the Embree sandwich for every object of a scene, for `minkray compare`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/compare/sandwich_check.h"
#include "renderer/image/image.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/scene/scene.h"

namespace minkray {

struct ObjectComparison {
  std::string name;
  std::string shape;  ///< kind of the shape
  CompareReport report;
};

/// Results of the camera's rays: per pixel, for the nearest object, the distance between the two
/// meshes there, as a length in units of the object's size.
struct DifferencePicture {
  int width = 0, height = 0;
  std::vector<double> t;        ///< infinite where nothing is hit
  std::vector<float> gap;       ///< infinite where the inner mesh is missed, 0 where t is infinite
  std::vector<bool> violation;  ///< any object's
};

struct SceneComparison {
  std::vector<ObjectComparison> objects;
  DifferencePicture difference;  ///< empty unless requested

  int violations() const;
  int pixel_violations() const;
  std::int64_t rays() const;
  /// False hits and false misses.
  double disagreements_per_million() const;
};

struct CompareSceneOptions {
  CompareOptions object;
  /// If not zero, the picture as well, with one ray a pixel.
  Resolution picture = {0, 0};
};

/// Adds a mistake for each object that reaches too far to be compared: its rays begin three sizes
/// away, and nothing is larger than the largest number.
void find_incomparable(const Scene& scene, Mistakes& mistakes);

/// progress(fraction, rays) may stop the rest by returning false; the answer is then not complete.
SceneComparison compare_scene(const Scene& scene, const CompareSceneOptions& options,
                              const std::function<bool(double, std::uint64_t)>& progress = {});

/// A line an object, worst first beyond `most_lines`, and a line for all.
std::string comparison_table(const SceneComparison& comparison, std::size_t most_lines = 60);

Json comparison_json(const SceneComparison& comparison);

/// The gaps in colours on a logarithmic scale, violations marked.
Image difference_image(const DifferencePicture& difference);

/// Red: gap, green: t, blue: 1 where violated.
Image difference_numbers(const DifferencePicture& difference);

}  // namespace minkray
