// SPDX-License-Identifier: MIT
// Other people's ray casters, one source file each.
#pragma once

#include "bench/peers/peer.h"
#include "bench/tessellate.h"

namespace minkray::bench {

/// Bullet's three casts of a point at a convex shape, each with Bullet's default margins and with
/// none. Nothing for shapes that it does not have.
Peers bullet(const Shape& shape);

/// Embree on triangles, one ray and eight rays at a time; `label` names the mesh.
Peers embree_triangles(const TriangleMesh& mesh, const std::string& label);

/// Embree's own sphere and round curve, one ray and eight at a time. Nothing for other shapes.
Peers embree_own(const Shape& shape);

/// MuJoCo and the Open Dynamics Engine, in double. Nothing for shapes that they do not have.
Peers mujoco(const Shape& shape);
Peers ode(const Shape& shape);

/// The shortest formula that there is for a shape, in float: the limit.
Peers closed_forms(const Shape& shape);

}  // namespace minkray::bench
