// SPDX-License-Identifier: MIT
// Makes a mesh that is the image of another mesh under an affine map.
#pragma once

#include <memory>

#include "core/math/affine.h"
#include "core/mesh/triangle_mesh.h"

namespace minkray {

/// Returns the image of the mesh. The map need not be rigid. If it mirrors, triangles are flipped
/// to stay counter-clockwise as seen from outside.
std::shared_ptr<const TriangleMesh> mapped(const TriangleMesh& mesh, const Affine<double>& map);

}  // namespace minkray
