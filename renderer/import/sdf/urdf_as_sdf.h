// SPDX-License-Identifier: MIT
// Converts a URDF into an SDF <model>, for worlds that include robots. Links are where their joints
// at rest put them.
#pragma once

#include "renderer/import/model/xml.h"

namespace minkray {

/// The model of a <robot>. Mistakes in the robot's tree are reported.
XmlElement sdf_of_urdf(XmlElement robot, XmlFiles& files);

}  // namespace minkray
