// SPDX-License-Identifier: MIT
// Names and colours of a COLLADA file's meshes.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/import/mesh_looks.h"
#include "renderer/import/xml.h"

namespace minkray {

/// Follows the reference of an element's attribute; null if it leads nowhere.
using ColladaTarget = std::function<const XmlElement*(const XmlElement&, std::string_view key)>;

/// Name of an element: its name, or its id.
std::string collada_name(const XmlElement& element);

/// The look of a geometry as `instance`, if any, binds its materials.
PartLook collada_look(std::vector<std::string> names, const XmlElement& geometry,
                      const XmlElement* instance, const ColladaTarget& target, XmlFiles& files);

}  // namespace minkray
