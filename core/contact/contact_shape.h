// SPDX-License-Identifier: MIT
// A shape made ready for queries on pairs, once: no pair needs to be prepared.
#pragma once

#include "core/contact/core_pair.h"
#include "core/derived/convert.h"
#include "core/math/affine.h"
#include "core/shape/core_and_radius.h"

namespace minkray {

/// It is immutable and cheap to copy. Its numbers are doubles, whatever the shape's are.
class ContactShape {
 public:
  /// `map` leads from the shape's frame to the body's; any invertible map.
  explicit ContactShape(const Shape<double>& shape, const Affine<double>& map = {})
      : core_and_radius_(core_and_radius(shape, map)),
        is_turned_(core_and_radius_.turn != Mat3<double>::Identity()),
        is_moved_(core_and_radius_.middle != Vec3<double>::Zero()) {}
  explicit ContactShape(const Shape<float>& shape) : ContactShape(convert<double>(shape)) {}

  const ShapeCore& core() const { return core_and_radius_.core; }
  /// It leads from the core's frame to the body's, and keeps lengths.
  const Mat3<double>& turn() const { return core_and_radius_.turn; }
  const Vec3<double>& middle() const { return core_and_radius_.middle; }
  /// Whether the core's frame is turned, and whether its middle is not the body's origin: most are
  /// neither, which saves half of the work of placing a pair.
  bool is_turned() const { return is_turned_; }
  bool is_moved() const { return is_moved_; }
  /// The ball of this radius around the middle holds the shape.
  double ball_radius() const { return core_and_radius_.core.ball + core_and_radius_.core.radius; }

 private:
  CoreAndRadius core_and_radius_;
  bool is_turned_, is_moved_;
};

/// Where a core stands in the world.
struct PlacedCore {
  Mat3<double> turn;  ///< from the core's frame to the world
  Vec3<double> middle;
};

/// From the core's frame to the world.
inline Mat3<double> turn_in_world(const ContactShape& shape, const Affine<double>& pose) {
  if (!shape.is_turned()) return pose.linear;
  return pose.linear * shape.turn();
}

inline Vec3<double> middle_in_world(const ContactShape& shape, const Affine<double>& pose) {
  if (!shape.is_moved()) return pose.translation;
  return pose(shape.middle());
}

/// `pose` is rigid: its linear part is a rotation, or a reflection, to rounding.
PlacedCore placed(const ContactShape& shape, const Affine<double>& pose);

/// From A's middle to B's, in the world. The difference of the two places is taken before anything
/// is rounded, so that pairs far from the origin are as exact as their poses.
Vec3<double> between_middles(const ContactShape& a, const Affine<double>& pose_a,
                             const ContactShape& b, const Affine<double>& pose_b);

/// B as A sees it. `turn_a` is A's turn_in_world().
CorePair pair_of(const ContactShape& a, const Affine<double>& pose_a, const Mat3<double>& turn_a,
                 const ContactShape& b, const Affine<double>& pose_b);

}  // namespace minkray
