// SPDX-License-Identifier: MIT
// How far a body reaches along a direction: by it two bodies are kept apart by a plane, whatever
// their parts are.
#pragma once

#include "core/world/mesh_pairs.h"

namespace minkray {

/// The middle of a shape, or of the box of a mesh, in its frame.
Vec3<double> middle_of(const PartsBody& body);

/// No point of the body is further along the unit vector `n` than this, seen from its middle.
/// `linear` turns from the body's frame to that of n.
double reach_along(const PartsBody& body, const Mat3<double>& linear, const Vec3<double>& n);

}  // namespace minkray
