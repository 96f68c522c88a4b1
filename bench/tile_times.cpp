// SPDX-License-Identifier: MIT
// tile-times SCENE WIDTH HEIGHT SAMPLES: how long each tile of a picture takes, on one thread, for
// bench/simulate-cores. Lines out, in the order in which tiles are rendered: "tile COLUMN ROW
// SECONDS".
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>

#include "core/parallel/parallel.h"
#include "renderer/film/render.h"
#include "renderer/scene_json/scene_json.h"

namespace {

using namespace minkray;
using Clock = std::chrono::steady_clock;

int print_times(char** argv) {
  const Scene scene = load_scene(argv[1]);
  const World world = make_world(scene);
  RenderOptions options;
  options.resolution = {std::stoi(argv[2]), std::stoi(argv[3])};
  options.samples = std::stoi(argv[4]);
  const TileGrid tiles(options.region());
  Clock::time_point last = Clock::now();
  RenderJournal journal;
  journal.finished = [&](const Rendering&, std::size_t tile) {
    const Clock::time_point now = Clock::now();
    std::printf("tile %zu %zu %.9f\n", tile % tiles.columns(), tile / tiles.columns(),
                std::chrono::duration<double>(now - last).count());
    last = Clock::now();
  };
  with_threads(1, [&] { render(scene, world, options, {}, std::move(journal)); });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("tile-times SCENE WIDTH HEIGHT SAMPLES\n", stderr);
    return 2;
  }
  try {
    return print_times(argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tile-times: %s\n", error.what());
    return 1;
  }
}
