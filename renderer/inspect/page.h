// SPDX-License-Identifier: MIT
// The inspector's page: one HTML file with script, style and data, which needs no network.
#pragma once

#include <string>
#include <vector>

#include "renderer/film/render.h"
#include "renderer/inspect/pixel_answers.h"

namespace minkray {

struct InspectedSolver {
  std::string name;
  SceneCasts casts;
};

struct InspectOptions {
  std::string name;        ///< of the scene
  RenderOptions picture;   ///< options and size of the rendered picture
  std::size_t pairs = 12;  ///< of objects, whose distances can be replayed
  /// Largest size of the page. As many pixels can be replayed as fit; all else is included in any
  /// case.
  std::size_t most_bytes = 6'000'000;
  bool is_served = false;  ///< the page may request more from its server
};

/// The pixels' numbers as the page reads them: {"resolution", "planes", "names", "bytes"}, the last
/// in base64, packed.
Json view_json(const Scene& scene, const std::vector<InspectedSolver>& solvers,
               const PixelAnswers& answers);

/// The page, and how many of its pixels can be replayed.
struct InspectPage {
  std::string html;
  std::size_t pixels = 0, replayed = 0;
  bool complete = false;  ///< false if the watch stopped it; then the page is incomplete
};

/// The first of the solvers is the one whose answers are shown; there is at least one.
InspectPage inspect_page(const Scene& scene, const std::vector<InspectedSolver>& solvers,
                         const InspectOptions& options, const RenderWatch& watch);

}  // namespace minkray
