// SPDX-License-Identifier: MIT
// Continuous collision detection of two shapes that move without turning (van den Bergen, 2004,
// sections 1 and 4). B moves by t * direction relative to A, and meets A at the least t for which
// t * direction lies in the configuration space obstacle A - B (both at t = 0). So any ray-cast
// solver can answer the query, by a cast at this obstacle. The obstacle is relative to the shapes'
// centres, so precision does not depend on their positions in the world.
#pragma once

#include "core/cast/cast.h"
#include "renderer/paper/centred_shape.h"

namespace minkray {

/// The obstacle A - B of two shapes, prepared for casts with any positions of their centres.
class PreparedPair {
 public:
  /// A is the obstacle, B the shape that moves; their poses at t = 0.
  PreparedPair(const CentredShape& a, const CentredShape& b)
      : a_(a),
        b_(b),
        obstacle_(Shape(MinkowskiDifference{Nested(a.about_centre), Nested(b.about_centre)})) {}

  const CentredShape& a() const { return a_; }
  const CentredShape& b() const { return b_; }
  const PreparedShape& obstacle() const { return obstacle_; }

  /// Moves the shapes without changing their orientations.
  void place(const Vec3<double>& centre_a, const Vec3<double>& centre_b) {
    a_.centre = centre_a;
    b_.centre = centre_b;
  }

 private:
  CentredShape a_, b_;
  PreparedShape obstacle_;
};

struct ShapeCastResult {
  /// Status, time of impact with its bounds, and cost. Hit: the normal is A's outward normal at the
  /// contact, in the world. Miss: the normal of a plane that separates B from A at all times.
  /// Inside: zero.
  CastResult<double> cast;
  /// In the world. Hit: the contact points on A and on B, at the time of impact. Inside: a common
  /// point of both shapes, at t = 0. point_a and point_b differ by rounding errors, which are
  /// larger for grazing contacts. Miss: zero.
  Vec3<double> point_a = Vec3<double>::Zero();
  Vec3<double> point_b = Vec3<double>::Zero();
};

/// Finds the first contact with 0 <= t <= t_max. B moves by t * direction. The status is inside if
/// the shapes overlap or touch at the start. Otherwise, a direction of zero gives a miss. A
/// denormal direction may give exhausted, since the contact's t may overflow.
ShapeCastResult cast_shape(const PreparedPair& pair, const Vec3<double>& direction,
                           double t_max = std::numeric_limits<double>::infinity(),
                           const CastOptions& options = {}, const CastObserver& observer = {});

/// Finds the first contact of two moving shapes, each with its velocity, at times from 0 to
/// `duration`.
ShapeCastResult cast_shapes(const PreparedPair& pair, const Vec3<double>& velocity_a,
                            const Vec3<double>& velocity_b, double duration,
                            const CastOptions& options = {});

}  // namespace minkray
