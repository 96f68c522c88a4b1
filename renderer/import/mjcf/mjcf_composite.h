// SPDX-License-Identifier: MIT
// Bodies of an MJCF <composite> as in MuJoCo 2.2.2: particles, grids, ropes, loops, cloths, and
// boxes, cylinders and ellipsoids with a soft shell.
#pragma once

#include <array>
#include <functional>

#include "renderer/import/model/model.h"
#include "renderer/import/model/xml.h"

namespace minkray {

/// Adds links, joints and geoms. `body`: the link around it, -1 for the world. `material`: the
/// colour of a material.
void add_composite(Model& model, int body, const XmlElement& composite, XmlFiles& files,
                   const std::function<std::array<double, 4>(const XmlElement& geom)>& colour_of);

}  // namespace minkray
