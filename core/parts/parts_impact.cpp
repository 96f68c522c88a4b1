// SPDX-License-Identifier: MIT
#include "core/parts/parts_impact.h"

#include "core/pair_motion/earliest_impact.h"
#include "core/parts/one_part.h"
#include "core/parts/pair_walk.h"
#include "core/parts/parts_distance.h"

namespace minkray {

Impact first_impact(const PartsBody& body_a, const RigidMotion& motion_a, const PartsBody& body_b,
                    const RigidMotion& motion_b, double t_max, const ImpactOptions& options,
                    PartPair* parts) {
  if (parts) *parts = {};
  if (body_a.shape() && body_b.shape())
    return first_impact(*body_a.shape(), motion_a, *body_b.shape(), motion_b, t_max, options);
  EarliestImpact first = nothing_met(t_max);
  if (point_within(body_a, motion_a.pose, body_b, motion_b.pose)) {
    first.impact.status = ImpactStatus::inside;
    first.impact.t_lo = first.impact.t_hi = first.impact.distance = 0;
    return first.impact;
  }
  const BodyTree a(body_a), b(body_b);
  const Sight sight(a, motion_a.pose, b, motion_b.pose);
  const double speed = (motion_b.velocity - motion_a.velocity).norm();
  const double turn_a = motion_a.angular_velocity.norm(), turn_b = motion_b.angular_velocity.norm();
  const auto limit = [&] { return std::min(t_max, first.impact.t_hi); };
  // Distance from the origin of the body's frame, about which it turns.
  const auto reach = [](const BodyTree& tree, const MiddleBox& box) {
    return ((tree.middle() + box.middle).cwiseAbs() + box.half).norm();
  };
  // No point is faster than this, so no contact is earlier than gap / speed.
  const auto key = [&](double gap, const MiddleBox& of_a, const MiddleBox& of_b) {
    constexpr double rounded = 1 - 16 * std::numeric_limits<double>::epsilon();
    if (!(gap > 0)) return gap;
    const double fastest = speed + turn_a * reach(a, of_a) + turn_b * reach(b, of_b);
    return fastest > 0 ? rounded * gap / fastest : std::numeric_limits<double>::infinity();
  };
  std::size_t pair = 0;
  PairWalk walk(a, b, sight);
  walk.run(key, limit, [&](std::uint32_t part_a, std::uint32_t part_b) {
    const OnePart of_a(body_a, part_a), of_b(body_b, part_b);
    ImpactOptions how = options;
    how.points_of_misses = false;
    const std::size_t before = first.body;
    take(first, pair, first_impact(of_a.shape(), motion_a, of_b.shape(), motion_b, limit(), how));
    if (first.body != before && parts) *parts = {of_a.number(), of_b.number()};
    ++pair;
    return first.impact.status == ImpactStatus::inside && first.impact.t_hi == 0;
  });
  return first.impact;
}

}  // namespace minkray
