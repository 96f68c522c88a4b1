// SPDX-License-Identifier: MIT
// minkray-image-bench: whole scenes, exact shapes compared with triangles, user geometry and
// POV-Ray.
//
// Ratios are other / ours: the factor by which Minkray (in float) is faster. Compared tracers are
// interleaved in one run. On one thread processor time is measured, on several the wall's clock.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "bench/image/image_bench.h"
#include "renderer/base/errors.h"

namespace {

using namespace minkray;
using namespace minkray::bench;

void read_arguments(CLI::App& app, ImageBenchOptions& options, const char* program) {
  options.minkray = std::filesystem::path(program).parent_path() / "minkray";
  app.add_option("--part", options.parts,
                 "Which: scenes, build, memory, hulls, threads, povray (all these by default); "
                 "casts, image, growth")
      ->check(CLI::IsMember(
          {"casts", "build", "memory", "hulls", "threads", "povray", "scenes", "image", "growth"}));
  app.add_option("--kind", options.kind, "Of the scene: of minkray generate, or rounded-hulls")
      ->capture_default_str();
  app.add_option("-n,--objects", options.objects)->capture_default_str();
  app.add_option("--build-objects", options.build_objects)->capture_default_str();
  app.add_option("--rays", options.rays, "Of casts")->capture_default_str();
  app.add_option("--rounds", options.rounds)->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--width", options.width)->check(CLI::Range(32, 32768))->capture_default_str();
  app.add_option("--height", options.height)->check(CLI::Range(32, 32768))->capture_default_str();
  app.add_option("--samples", options.samples)->check(CLI::Range(1, 1024))->capture_default_str();
  app.add_option("--mesh-errors", options.mesh_errors, "Of a shape's bounding radius");
  app.add_option("--growth-from", options.growth_from)->check(CLI::PositiveNumber);
  app.add_option("--growth-to", options.growth_to);
  app.add_option("--threads", options.threads, "Of image and growth")->check(CLI::Range(1, 1024));
  app.add_option("--json", options.json, "All figures into this file");
  app.add_option("--plot", options.plot, "How they grow, into this SVG file");
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int failed = 1, wrong_usage = 2, cannot_write = 4;
  ImageBenchOptions options;
  CLI::App app("Whole scenes: exact shapes beside triangles, user geometry and POV-Ray");
  read_arguments(app, options, argv[0]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : wrong_usage;
  }
  try {
    run_image_bench(options);
  } catch (const WrongUsage& error) {
    std::cerr << error.what() << "\n";
    return wrong_usage;
  } catch (const CannotWrite& error) {
    std::cerr << error.what() << "\n";
    return cannot_write;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return failed;
  }
  return 0;
}
