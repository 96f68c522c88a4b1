// SPDX-License-Identifier: MIT
// Continuous collision detection of turning bodies by the approximation of van den Bergen (2004),
// section 1: orientations change at fixed steps, positions are interpolated.
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
  T t_lo = T(0);            ///< no true contact before this; a miss: none at all if `proven`
  bool proven = false;      ///< a miss holds for the true motion too
  T position_error = T(0);  ///< bound on the true bodies' gap, or overlap, at t
  Vec3<T> point_a = Vec3<T>::Zero(), point_b = Vec3<T>::Zero(), normal = Vec3<T>::Zero();
  int steps = 0;  ///< that were cast
  int iterations = 0;
  int supports = 0;
};

/// The first contact of A and B over the times 0 to duration, in `steps` equal steps.
///
/// Within a step, each orientation is that of the step's middle. So a point at distance rho from
/// its body's pivot is off by at most 2 rho sin(|omega| h / 4) <= rho |omega| h / 2, h the step's
/// length; `position_error` is the sum for the two bodies. The cast is repeated with the obstacle
/// grown by position_error, whose first contact is never later than the true one. So t_lo is
/// rigorous; t is that of the approximation.
template <class T>
RotatingCastResult<T> cast_rotating(const MovingBody<T>& a, const MovingBody<T>& b, T duration,
                                    int steps, const CastOptions<T>& options = {});

/// The pose of a body at a time.
template <class T>
Affine<T> pose_at(const MovingBody<T>& body, T time);

}  // namespace minkray
