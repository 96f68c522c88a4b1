// SPDX-License-Identifier: MIT
#include "core/contact/contact_shape.h"

namespace minkray {

PlacedCore placed(const ContactShape& shape, const Affine<double>& pose) {
  return {turn_in_world(shape, pose), middle_in_world(shape, pose)};
}

Vec3<double> between_middles(const ContactShape& a, const Affine<double>& pose_a,
                             const ContactShape& b, const Affine<double>& pose_b) {
  Vec3<double> between = pose_b.translation - pose_a.translation;
  if (!a.is_moved() && !b.is_moved()) return between;
  // Middles far from the bodies' origins lose what the bodies' places have gained.
  constexpr double far = 4;
  const bool is_far = a.middle().squaredNorm() > far * far * a.ball_radius() * a.ball_radius() ||
                      b.middle().squaredNorm() > far * far * b.ball_radius() * b.ball_radius();
  if (is_far) {
    using Long = long double;
    const auto moved = [](const Affine<double>& pose, const Vec3<double>& p) -> Vec3<Long> {
      return pose.linear.cast<Long>() * p.cast<Long>() + pose.translation.cast<Long>();
    };
    between = (moved(pose_b, b.middle()) - moved(pose_a, a.middle())).cast<double>();
  } else {
    between += pose_b.linear * b.middle() - pose_a.linear * a.middle();
  }
  return between;
}

CorePair pair_of(const ContactShape& a, const Affine<double>& pose_a, const Mat3<double>& turn_a,
                 const ContactShape& b, const Affine<double>& pose_b) {
  return {a.core(), b.core(), turn_a.transpose() * turn_in_world(b, pose_b),
          turn_a.transpose() * between_middles(a, pose_a, b, pose_b)};
}

}  // namespace minkray
