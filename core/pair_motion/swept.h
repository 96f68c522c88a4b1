// SPDX-License-Identifier: MIT
// A shape that contains another shape throughout a motion: the hull of the shape at both ends,
// grown by the largest distance of a point's path from the line between its ends. This distance is
// at most a / 8 for an acceleration of at most a over a unit of time, and rho theta^2 / 8 for a
// turn by theta with all points within rho of the axis.
#pragma once

#include "core/math/affine.h"
#include "core/shape/shape.h"

namespace minkray {

/// Returns a shape that contains the given shape at all times from 0 to 1, if none of its points
/// accelerates by more than `acceleration`. Poses may be any invertible maps.
Shape swept(const Shape& shape, const Affine<double>& from, const Affine<double>& to,
            double acceleration);

/// Same for a motion as in RigidMotion: the origin of the shape's frame moves along a line, and the
/// shape turns about this origin at a constant rate, by the smaller angle. Poses must be rigid.
Shape swept(const Shape& shape, const Affine<double>& from, const Affine<double>& to);

/// Returns an upper bound, at most 1 % too large, of the distance of the shape's points from the
/// line through the origin along the unit vector `axis`.
double distance_from_axis(const Shape& shape, const Vec3<double>& axis);

}  // namespace minkray
