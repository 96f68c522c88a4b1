// SPDX-License-Identifier: MIT
// An upper bound of where a ray enters a shape: three support points that the ray passes between.
#pragma once

#include "core/cast/cast.h"
#include "core/query/ray_near_ball.h"

namespace minkray {

/// Bounds a hit's parameter from above where its solver has not, by support points in directions
/// tilted slightly from the hit's normal. A flat face gives its corners; a patch of curvature
/// radius rho and a tilt delta gives points rho * delta from the hit and rho * delta^2 under it.
/// Where that is far, the triangle is refined as portals are (G. Snethen, "XenoCollide", 2008).
/// Leaves the bound infinite where the ray passes an edge within rounding. The ray and the normal
/// are in the shape's inner frame.
void enclose_ray(const PreparedShape<double>& shape, const RayNearBall<double>& near,
                 const Vec3<double>& normal, CastResult<double>& hit);

}  // namespace minkray
