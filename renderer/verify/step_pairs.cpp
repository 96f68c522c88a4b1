// SPDX-License-Identifier: MIT
#include "renderer/verify/step_pairs.h"

#include <cmath>

#include "renderer/clearance/body_pair.h"

namespace minkray {
namespace {

/// Lower bound that always holds.
constexpr double no_bound = -std::numeric_limits<double>::infinity();

}  // namespace

StepPairs::StepPairs(const JointPath& path, const std::vector<ClearanceBody>& bodies,
                     std::size_t step)
    : bodies_(bodies), motion_(path, step) {
  for (const ClearanceBody& body : bodies) {
    in_world_.push_back(body.plane ? MotionBound{}
                                   : motion_.bound(body.link_index, -1, body.reach()));
    const double radius = body.ball_radius() + in_world_.back().speed / 2 +
                          in_world_.back().rounding + body.middle.loss;
    around_.push_back({place(body, 0.5).middle.high, radius});
  }
}

StepPairs::Place StepPairs::place(const ClearanceBody& body, double s) {
  if (body.link_index < 0) return {body.linear, body.middle.at};
  const StepMotion::Places& links = motion_.places_at(s);
  const auto link = static_cast<std::size_t>(body.link_index);
  const Mat3<double>& turn = links.poses[link].linear;
  return {turn * body.linear, links.origin(link) + TwoFoldVec3<double>(turn * body.middle.at.high,
                                                                       turn * body.middle.at.low)};
}

const StepPairs::Place& StepPairs::kept_place(std::size_t body, double s) {
  Moment* moment = nullptr;
  for (Moment& one : moments_)
    if (one.s == s) moment = &one;
  if (!moment) {
    if (moments_.size() < most_moments) moments_.emplace_back();
    moment = &moments_[next_moment_++ % most_moments];
    moment->s = s;
    moment->places.resize(bodies_.size());
    moment->known.assign(bodies_.size(), false);
  }
  if (!moment->known[body]) {
    moment->places[body] = place(bodies_[body], s);
    moment->known[body] = true;
  }
  return moment->places[body];
}

double StepPairs::lower_by_balls(const RefereePair& pair) const {
  const ClearanceBody &a = bodies_[pair.a], &b = bodies_[pair.b];
  if (a.plane || b.plane) return no_bound;
  const Around &of_a = around_[pair.a], &of_b = around_[pair.b];
  const double distance = (of_b.centre - of_a.centre).norm(), radii = of_a.radius + of_b.radius;
  // Centres far from the world's origin have lost digits.
  const double rounding =
      core_rounding * (distance + radii + of_a.centre.norm() + of_b.centre.norm());
  const double lower = distance - radii - rounding - pair.margin;
  return std::isfinite(lower) ? lower : no_bound;
}

StepBound StepPairs::bound(const RefereePair& pair) const {
  const ClearanceBody &a = bodies_[pair.a], &b = bodies_[pair.b];
  StepBound bound;
  bound.frame = a.plane || b.plane ? -1 : motion_.common_ancestor(a.link_index, b.link_index);
  double reaches = 0;
  for (const std::size_t index : {pair.a, pair.b}) {
    const ClearanceBody& body = bodies_[index];
    if (body.plane) continue;
    const MotionBound one = bound.frame < 0
                                ? in_world_[index]
                                : motion_.bound(body.link_index, bound.frame, body.reach());
    bound.is_within_numbers &= one.is_within_numbers();
    bound.speed += one.speed;
    bound.acceleration += one.acceleration;
    bound.size += body.ball_radius();
    bound.loss += one.rounding + body.middle.loss;
    if (body.link_index >= 0) reaches += one.reach;
  }
  bound.loss += motion_.turn_error(bound.frame) * reaches;
  return bound;
}

const Mat3<double>& StepPairs::frame_turn(const StepBound& bound, double s) {
  static const Mat3<double> identity = Mat3<double>::Identity();
  if (bound.frame < 0) return identity;
  return motion_.links_at(s)[static_cast<std::size_t>(bound.frame)].linear;
}

Between StepPairs::between(const RefereePair& pair, const StepBound& bound, double s,
                           Mat3<double>& turn_a, Mat3<double>& turn_b) {
  // Both places belong to one moment, so the second call replaces none.
  const Place of_a = kept_place(pair.a, s);
  const Place& of_b = kept_place(pair.b, s);
  const Vec3<double> x = (of_b.middle - of_a.middle).rounded();
  turn_a = of_a.linear;
  turn_b = of_b.linear;
  if (bound.frame < 0) return {x, bound.loss};
  const Mat3<double> turn = frame_turn(bound, s).transpose();
  turn_a = turn * turn_a;
  turn_b = turn * turn_b;
  return {turn * x, bound.loss};
}

SignedDistance StepPairs::at(const RefereePair& pair, const StepBound& bound, double s,
                             double at_most, bool only_sign) {
  const ClearanceBody &a = bodies_[pair.a], &b = bodies_[pair.b];
  if (a.plane || b.plane) {
    const std::size_t other = a.plane ? pair.b : pair.a;
    const Place& of_body = kept_place(other, s);
    SignedDistance found = distance_to_half_space(a.plane ? *a.plane : *b.plane, bodies_[other],
                                                  of_body.linear, {of_body.middle, bound.loss});
    if (a.plane) return found;
    std::swap(found.point_a, found.point_b);
    found.normal = -found.normal;
    return found;
  }
  Mat3<double> turn_a, turn_b;
  const Between apart = between(pair, bound, s, turn_a, turn_b);
  SignedDistanceOptions options;
  options.at_most = at_most;
  options.only_sign = only_sign;
  return distance_between(a, turn_a, b, turn_b, apart, options);
}

double StepPairs::gap(const RefereePair& pair, const StepBound& bound, const Vec3<double>& n,
                      double s) {
  if (bodies_[pair.a].plane || bodies_[pair.b].plane) {
    const SignedDistance there = at(pair, bound, s, 0);
    // Along any other direction a half-space is unbounded.
    return n.dot(there.normal) > 1 - 1e-12 ? there.lower : no_bound;
  }
  Mat3<double> turn_a, turn_b;
  const Between apart = between(pair, bound, s, turn_a, turn_b);
  return gap_between(bodies_[pair.a], turn_a, bodies_[pair.b], turn_b, apart, n);
}

SignedDistance StepPairs::in_world(const RefereePair& pair, const StepBound& bound,
                                   SignedDistance found, double s) {
  if (bodies_[pair.a].plane || bodies_[pair.b].plane || found.normal.isZero(0)) return found;
  const Mat3<double> turn = frame_turn(bound, s);
  const Vec3<double> middle = kept_place(pair.a, s).middle.high;
  found.point_a = middle + turn * found.point_a;
  found.point_b = middle + turn * found.point_b;
  found.normal = turn * found.normal;
  return found;
}

}  // namespace minkray
