// SPDX-License-Identifier: MIT
// Names and colours of a COLLADA file's meshes.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/import/model/mesh_looks.h"
#include "renderer/import/model/xml.h"

namespace minkray {

/// Follows the reference of an element's attribute; null if it leads nowhere.
using ColladaTarget = std::function<const XmlElement*(const XmlElement&, std::string_view key)>;

/// Finds an element by its id; null if there is none.
using ColladaById = std::function<const XmlElement*(const std::string& id)>;

/// The effect bound to a material's symbol; null if there is none.
const XmlElement* collada_effect(const XmlElement& instance, const std::string& symbol,
                                 const ColladaTarget& target);

/// An effect's diffuse colour or picture, whose file is looked for in the folder.
std::optional<MeshMaterial> collada_material(const XmlElement& effect, const ColladaById& with_id,
                                             const ColladaTarget& target, XmlFiles& files,
                                             const std::filesystem::path& folder);

/// Name of an element: its name, or its id.
std::string collada_name(const XmlElement& element);

/// The look of a geometry as `instance`, if any, binds its materials.
PartLook collada_look(std::vector<std::string> names, const XmlElement& geometry,
                      const XmlElement* instance, const ColladaTarget& target, XmlFiles& files);

}  // namespace minkray
