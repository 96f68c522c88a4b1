// SPDX-License-Identifier: MIT
// MJCF, MuJoCo's models (https://mujoco.readthedocs.io/en/2.2.2/XMLreference.html): bodies, joints
// and geoms, with includes, defaults, composites and keyframes. Actuators, sensors and the like
// have no shape; they are counted and ignored.
#pragma once

#include "renderer/import/model/import_options.h"
#include "renderer/import/model/model.h"
#include "renderer/import/model/xml.h"

namespace minkray {

Model read_mjcf(XmlElement root, XmlFiles& files, const ImportOptions& options);

}  // namespace minkray
