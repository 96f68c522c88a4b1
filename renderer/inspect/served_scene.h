// SPDX-License-Identifier: MIT
// Replies of `minkray inspect --serve` to its page: any ray, other solvers, tolerances and cameras,
// and progressive pictures. Uses only the scene as it was read.
#pragma once

#include <deque>

#include "renderer/inspect/loopback.h"
#include "renderer/inspect/page.h"

namespace minkray {

/// The page's requests, each with the view's values: "eye" and "at" (x,y,z each), "solver" and
/// "tolerance" of the first solver; those that are missing are the scene's.
///   ""        the page
///   cast      x, y: the lines (ReplayLines) of the cast that is shown there, by all solvers
///   pair      a, b: the line of two objects
///   picture   samples, zoom, window (x0,y0,x1,y1 in pixels of the zoomed picture): a PNG
/// view the data of each pixel, as in the page (view_json)
class ServedScene {
 public:
  /// All must outlive it. The page is what "" answers.
  ServedScene(const Scene& scene, const std::vector<InspectedSolver>& solvers,
              const InspectOptions& options, std::string page, RenderWatch watch)
      : scene_(scene),
        solvers_(solvers),
        options_(options),
        page_(std::move(page)),
        watch_(std::move(watch)) {}

  WebReply answer(const WebRequest& request);

 private:
  struct Asked;
  WebReply answer_or_throw(const WebRequest& request);
  /// The solvers with another one in the place of the first; the last few are kept.
  const std::vector<InspectedSolver>& solvers_for(const Asked& asked);
  WebReply cast(const Asked& asked);
  WebReply pair(const Asked& asked);
  WebReply picture(const Asked& asked);
  WebReply view(const Asked& asked);

  const Scene& scene_;
  const std::vector<InspectedSolver>& solvers_;
  const InspectOptions& options_;
  std::string page_;
  RenderWatch watch_;
  struct Kept {
    std::string solver;
    double tolerance;
    std::vector<InspectedSolver> solvers;
  };
  std::deque<Kept> kept_;
};

}  // namespace minkray
