// SPDX-License-Identifier: MIT
#include "core/parts/pair_walk.h"

namespace minkray {
namespace {

TwoFoldVec3<double> middle_in_world(const BodyTree& tree, const Affine<double>& pose) {
  const ContactShape* shape = tree.body().shape();
  return image_of(pose, shape ? shape->exact_middle() : TwoFoldVec3<double>(tree.middle()));
}

}  // namespace

Sight::Sight(const BodyTree& a, const Affine<double>& pose_a, const BodyTree& b,
             const Affine<double>& pose_b)
    : turn_a(pose_a.linear) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  // Subtracts the positions before anything is rounded.
  const TwoFoldVec3<double> at_a = middle_in_world(a, pose_a), at_b = middle_in_world(b, pose_b);
  const Vec3<double> between = (at_b - at_a).rounded();
  middle_a = at_a.rounded();
  b_in_a.turn = turn_a.transpose() * pose_b.linear;
  b_in_a.shift = turn_a.transpose() * between;
  a_in_b.turn = b_in_a.turn.transpose();
  a_in_b.shift = -(a_in_b.turn * b_in_a.shift);
  // A corner is rotated twice, translated, and projected on a direction: less than 30 roundings of
  // numbers of this size, one after the other.
  rounding = 32 * epsilon * (between.norm() + a.radius() + b.radius()) +
             two_fold_rounding * (a.middle().norm() + b.middle().norm() +
                                  pose_a.translation.norm() + pose_b.translation.norm());
}

}  // namespace minkray
