// SPDX-License-Identifier: MIT
// A URDF as the <model> of SDF that it means, for worlds that include robots: links stand where
// their joints at rest put them.
#pragma once

#include "renderer/import/xml.h"

namespace minkray {

/// The model of a <robot>. Mistakes of the robot's tree are told.
XmlElement sdf_of_urdf(XmlElement robot, XmlFiles& files);

}  // namespace minkray
