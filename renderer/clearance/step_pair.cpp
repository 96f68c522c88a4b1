// SPDX-License-Identifier: MIT
#include "renderer/clearance/step_pair.h"

#include <utility>

#include "renderer/clearance/body_pair.h"

namespace minkray {

StepBound step_bound(const ClearanceBody& a, const ClearanceBody& b, const StepMotion& motion,
                     const MotionBound* a_in_world, const MotionBound* b_in_world) {
  StepBound bound;
  bound.frame = a.plane || b.plane ? -1 : motion.common_ancestor(a.link_index, b.link_index);
  double reaches = 0;
  for (const auto& [body, in_world] : {std::pair(&a, a_in_world), std::pair(&b, b_in_world)}) {
    if (body->plane) continue;
    const MotionBound one = bound.frame < 0 && in_world
                                ? *in_world
                                : motion.bound(body->link_index, bound.frame, body->reach());
    bound.is_within_numbers &= one.is_within_numbers();
    bound.speed += one.speed;
    bound.acceleration += one.acceleration;
    bound.size += body->ball_radius();
    bound.loss += one.rounding + body->middle.loss;
    if (body->link_index >= 0) reaches += one.reach;
  }
  bound.loss += motion.turn_error(bound.frame) * reaches;
  return bound;
}

BodyPlace place_of(const ClearanceBody& body, StepMotion& motion, double s) {
  if (body.link_index < 0) return {body.linear, body.middle.at};
  const StepMotion::Places& links = motion.places_at(s);
  const auto link = static_cast<std::size_t>(body.link_index);
  const Mat3<double>& turn = links.poses[link].linear;
  return {turn * body.linear, links.origin(link) + TwoFoldVec3<double>(turn * body.middle.at.high,
                                                                       turn * body.middle.at.low)};
}

StepMoment::StepMoment(const ClearanceBody& body_a, const BodyPlace& place_a,
                       const ClearanceBody& body_b, const BodyPlace& place_b,
                       const StepBound& bound, StepMotion& motion, double s)
    : a(body_a), b(body_b), of_a(place_a), of_b(place_b), turn(nullptr) {
  between = {(of_b.middle - of_a.middle).rounded(), bound.loss};
  if (bound.frame < 0) return;
  turn = &motion.links_at(s)[static_cast<std::size_t>(bound.frame)].linear;
  of_a.linear = turn->transpose() * place_a.linear;
  of_b.linear = turn->transpose() * place_b.linear;
  between.x = (turn->transpose() * between.x).eval();
}

SignedDistance StepMoment::distance(const SignedDistanceOptions& options) const {
  if (a.plane) return distance_to_half_space(*a.plane, b, of_b.linear, {of_b.middle, between.loss});
  if (b.plane) {
    SignedDistance found =
        distance_to_half_space(*b.plane, a, of_a.linear, {of_a.middle, between.loss});
    std::swap(found.point_a, found.point_b);
    found.normal = -found.normal;
    return found;
  }
  return distance_between(a, of_a.linear, b, of_b.linear, between, options);
}

double StepMoment::gap(const Vec3<double>& n) const {
  if (!a.plane && !b.plane) return gap_between(a, of_a.linear, b, of_b.linear, between, n);
  // Along any other direction a half-space is unbounded.
  const SignedDistance there = distance({});
  return n.dot(there.normal) > 1 - 1e-12 ? there.lower : -std::numeric_limits<double>::infinity();
}

SignedDistance StepMoment::in_world(SignedDistance found) const {
  if (a.plane || b.plane || found.normal.isZero(0)) return found;
  if (turn) {
    found.point_a = *turn * found.point_a;
    found.point_b = *turn * found.point_b;
    found.normal = *turn * found.normal;
  }
  found.point_a += of_a.middle.high;
  found.point_b += of_a.middle.high;
  return found;
}

}  // namespace minkray
