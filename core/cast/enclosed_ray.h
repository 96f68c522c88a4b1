// SPDX-License-Identifier: MIT
// An upper bound of where a ray enters a shape: three support points that the ray passes between.
#pragma once

#include "core/cast/cast.h"
#include "core/query/ray_near_ball.h"

namespace minkray {

/// Sets a hit's upper bound of t if its solver has not, by support points in directions tilted
/// slightly from the hit's normal. On a flat face these are its corners; on a patch with radius of
/// curvature rho, a tilt delta gives points rho * delta from the hit and rho * delta^2 under it. If
/// these are far, the triangle is refined as portals are (G. Snethen, "XenoCollide", 2008). The
/// bound stays infinite if the ray passes an edge to within rounding. The ray and the normal are in
/// the shape's inner frame.
void enclose_ray(const PreparedShape& shape, const RayNearBall<double>& near,
                 const Vec3<double>& normal, CastResult<double>& hit);

}  // namespace minkray
