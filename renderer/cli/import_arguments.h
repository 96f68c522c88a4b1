// SPDX-License-Identifier: MIT
// What all verbs take that take a scene: how a robot's file is made one.
#pragma once

#include "renderer/import/import_options.h"

namespace minkray {

class Verb;

/// The help of the argument itself.
inline constexpr const char* scene_argument =
    "A scene file (JSON), the name of a scene that comes with Minkray, or a robot's file: MJCF "
    "(.xml, .mjcf), URDF (.urdf), SDF (.sdf, .world), glTF (.gltf, .glb)";

/// The geometry that `options` has is the default. `rows`: whether a file of joints' values is one
/// of them.
void add_import_options(const Verb& verb, ImportOptions& options, bool rows = true);

}  // namespace minkray
