// SPDX-License-Identifier: MIT
// A body that moves and turns, with bounds of its reach and speed, for proofs that two bodies stay
// apart (impact.cpp).
#pragma once

#include "core/pair/closed_answer.h"
#include "core/pair_motion/impact.h"

namespace minkray {

/// A body that may turn. Positions are relative to its pivot, or to its middle if it does not turn.
class Turning {
 public:
  Turning(const ContactShape& shape, const RigidMotion& motion)
      : shape_(shape), motion_(motion), speed_(length_of(motion.angular_velocity)) {
    if (speed_ > 0) axis_ = motion.angular_velocity / speed_;
    if (speed_ > 0 && shape.is_moved()) arm_ = motion.pose.linear * shape.middle();
    reach_ = shape.ball_radius() + length_of(arm_);
  }

  double speed() const { return speed_; }  ///< radians per unit of time
  /// Upper bound of the distance of points from the axis.
  double reach() const { return reach_; }
  double arm_length() const { return reach_ - shape_.ball_radius(); }

  PlacedMiddle seen_from() const {
    if (speed_ > 0) return {motion_.pose.translation, shape_.core().rounding};
    return placed_middle(shape_, motion_.pose);
  }

  /// Pose of the body at a time: its linear part, and its middle relative to seen_from().
  Affine<double> at(double time) const {
    if (!(speed_ > 0)) return {motion_.pose.linear, Vec3<double>::Zero()};
    const Mat3<double> turn = Eigen::AngleAxis<double>(time * speed_, axis_).toRotationMatrix();
    return {turn * motion_.pose.linear, turn * arm_};
  }

  /// Support function for a direction in the world.
  double support(const Affine<double>& there, const Vec3<double>& n) const {
    const Mat3<double> turn = turn_in_world(shape_, there.linear);
    const Vec3<double> d = turn.transpose() * n;
    const CoreSupport support = support_of_core<CoreKind::other>(shape_.core(), d);
    return n.dot(there.translation) + d.dot(support.point) + shape_.core().radius;
  }

  Vec3<double> velocity_of(const Vec3<double>& from_seen) const {
    return motion_.angular_velocity.cross(from_seen);
  }

 private:
  const ContactShape& shape_;
  const RigidMotion& motion_;
  double speed_;
  Vec3<double> axis_ = Vec3<double>::Zero(), arm_ = Vec3<double>::Zero();
  double reach_;
};

}  // namespace minkray
