// SPDX-License-Identifier: MIT
// A shape prepared once for all queries on pairs, and the relative pose of two shapes. With
// relative poses, solvers handle only numbers up to about the bodies' sizes and their distance.
#pragma once

#include "core/derived/core_and_radius.h"
#include "core/math/affine.h"
#include "core/pair/core_pair.h"
#include "core/support/composed_map.h"

namespace minkray {

/// A shape as a core and a radius, in the frame of a body. Immutable and cheap to copy.
class ContactShape {
 public:
  /// `map` maps the shape's frame to the body's frame, and may be any invertible map.
  explicit ContactShape(const Shape& shape, const Affine<double>& map = {})
      : ContactShape(core_and_radius(shape, map)) {}
  explicit ContactShape(CoreAndRadius core_and_radius)
      : core_and_radius_(std::move(core_and_radius)),
        is_turned_(core_and_radius_.turn != Mat3<double>::Identity()),
        is_moved_(core_and_radius_.middle != Vec3<double>::Zero()),
        offset_(length_of(core_and_radius_.middle)) {}

  const ShapeCore& core() const { return core_and_radius_.core; }
  /// Rotation or reflection from the core's frame to the body's frame.
  const Mat3<double>& turn() const { return core_and_radius_.turn; }
  /// Origin of the core's frame in the body's frame: the centre of the core.
  const Vec3<double>& middle() const { return core_and_radius_.middle; }
  /// middle() with twice the digits.
  TwoFoldVec3<double> exact_middle() const {
    return {core_and_radius_.middle, core_and_radius_.middle_low};
  }
  /// True if the core's frame is rotated (is_turned), or the middle is not the body's origin
  /// (is_moved). For most shapes both are false, which halves the cost of a pair's relative pose.
  bool is_turned() const { return is_turned_; }
  bool is_moved() const { return is_moved_; }
  /// Distance of the middle from the body's origin.
  double offset() const { return offset_; }
  /// True if the middle is so far from the body's origin that its position is computed with twice
  /// the digits.
  bool is_far_out() const {
    constexpr double far = 4;
    return offset_ > far * ball_radius();
  }
  /// Radius of a ball around the middle that contains the shape.
  double ball_radius() const { return core_and_radius_.core.ball + core_and_radius_.core.radius; }

 private:
  CoreAndRadius core_and_radius_;
  bool is_turned_, is_moved_;
  double offset_;
};

/// Pose of a core in the world.
struct PlacedCore {
  Mat3<double> turn;    ///< rotation from the core's frame to the world
  Vec3<double> middle;  ///< origin of the core's frame, in the world
};

/// Returns the rotation from the core's frame to the world.
inline Mat3<double> turn_in_world(const ContactShape& shape, const Mat3<double>& linear) {
  if (!shape.is_turned()) return linear;
  return linear * shape.turn();
}
inline Mat3<double> turn_in_world(const ContactShape& shape, const Affine<double>& pose) {
  return turn_in_world(shape, pose.linear);
}

inline Vec3<double> middle_in_world(const ContactShape& shape, const Affine<double>& pose) {
  if (!shape.is_moved()) return pose.translation;
  if (shape.is_far_out()) return image_of(pose, shape.exact_middle()).rounded();
  return pose(shape.middle());
}

/// Returns the core's pose in the world. `pose`, of the body, must be rigid: up to rounding, its
/// linear part is a rotation or a reflection.
PlacedCore placed(const ContactShape& shape, const Affine<double>& pose);

/// Position of a core's middle in the world with twice the digits, and its error bound `loss`.
struct PlacedMiddle {
  TwoFoldVec3<double> at;
  double loss = 0;
};
PlacedMiddle placed_middle(const ContactShape& shape, const Affine<double>& pose);

/// Vector between the middles of two bodies in world axes.
struct Between {
  Vec3<double> x;
  /// Bounds the error of x that stems from rounding while the middles' positions are computed. The
  /// final rounding of x itself is not included.
  double loss = 0;
};

/// Vector from A's middle to B's middle. Subtracts unrounded positions, so a large common offset of
/// the bodies does not add to the error.
Between between_middles(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                        const Affine<double>& pose_b);

/// Returns both cores in A's frame. `turn_a` is A's turn_in_world().
CorePair pair_of(const ContactShape& a, const Affine<double>& pose_a, const Mat3<double>& turn_a,
                 const ContactShape& b, const Affine<double>& pose_b);
CorePair pair_of(const ContactShape& a, const Mat3<double>& turn_a, const ContactShape& b,
                 const Mat3<double>& turn_b, const Between& between);

}  // namespace minkray
