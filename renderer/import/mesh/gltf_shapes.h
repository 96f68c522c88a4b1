// SPDX-License-Identifier: MIT
// KHR_implicit_shapes: spheres, boxes, capsules and cylinders in closed form, as colliders
// (KHR_physics_rigid_bodies) name them.
// https://github.com/eoineoineoin/glTF_Physics/tree/master/extensions/2.0/Khronos/KHR_implicit_shapes
#pragma once

#include <optional>

#include "renderer/import/mesh/gltf_document.h"
#include "renderer/import/model/model.h"

namespace minkray {

/// A shape of our own, whose axis is z, and the pose that brings it to glTF's, whose axis is y.
struct GltfShape {
  std::string kind;
  std::optional<Shape> shape;  ///< none: the half-space under z = 0
  Affine<double> pose;
};

/// The shape of that number; nothing, and a mistake, if there is none or it is wrong.
std::optional<GltfShape> gltf_shape(GltfDocument& document, const Json& number,
                                    const JsonPath& asks);

}  // namespace minkray
