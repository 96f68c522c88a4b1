// SPDX-License-Identifier: MIT
// The comparisons of whole scenes, and their options.
#pragma once

#include <string>
#include <vector>

namespace minkray::bench {

struct ImageBenchOptions {
  std::vector<std::string> parts = {"scenes", "build", "memory", "hulls", "threads", "povray"};
  std::string kind = "rounded-boxes";
  std::size_t objects = 100000;
  std::size_t build_objects = 1000000;
  std::size_t rays = 200000;
  int rounds = 3;
  int width = 1920, height = 1080, samples = 1;
  std::vector<double> mesh_errors = {1e-4, 1e-6};
  std::size_t growth_from = 100, growth_to = 1000000;
  std::string json, plot, minkray;
  int threads = 1;
};

/// Runs the selected comparisons, prints them and writes the requested files.
void run_image_bench(const ImageBenchOptions& options);

}  // namespace minkray::bench
