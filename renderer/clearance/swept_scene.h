// SPDX-License-Identifier: MIT
// A scene of swept bodies that contain all that a robot's links pass over.
#pragma once

#include "renderer/clearance/step_motion.h"
#include "renderer/import/model/import_options.h"
#include "renderer/json/mistakes.h"

namespace minkray {

struct SweptSceneOptions {
  /// Steps are cut into enough parts that no body exceeds its contents by more than this, relative
  /// to the body's own size.
  double slack = 0.01;
  std::size_t most_parts = 64;  ///< of one step
  /// A scene of more is a mistake: a path of a few megabytes could request a thousand million.
  std::size_t most_bodies = 1'000'000;
};

/// One object for each shape and part of a step. Each provably holds the link all through its
/// part; shapes that do not move occur once.
Scene swept_scene(Model model, const ImportOptions& import, const JointPath& path,
                  const SweptSceneOptions& options, Mistakes& mistakes);

}  // namespace minkray
