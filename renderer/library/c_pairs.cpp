// SPDX-License-Identifier: MIT
// The functions of the C interface about pairs of shapes.
#include <cmath>
#include <limits>
#include <memory>

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
class PosedShape {
 public:
  PosedShape(const HeldShape& held, const minkray_pose* pose, const char* argument) {
    refuse_if_running(held.customs(), argument);
    if (read_pose(pose, argument, pose_)) [[likely]] {
      shape_ = &held.contact();
      return;
    }
    own_ = std::make_unique<const ContactShape>(*held.shape(),
                                                Affine<double>{pose_.linear, Vec3<double>::Zero()});
    shape_ = own_.get();
    pose_.linear.setIdentity();
  }

  const ContactShape& shape() const { return *shape_; }
  const Affine<double>& pose() const { return pose_; }

 private:
  std::unique_ptr<const ContactShape> own_;  ///< where the map is part of it
  const ContactShape* shape_;
  Affine<double> pose_;
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
  RigidMotion motion{posed.pose()};
  if (!twist) return motion;
  motion.velocity = vector_of(twist->velocity, argument, ".velocity");
  motion.angular_velocity = vector_of(twist->turn, argument, ".turn");
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
    const PosedShape posed_a(held_a, pose_a, "pose_a"), posed_b(held_b, pose_b, "pose_b");
    const SignedDistance found = signed_distance(posed_a.shape(), posed_a.pose(), posed_b.shape(),
                                                 posed_b.pose(), distance_options(options));
    throw_if_lied(held_a.customs());
    throw_if_lied(held_b.customs());
    distance->value = found.value;
    distance->lower = found.lower;
    distance->upper = found.upper;
    store(found.point_a, distance->point_a);
    store(found.point_b, distance->point_b);
    store(found.normal, distance->normal);
    distance->status = code_of(found.status);
    distance->supports = found.supports;
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
    const PosedShape posed_a(held_a, pose_a, "pose_a"), posed_b(held_b, pose_b, "pose_b");
    const Impact found =
        first_impact(posed_a.shape(), motion_of(posed_a, twist_a, "twist_a"), posed_b.shape(),
                     motion_of(posed_b, twist_b, "twist_b"), t_max);
    throw_if_lied(held_a.customs());
    throw_if_lied(held_b.customs());
    const bool touch = found.status == ImpactStatus::hit || found.status == ImpactStatus::inside;
    impact->t_lo = found.t_lo;
    impact->t_hi = touch ? found.t_hi : std::numeric_limits<double>::infinity();
    impact->distance = found.distance;
    store(found.point_a, impact->point_a);
    store(found.point_b, impact->point_b);
    store(found.normal, impact->normal);
    impact->status = code_of(found.status);
    impact->steps = found.steps;
  });
}

}  // extern "C"
