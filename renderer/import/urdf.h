// SPDX-License-Identifier: MIT
// URDF, the robot description of ROS: http://wiki.ros.org/urdf/XML. Capsules, which it has not, are
// read as "radius" and "length" of the cylinder. What is no geometry, such as transmissions and
// plugins, is passed over; unknown geometry is a mistake.
#pragma once

#include "renderer/import/import_options.h"
#include "renderer/import/model.h"
#include "renderer/import/xml.h"

namespace minkray {

Model read_urdf(XmlElement robot, XmlFiles& files, const ImportOptions& options);

}  // namespace minkray
