// SPDX-License-Identifier: MIT
// A robot, what it carries and what is around it, ready for the referee: bodies with their owners'
// names, and the pairs that must not collide.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/clearance/allowed_pairs.h"
#include "renderer/import/import_options.h"
#include "renderer/plan/planning_scene.h"
#include "renderer/scene/scene.h"
#include "renderer/verify/referee.h"

namespace minkray {

struct WorkcellOptions {
  GeometryChoice geometry = GeometryChoice::collision;
  /// By how much all links are grown, for obstacles alone, as MoveIt does.
  double padding = 0;
  std::map<std::string, double> inflate = {};  ///< the same for single links, instead of `padding`
  bool only_obstacles = false;
};

struct Workcell {
  /// What is carried are links of it, obstacles of planning scenes shapes of no link.
  Model model;
  std::vector<Scene> scenes;  ///< obstacles of other files
  std::vector<ClearanceBody> bodies;
  std::vector<std::string> owners;  ///< of each body: a link or an object
  std::vector<RefereePair> pairs;
  GeometryChoice geometry = GeometryChoice::collision;  ///< which of the model's shapes are bodies
};

/// Adds the objects of a planning scene to the model of a robot that stands where the scene says.
/// Planes are turned so that the robot's root is on their free side. Frames and links that are not
/// there are mistakes.
void add_to_model(const PlanningScene& scene, Model& model, Mistakes& mistakes);

/// `planning` may be null. A matrix in it takes the place of `allowed`. Throws BadInput if there
/// are too many pairs.
Workcell workcell_of(Model model, std::vector<Scene> scenes, const PlanningScene* planning,
                     const AllowedPairs& allowed, const WorkcellOptions& options);

}  // namespace minkray
