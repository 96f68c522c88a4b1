// SPDX-License-Identifier: MIT
// Continuous collision detection of turning bodies by the approximation of van den Bergen (2004),
// section 1: orientations change in fixed steps, positions are interpolated.
#pragma once

#include "core/shape_cast/shape_cast.h"

namespace minkray {

template <class T>
struct MovingBody {
  Shape<T> shape;
  Affine<T> pose;  ///< at time 0, from the shape's frame to the world; its translation is the pivot
  Vec3<T> velocity = Vec3<T>::Zero();          ///< of the pivot
  Vec3<T> angular_velocity = Vec3<T>::Zero();  ///< about the pivot, radians per unit of time
};

template <class T>
struct RotatingCastResult {
  Status status = Status::exhausted;
  T t = T(0);               ///< the approximation's first contact
  T t_lo = T(0);            ///< no true contact before this time
  bool proven = false;      ///< the miss also holds for the true motion
  T position_error = T(0);  ///< bound of the true bodies' gap, or overlap, at t
  Vec3<T> point_a = Vec3<T>::Zero(), point_b = Vec3<T>::Zero(), normal = Vec3<T>::Zero();
  int steps = 0;  ///< number of steps that were cast
  int iterations = 0;
  int supports = 0;
};

/// Finds the first contact of A and B at times from 0 to duration, in `steps` equal steps.
///
/// Within a step of length h, each orientation is that of the step's middle. The error of a point
/// at distance rho from its body's pivot is at most 2 rho sin(|omega| h / 4) <= rho |omega| h / 2;
/// `position_error` is the sum for the two bodies. A second cast uses the obstacle grown by
/// position_error, whose first contact is never later than the true contact. So t_lo is a proven
/// bound, and t is the result of the approximation.
template <class T>
RotatingCastResult<T> cast_rotating(const MovingBody<T>& a, const MovingBody<T>& b, T duration,
                                    int steps, const CastOptions<T>& options = {});

/// The pose of a body at a time.
template <class T>
Affine<T> pose_at(const MovingBody<T>& body, T time);

}  // namespace minkray
