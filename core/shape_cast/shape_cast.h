// SPDX-License-Identifier: MIT
// Continuous collision detection of two shapes that move without turning: van den Bergen (2004),
// sections 1 and 4. B, moving by t * direction relative to A, meets A at the least t for which t *
// direction lies in the configuration space obstacle A - B (both at t = 0): a ray cast, which any
// of the solvers does. The obstacle is taken about the two shapes' centres, so that precision does
// not depend on their places in the world.
#pragma once

#include "core/cast/cast.h"
#include "core/model/centred_shape.h"

namespace minkray {

/// The obstacle A - B of two shapes, ready for casts with any placement of their centres.
template <class T>
class PreparedPair {
 public:
  /// A is the obstacle, B the shape that moves; their poses at t = 0.
  PreparedPair(const CentredShape<T>& a, const CentredShape<T>& b)
      : a_(a),
        b_(b),
        obstacle_(Shape<T>(
            MinkowskiDifference<T>{Nested<T>(a.about_centre), Nested<T>(b.about_centre)})) {}

  const CentredShape<T>& a() const { return a_; }
  const CentredShape<T>& b() const { return b_; }
  const PreparedShape<T>& obstacle() const { return obstacle_; }

  /// Moves the shapes; their orientation stays.
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
  /// Status, time of impact with its bounds, cost. The normal is A's, outward, at the contact, in
  /// the world (inside: zero; miss: the normal of a plane that keeps B off A all the time).
  CastResult<T> cast;
  /// Hit or inside: the contact point on A, and on B at the time of impact, in the world. Their
  /// difference is what rounding left, more where they graze. Inside: a common point at t = 0.
  Vec3<T> point_a = Vec3<T>::Zero();
  Vec3<T> point_b = Vec3<T>::Zero();
};

/// The first contact with 0 <= t <= t_max. B moves by t * direction, which may be zero or denormal:
/// then the two meet (status inside) or not (miss). Overlapping or touching at the start: inside.
template <class T>
ShapeCastResult<T> cast_shape(const PreparedPair<T>& pair, const Vec3<T>& direction,
                              T t_max = std::numeric_limits<T>::infinity(),
                              const CastOptions<T>& options = {},
                              const CastObserver<T>& observer = {});

/// Both shapes move, each by its velocity, over the times 0 to `duration`.
template <class T>
ShapeCastResult<T> cast_shapes(const PreparedPair<T>& pair, const Vec3<T>& velocity_a,
                               const Vec3<T>& velocity_b, T duration,
                               const CastOptions<T>& options = {});

}  // namespace minkray
