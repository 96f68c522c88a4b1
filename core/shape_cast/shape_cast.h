// SPDX-License-Identifier: MIT
// Continuous collision detection of two shapes that move without turning (van den Bergen, 2004,
// sections 1 and 4). B moves by t * direction relative to A, and meets A at the least t for which
// t * direction lies in the configuration space obstacle A - B (both at t = 0). This is a ray cast,
// for any solver. The obstacle is relative to the two shapes' centres, so precision does not depend
// on their positions in the world.
#pragma once

#include "core/cast/cast.h"
#include "core/model/centred_shape.h"

namespace minkray {

/// The obstacle A - B of two shapes, prepared for casts with any positions of their centres.
template <class T>
class PreparedPair {
 public:
  /// A is the obstacle and B the moving shape, with their poses at t = 0.
  PreparedPair(const CentredShape<T>& a, const CentredShape<T>& b)
      : a_(a),
        b_(b),
        obstacle_(Shape<T>(
            MinkowskiDifference<T>{Nested<T>(a.about_centre), Nested<T>(b.about_centre)})) {}

  const CentredShape<T>& a() const { return a_; }
  const CentredShape<T>& b() const { return b_; }
  const PreparedShape<T>& obstacle() const { return obstacle_; }

  /// Moves the shapes without changing their orientations.
  void place(const Vec3<T>& centre_a, const Vec3<T>& centre_b) {
    a_.centre = centre_a;
    b_.centre = centre_b;
  }

 private:
  CentredShape<T> a_, b_;
  PreparedShape<T> obstacle_;
};

template <class T>
struct ShapeCastResult {
  /// Status, time of impact with its bounds, and cost. Hit: the normal is A's outward normal at the
  /// contact, in the world. Miss: the normal of a plane that separates B from A at all times.
  /// Inside: zero.
  CastResult<T> cast;
  /// Hit: the contact points on A, and on B at the time of impact, in the world. The two differ by
  /// rounding, more for grazing contacts. Inside: a common point at t = 0.
  Vec3<T> point_a = Vec3<T>::Zero();
  Vec3<T> point_b = Vec3<T>::Zero();
};

/// Finds the first contact with 0 <= t <= t_max. B moves by t * direction. Shapes that overlap or
/// touch at the start are `inside`. The direction may be zero or subnormal; the result is then
/// `inside` or a miss.
template <class T>
ShapeCastResult<T> cast_shape(const PreparedPair<T>& pair, const Vec3<T>& direction,
                              T t_max = std::numeric_limits<T>::infinity(),
                              const CastOptions<T>& options = {},
                              const CastObserver<T>& observer = {});

/// Same for two shapes that move, each with its velocity, at times from 0 to `duration`.
template <class T>
ShapeCastResult<T> cast_shapes(const PreparedPair<T>& pair, const Vec3<T>& velocity_a,
                               const Vec3<T>& velocity_b, T duration,
                               const CastOptions<T>& options = {});

}  // namespace minkray
