// SPDX-License-Identifier: MIT
// Materials of a mesh's parts: those that its scene names, or its file's own.
#pragma once

#include "renderer/json/object_reader.h"
#include "renderer/member_json/mesh_files.h"
#include "renderer/scene/scene.h"
#include "renderer/scene_json/material_names.h"

namespace minkray {

/// Returns the look of a mesh; null if it has neither attributes nor materials of its own. With
/// `takes_file`, materials that the scene does not name are those of the file. `path` is the
/// mesh's.
std::shared_ptr<const MeshLook> look_of(const SceneMesh& mesh, bool takes_file, Scene& scene,
                                        MaterialNames& materials, MeshFiles& files,
                                        const JsonPath& path, Mistakes& mistakes);

/// Checks an object's materials: a texture by coordinates needs a mesh that has them for all
/// triangles, and parts that let light through must be all of one material.
void check_look(const Scene& scene, const Object& object, const JsonPath& path, Mistakes& mistakes);

}  // namespace minkray
