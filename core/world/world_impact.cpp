// SPDX-License-Identifier: MIT
#include "core/world/world_impact.h"

#include <algorithm>
#include <queue>

#include "core/parts/parts_impact.h"

namespace minkray {
namespace {

/// Returns a box that, moved with the body's velocity, contains the body at any time. Includes the
/// rounding of the body's position.
Bounds<double> moving_box(const PartsBody& moving, const RigidMotion& motion) {
  if (motion.angular_velocity.isZero(0)) return bounds_of(moving, motion.pose);
  constexpr double roundings = 16 * std::numeric_limits<double>::epsilon();
  const double reach =
      (1 + roundings) * reach_of(moving) + roundings * motion.pose.translation.norm();
  const Vec3<double> all = Vec3<double>::Constant(reach);
  return {motion.pose.translation - all, motion.pose.translation + all};
}

/// Lower bound of the time at which a box with this velocity reaches another box; infinite if it
/// never does.
double meeting(const Bounds<double>& moving, const Vec3<double>& velocity,
               const Bounds<float>& other) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double rounding = 1 - 16 * std::numeric_limits<double>::epsilon();
  double enter = 0, leave = infinity;
  for (int i = 0; i < 3; ++i) {
    const double ahead = double(other.lower[i]) - moving.upper[i],
                 behind = double(other.upper[i]) - moving.lower[i];
    if (velocity[i] == 0) {
      if (ahead > 0 || behind < 0) return infinity;
      continue;
    }
    const bool up = velocity[i] > 0;
    enter = std::max(enter, rounding * ((up ? ahead : behind) / velocity[i]));
    leave = std::min(leave, (up ? behind : ahead) / (rounding * velocity[i]));
  }
  return enter <= leave ? enter : infinity;
}

}  // namespace

EarliestImpact first_impact(const PartsBody& moving, const RigidMotion& motion,
                            const ContactWorld& world, double t_max, std::uint32_t mask,
                            const EarliestImpact& known) {
  EarliestImpact found = known;
  if (world.bodies().empty()) return found;
  const Bounds<double> box = moving_box(moving, motion);
  struct Open {
    double time;
    std::uint32_t what;
    /// Orders the queue so that the least time comes first.
    bool operator<(const Open& other) const {
      return time != other.time ? time > other.time : what > other.what;
    }
  };
  std::priority_queue<Open> open;
  open.push({0, 0});
  while (!open.empty()) {
    const Open top = open.top();
    open.pop();
    const double end = std::min(t_max, found.impact.t_hi);
    if (top.time > end) break;
    if ((top.what & BvhNode::leaf) == 0) {
      const BvhNode& node = world.hierarchy().nodes[top.what];
      for (int i = 0; i < bvh_width && node.children[i] != BvhNode::none; ++i)
        if (const double time = meeting(box, motion.velocity, node.box(i)); time <= end)
          open.push({time, node.children[i]});
      continue;
    }
    const std::size_t index = top.what & ~BvhNode::leaf;
    const ContactBody& body = world.bodies()[index];
    if ((body.category & mask) == 0) continue;
    ImpactOptions how;
    how.points_of_misses = false;
    take(found, index, first_impact(moving, motion, body.parts(), {body.pose}, end, how));
  }
  return found;
}

}  // namespace minkray
