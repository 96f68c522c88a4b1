// SPDX-License-Identifier: MIT
#include "core/pair/contact_shape.h"

namespace minkray {

PlacedCore placed(const ContactShape& shape, const Affine<double>& pose) {
  return {turn_in_world(shape, pose), middle_in_world(shape, pose)};
}

namespace {

TwoFoldVec3<double> exact_image(const Affine<double>& pose, const ContactShape& shape) {
  if (!shape.is_moved()) return pose.translation;
  if (pose.linear == Mat3<double>::Identity())
    return shape.exact_middle() + TwoFoldVec3<double>(pose.translation);
  return image_of(pose, shape.exact_middle());
}

}  // namespace

PlacedMiddle placed_middle(const ContactShape& shape, const Affine<double>& pose) {
  const double loss = shape.core().rounding;
  if (!shape.is_moved()) return {pose.translation, loss};
  return {exact_image(pose, shape),
          loss + two_fold_rounding * (shape.offset() + length_of(pose.translation))};
}

Between between_middles(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                        const Affine<double>& pose_b) {
  Between between{pose_b.translation - pose_a.translation, a.core().rounding + b.core().rounding};
  if (!a.is_moved() && !b.is_moved()) return between;
  if (a.is_far_out() || b.is_far_out()) {
    between.x = (exact_image(pose_b, b) - exact_image(pose_a, a)).rounded();
    between.loss += two_fold_rounding * (a.offset() + b.offset() + length_of(pose_a.translation));
    return between;
  }
  // A middle's image is three products and their sums.
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  between.x += pose_b.linear * b.middle() - pose_a.linear * a.middle();
  between.loss += rounding * (a.offset() + b.offset());
  return between;
}

CorePair pair_of(const ContactShape& a, const Affine<double>& pose_a, const Mat3<double>& turn_a,
                 const ContactShape& b, const Affine<double>& pose_b) {
  return pair_of(a, turn_a, b, turn_in_world(b, pose_b), between_middles(a, pose_a, b, pose_b));
}

CorePair pair_of(const ContactShape& a, const Mat3<double>& turn_a, const ContactShape& b,
                 const Mat3<double>& turn_b, const Between& between) {
  return {a.core(), b.core(), turn_a.transpose() * turn_b, turn_a.transpose() * between.x,
          between.loss};
}

}  // namespace minkray
