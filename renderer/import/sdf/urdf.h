// SPDX-License-Identifier: MIT
// URDF, the robot description of ROS (http://wiki.ros.org/urdf/XML). Capsules, which URDF lacks,
// are read with the cylinder's "radius" and "length". Elements without geometry, such as
// transmissions and plugins, are ignored; unknown geometry is an error.
#pragma once

#include "renderer/import/model/import_options.h"
#include "renderer/import/model/model.h"
#include "renderer/import/model/xml.h"

namespace minkray {

Model read_urdf(XmlElement robot, XmlFiles& files, const ImportOptions& options);

}  // namespace minkray
