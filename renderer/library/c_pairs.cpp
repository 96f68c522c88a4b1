// SPDX-License-Identifier: MIT
// C interface: queries on a pair of shapes.
#include <cmath>

#include "core/pair_distance/signed_distance.h"
#include "core/pair_motion/impact.h"
#include "core/parts/parts_contact.h"
#include "core/parts/parts_distance.h"
#include "core/parts/parts_impact.h"
#include "renderer/library/handles/bodies_of_pairs.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/held_shape.h"
#include "renderer/library/handles/pair_answers.h"
#include "renderer/library/handles/poses.h"

namespace minkray {
namespace {

RigidMotion motion_of(const PosedBody& posed, const minkray_twist* twist, const char* argument) {
  RigidMotion motion{posed.pose()};
  if (!twist) return motion;
  motion.velocity = vector_of(twist->velocity, argument, ".velocity");
  motion.angular_velocity = vector_of(twist->turn, argument, ".turn");
  return motion;
}

}  // namespace
}  // namespace minkray

using namespace minkray;

extern "C" {

int minkray_signed_distance(minkray_shape a, const minkray_pose* pose_a, minkray_shape b,
                            const minkray_pose* pose_b, const minkray_distance_options* options,
                            minkray_distance* distance) {
  return call("minkray_signed_distance", [&] {
    const HeldShape &held_a = shape_of(a, "a"), &held_b = shape_of(b, "b");
    require(distance, "distance");
    const PosedBody posed_a(held_a, pose_a, "pose_a"), posed_b(held_b, pose_b, "pose_b");
    const SignedDistance found = signed_distance(posed_a.parts(), posed_a.pose(), posed_b.parts(),
                                                 posed_b.pose(), distance_options(options));
    throw_if_lied(held_a.customs());
    throw_if_lied(held_b.customs());
    *distance = plain_distance(found);
  });
}

int minkray_time_of_impact(minkray_shape a, const minkray_pose* pose_a,
                           const minkray_twist* twist_a, minkray_shape b,
                           const minkray_pose* pose_b, const minkray_twist* twist_b, double t_max,
                           minkray_impact* impact) {
  return call("minkray_time_of_impact", [&] {
    const HeldShape &held_a = shape_of(a, "a"), &held_b = shape_of(b, "b");
    require(impact, "impact");
    if (!std::isfinite(t_max) || !(t_max >= 0))
      wrong_use("t_max: must be finite and >= 0 (got " + std::to_string(t_max) + ")");
    const PosedBody posed_a(held_a, pose_a, "pose_a"), posed_b(held_b, pose_b, "pose_b");
    const Impact found =
        first_impact(posed_a.parts(), motion_of(posed_a, twist_a, "twist_a"), posed_b.parts(),
                     motion_of(posed_b, twist_b, "twist_b"), t_max);
    throw_if_lied(held_a.customs());
    throw_if_lied(held_b.customs());
    *impact = plain_impact(found);
  });
}

}  // extern "C"
