// SPDX-License-Identifier: MIT
// Data shared by instances of one definition: the definition, and the frame in which rays are cast
// at it (the body's frame). Each InstancePlace stores the map from the world to this frame.
#pragma once

#include <memory>

#include "core/model/shape_definition.h"
#include "core/screen/screen.h"

namespace minkray {

/// The axes of the body's frame are those of the definition's inner frame, the frame of the shape
/// without its outer transforms (ShapeDefinition). The origin is that of the shape's own frame if
/// `is_plain`; otherwise the centre of the inner shape's bounding ball.
struct InstanceBody {
  std::shared_ptr<const ShapeDefinition> definition;
  std::uint32_t number = 0;                    ///< number of the definition
  Vec3<double> centre = Vec3<double>::Zero();  ///< inner ball's centre in the body's frame
  bool is_centred = true;                      ///< centre is zero
  bool is_turned = false;                      ///< the map is not the identity
  bool is_plain = false;  ///< the pose keeps lengths, and no outer map was removed
  bool is_wide = false;   ///< the map has numbers that do not fit in float
};

}  // namespace minkray
