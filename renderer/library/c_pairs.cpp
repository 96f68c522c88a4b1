// SPDX-License-Identifier: MIT
// The functions of the C interface about pairs of shapes.
#include <cmath>

#include "core/contact/impact.h"
#include "core/contact/signed_distance.h"
#include "renderer/library/call.h"
#include "renderer/library/held_shape.h"
#include "renderer/library/poses.h"

namespace minkray {
namespace {

void store(const Vec3<double>& from, double (&to)[3]) {
  for (int k = 0; k < 3; ++k) to[k] = from[k];
}

/// A shape and where it stands, as queries on pairs want it: what keeps lengths is the pose, any
/// other map is part of the shape.
struct PosedShape {
  std::optional<ContactShape> own;  ///< where the map is part of it
  const ContactShape& shape;
  Affine<double> pose;

  PosedShape(const HeldShape& held, const Affine<double>& map)
      : PosedShape(held, map, is_rigid(map)) {}
  PosedShape(const PosedShape&) = delete;
  PosedShape& operator=(const PosedShape&) = delete;

 private:
  PosedShape(const HeldShape& held, const Affine<double>& map, bool keeps_lengths)
      : own(keeps_lengths ? std::nullopt
                          : std::optional<ContactShape>(std::in_place, *held.shape(),
                                                        Affine<double>{map.linear, Vec3<double>::Zero()})),
        shape(own ? *own : held.contact()),
        pose(keeps_lengths ? map : Affine<double>{Mat3<double>::Identity(), map.translation}) {}
};

SignedDistanceOptions distance_options(const minkray_distance_options* given) {
  SignedDistanceOptions options;
  if (!given) return options;
  if (given->size < sizeof(minkray_distance_options))
    wrong_use("options.size: must be sizeof(minkray_distance_options)");
  if (!(given->tolerance >= 0) || !(given->tolerance < 1))
    wrong_use("options.tolerance: must be >= 0 and < 1 (got " + std::to_string(given->tolerance) +
              ")");
  if (!(given->at_most >= 0))
    wrong_use("options.at_most: must be >= 0 (got " + std::to_string(given->at_most) + ")");
  if (given->tolerance > 0) options.tolerance = given->tolerance;
  if (given->at_most > 0) options.at_most = given->at_most;
  options.only_sign = given->only_sign != 0;
  return options;
}

RigidMotion motion_of(const PosedShape& posed, const minkray_twist* twist, const char* argument) {
  RigidMotion motion{posed.pose};
  if (!twist) return motion;
  motion.velocity = vector_of(twist->velocity, (std::string(argument) + ".velocity").c_str());
  motion.angular_velocity = vector_of(twist->turn, (std::string(argument) + ".turn").c_str());
  return motion;
}

int code_of(SignedStatus status) {
  switch (status) {
    case SignedStatus::separated:
      return MINKRAY_SEPARATED;
    case SignedStatus::touching:
      return MINKRAY_TOUCHING;
    case SignedStatus::overlapping:
      return MINKRAY_OVERLAPPING;
    case SignedStatus::undecided:
      break;
  }
  return MINKRAY_UNDECIDED;
}

int code_of(ImpactStatus status) {
  switch (status) {
    case ImpactStatus::hit:
      return MINKRAY_IMPACT;
    case ImpactStatus::miss:
      return MINKRAY_NO_IMPACT;
    case ImpactStatus::inside:
      return MINKRAY_BEGINS_INSIDE;
    case ImpactStatus::undecided:
      break;
  }
  return MINKRAY_IMPACT_UNDECIDED;
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
    const PosedShape posed_a(held_a, pose_of(pose_a, "pose_a"));
    const PosedShape posed_b(held_b, pose_of(pose_b, "pose_b"));
    const SignedDistance found = signed_distance(posed_a.shape, posed_a.pose, posed_b.shape,
                                                 posed_b.pose, distance_options(options));
    throw_if_lied(held_a.customs());
    throw_if_lied(held_b.customs());
    minkray_distance plain = {};
    plain.value = found.value;
    plain.lower = found.lower;
    plain.upper = found.upper;
    store(found.point_a, plain.point_a);
    store(found.point_b, plain.point_b);
    store(found.normal, plain.normal);
    plain.status = code_of(found.status);
    plain.supports = found.supports;
    *distance = plain;
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
    const PosedShape posed_a(held_a, pose_of(pose_a, "pose_a"));
    const PosedShape posed_b(held_b, pose_of(pose_b, "pose_b"));
    const Impact found = first_impact(posed_a.shape, motion_of(posed_a, twist_a, "twist_a"),
                                      posed_b.shape, motion_of(posed_b, twist_b, "twist_b"), t_max);
    throw_if_lied(held_a.customs());
    throw_if_lied(held_b.customs());
    minkray_impact plain = {};
    plain.t_lo = found.t_lo;
    plain.t_hi = found.t_hi;
    plain.distance = found.distance;
    store(found.point_a, plain.point_a);
    store(found.point_b, plain.point_b);
    store(found.normal, plain.normal);
    plain.status = code_of(found.status);
    plain.steps = found.steps;
    *impact = plain;
  });
}

}  // extern "C"
