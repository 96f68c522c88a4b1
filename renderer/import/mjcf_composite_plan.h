// SPDX-License-Identifier: MIT
// What an MJCF <composite> asks for: its type, how many elements, how far from each other, and the
// geom that each of them has.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "renderer/import/model.h"
#include "renderer/import/xml.h"

namespace minkray {

struct CompositePlan {
  std::string type, prefix;
  std::array<int, 3> count = {1, 1, 1};
  double spacing = 0;
  Vec3<double> offset = Vec3<double>::Zero();
  std::set<std::pair<int, int>> pins;  ///< places of a grid that do not move
  bool twists = false, stretches = false;
  std::vector<double> size;  ///< of the geom
  ModelGeom geom;            ///< without link, name and pose
  bool hides_skin = false;   ///< the geoms stand for a skin, which is not shown

  bool is_shell() const { return type == "box" || type == "cylinder" || type == "ellipsoid"; }
};

/// Reads a <composite>; nothing, and a mistake, if it is wrong.
std::optional<CompositePlan> read_composite(
    const XmlElement& element, XmlFiles& files,
    const std::function<std::array<double, 4>(const XmlElement& geom)>& colour_of);

}  // namespace minkray
