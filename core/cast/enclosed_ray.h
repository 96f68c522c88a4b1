// SPDX-License-Identifier: MIT
// Computes an upper bound of the parameter at which a ray enters a shape, from three support points
// that the ray passes between.
#pragma once

#include "core/cast/cast.h"
#include "core/query/ray_near_ball.h"

namespace minkray {

/// Sets the upper bound of a hit's t if the solver has not set it. Uses support points in
/// directions tilted slightly from the hit's normal. On a flat face, these are the corners of the
/// face. If the radius of curvature is rho, the support point for a tilt delta is rho * delta away
/// from the hit and rho * delta^2 below it. If these points are too far away, refines their
/// triangle like a portal (G. Snethen, "XenoCollide", 2008). The bound stays infinite if the ray
/// passes within rounding of an edge. The ray and the normal are in the shape's inner frame.
void enclose_ray(const PreparedShape& shape, const RayNearBall<double>& near,
                 const Vec3<double>& normal, CastResult<double>& hit);

}  // namespace minkray
