// SPDX-License-Identifier: MIT
#include "renderer/verify/step_pairs.h"

#include <cmath>

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
    around_.push_back({place_of(body, motion_, 0.5).middle.high, radius});
  }
}

const BodyPlace& StepPairs::kept_place(std::size_t body, double s) {
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
    moment->places[body] = place_of(bodies_[body], motion_, s);
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
  return step_bound(bodies_[pair.a], bodies_[pair.b], motion_, &in_world_[pair.a],
                    &in_world_[pair.b]);
}

StepMoment StepPairs::moment(const RefereePair& pair, const StepBound& bound, double s) {
  // Both places belong to one moment, so the second call replaces none.
  const BodyPlace& of_a = kept_place(pair.a, s);
  return {bodies_[pair.a], of_a, bodies_[pair.b], kept_place(pair.b, s), bound, motion_, s};
}

SignedDistance StepPairs::at(const RefereePair& pair, const StepBound& bound, double s,
                             double at_most, bool only_sign) {
  SignedDistanceOptions options;
  options.at_most = at_most;
  options.only_sign = only_sign;
  return moment(pair, bound, s).distance(options);
}

double StepPairs::gap(const RefereePair& pair, const StepBound& bound, const Vec3<double>& n,
                      double s) {
  return moment(pair, bound, s).gap(n);
}

SignedDistance StepPairs::in_world(const RefereePair& pair, const StepBound& bound,
                                   const SignedDistance& found, double s) {
  return moment(pair, bound, s).in_world(found);
}

}  // namespace minkray
