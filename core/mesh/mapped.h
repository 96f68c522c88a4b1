// SPDX-License-Identifier: MIT
// A mesh under an affine map.
#pragma once

#include <memory>

#include "core/math/affine.h"
#include "core/mesh/triangle_mesh.h"

namespace minkray {

/// The map need not be rigid. Where it mirrors, triangles are turned round: seen from outside they
/// would be clockwise.
std::shared_ptr<const TriangleMesh> mapped(const TriangleMesh& mesh, const Affine<double>& map);

}  // namespace minkray
