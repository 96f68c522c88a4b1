// SPDX-License-Identifier: MIT
// Data shared by instances of one definition: the definition, and the frame to which the instances'
// poses map (InstancePlace).
#pragma once

#include <memory>

#include "core/model/shape_definition.h"
#include "core/screen/screen.h"

namespace minkray {

/// InstancePlace maps the world to the body's frame: the inner frame of the definition. Its origin
/// is that of the shape's own frame if the body is plain, else the inner ball's centre.
struct InstanceBody {
  std::shared_ptr<const ShapeDefinition> definition;
  std::uint32_t number = 0;                    ///< number of the definition
  Vec3<double> centre = Vec3<double>::Zero();  ///< of the inner ball, in the body's frame
  bool is_centred = true;                      ///< centre is zero
  bool is_turned = false;                      ///< the map is not the identity
  bool is_plain = false;  ///< the pose keeps lengths, and no outer map was removed
  bool is_wide = false;   ///< the map has numbers that do not fit in float
};

}  // namespace minkray
