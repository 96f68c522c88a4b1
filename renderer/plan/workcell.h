// SPDX-License-Identifier: MIT
// A robot, the objects that it carries and its obstacles, prepared for the referee: bodies with the
// names of their owners, and the pairs that must not collide.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/clearance/allowed_pairs.h"
#include "renderer/import/model/import_options.h"
#include "renderer/plan/planning_scene.h"
#include "renderer/scene/scene.h"
#include "renderer/verify/referee.h"

namespace minkray {

struct WorkcellOptions {
  GeometryChoice geometry = GeometryChoice::collision;
  /// Growth of all links, only for distances to obstacles, as in MoveIt.
  double padding = 0;
  std::map<std::string, double> inflate = {};  ///< growth of single links, instead of `padding`
  bool only_obstacles = false;
};

struct Workcell {
  /// Carried objects are links of the model; obstacles of planning scenes are shapes without a
  /// link.
  Model model;
  std::vector<Scene> scenes;  ///< obstacles of other files
  std::vector<ClearanceBody> bodies;
  std::vector<std::string> owners;  ///< owner of each body: a link or an object
  std::vector<RefereePair> pairs;
  GeometryChoice geometry = GeometryChoice::collision;  ///< selects the model's shapes that become
                                                        ///< bodies
};

/// Adds the objects of a planning scene to the model of a robot in the scene's state. Flips planes
/// whose free side does not contain the robot's root. Unknown frames and links are mistakes.
void add_to_model(const PlanningScene& scene, Model& model, Mistakes& mistakes);

/// `planning` may be null. Its matrix replaces `allowed`. Throws BadInput if there are too many
/// pairs.
Workcell workcell_of(Model model, std::vector<Scene> scenes, const PlanningScene* planning,
                     const AllowedPairs& allowed, const WorkcellOptions& options);

}  // namespace minkray
