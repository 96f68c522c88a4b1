// SPDX-License-Identifier: MIT
// A shape that holds another one all along a motion: the hull of the two ends, rounded by how far a
// point's path can be from the straight line between its ends. A path that accelerates by no more
// than a is, in a unit of time, within a / 8 of it; a body that turns by theta about an axis, no
// point of it further away than rho, within rho theta^2 / 8. The hull of the two ends alone does
// not hold what turns.
#pragma once

#include "core/math/affine.h"
#include "core/shape/shape.h"

namespace minkray {

/// All of the shape at the times from 0 to 1, if no point of it accelerates by more than that. The
/// poses are any invertible maps.
Shape<double> swept(const Shape<double>& shape, const Affine<double>& from,
                    const Affine<double>& to, double acceleration);

/// The motion is the screw-like one of RigidMotion: the origin of the shape's frame goes straight,
/// and about it the shape turns at a constant speed, by the smaller angle. The poses are rigid.
Shape<double> swept(const Shape<double>& shape, const Affine<double>& from,
                    const Affine<double>& to);

/// No point of the shape is further from the line through the origin along the unit vector `axis`;
/// 1 % more than is needed at most.
double distance_from_axis(const Shape<double>& shape, const Vec3<double>& axis);

}  // namespace minkray
