// SPDX-License-Identifier: MIT
// Parameters of an MJCF <composite>: its type, number of elements, spacing, and the geom of each
// element.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "renderer/import/model/model.h"
#include "renderer/import/model/xml.h"

namespace minkray {

/// The most that a file's composites may request, with all its geoms: fifty bytes of text make any
/// number of bodies, and a picture of this many still takes seconds.
inline constexpr double most_composite_elements = 100'000;

struct CompositePlan {
  std::string type, prefix;
  std::array<int, 3> count = {1, 1, 1};
  double spacing = 0;
  Vec3<double> offset = Vec3<double>::Zero();
  std::set<std::pair<int, int>> pins;  ///< places of a grid that do not move
  bool twists = false, stretches = false;
  std::vector<double> size;  ///< of the geom
  ModelGeom geom;            ///< without link, name and pose
  bool hides_skin = false;   ///< the geoms represent a skin, which is not shown

  /// Number of elements in a full block: a shell has fewer.
  double elements() const { return 1.0 * count[0] * count[1] * count[2]; }
  bool is_shell() const { return type == "box" || type == "cylinder" || type == "ellipsoid"; }
};

/// Reads a <composite>; nothing, and a mistake, if it is wrong.
std::optional<CompositePlan> read_composite(
    const XmlElement& element, XmlFiles& files,
    const std::function<std::array<double, 4>(const XmlElement& geom)>& colour_of);

}  // namespace minkray
