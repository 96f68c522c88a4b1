// SPDX-License-Identifier: MIT
// Terrains of MJCF: an <hfield>'s picture, binary file or numbers, as a solid with walls and a
// bottom, as MuJoCo's rays see it.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "core/mesh/triangle_mesh.h"
#include "renderer/import/model/xml.h"

namespace minkray {

/// `find` returns the file that a name refers to. Null, and a mistake, if anything is wrong.
std::shared_ptr<const TriangleMesh> mjcf_height_field(
    const XmlElement& asset, XmlFiles& files,
    const std::function<std::optional<std::filesystem::path>(const std::string&)>& find);

}  // namespace minkray
