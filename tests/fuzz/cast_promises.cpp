// SPDX-License-Identifier: MIT
#include "tests/fuzz/cast_promises.h"

#include "tests/oracle/wolfe.h"

namespace minkray::fuzz {
namespace {

/// In epsilons of the largest number that occurs, times the condition of the maps: twice what
/// tests/core/cast/cast_truths_test.cpp allows two casts.
constexpr Real allowed = 2048;
/// Iterations of the search for a plane that keeps a claimed point off: a plane that it finds is
/// proof, whatever it does not find.
constexpr int most_steps = 24;
/// The search for the nearest point among so few may go round in circles between nearly equal ones.
constexpr int most_turns = 100;
/// The longest cast: each of the jet cast, towards and back, the GJK ray cast and the portal cast
/// (core/query/tolerances.h), and then those in turn with a proof of each answer, which is four
/// searches of 400 support points at most (core/proof/certificate.cpp).
constexpr int most_supports = 3 * (4 * 48 + 1000 + 4 * 256 + 4 * 400) + 32;

std::string number(Real x) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6Lg", x);
  return text;
}

}  // namespace

CastReferee::CastReferee(const Shape& shape, const Ray<double>& ray) : shape_(shape) {
  const Bounds<Real> bounds = bounds_of<Real>(shape_);
  const Extent extent = extent_of(shape);
  centre_ = bounds.centre();
  radius_ = 1.001L * bounds.half_extents().norm();
  direction_ = ray.direction.cast<Real>();
  speed_ = direction_.norm();
  t_max_ = ray.t_max;

  const QuadVec d = quad(ray.direction);
  from_centre_ = quad(ray.origin) - centre_.cast<Quad>();
  const Real distance = from_centre_.cast<Real>().lpNorm<1>();
  t_closest_ = speed_ > 0 ? static_cast<Real>(-from_centre_.dot(d) / d.squaredNorm()) : 0;
  closest_ = at(t_closest_, 0);

  using Limits = std::numeric_limits<double>;
  epsilon_ = Limits::epsilon();
  // Parameters in steps of the least number, too.
  const Real least = Real(Limits::denorm_min()) * (1 + speed_) * 64;
  rounding_ = allowed * epsilon_ * extent.condition * (extent.size + epsilon_ * distance) + least;
  // The ray's begin and end are as uncertain as its parameter there.
  end_rounding_ = 64 * epsilon_ * extent.condition * distance;
  if (std::isfinite(t_max_)) end_rounding_ += 64 * epsilon_ * extent.condition * t_max_ * speed_;
  constexpr Real margin = 1024;
  const Real most = Limits::max() / margin, fewest = Limits::min() * margin;
  const Real longest = distance + radius_ + rounding_;
  in_range_ =
      extent.size < most && distance < most && extent.condition < 1e4L &&
      (extent.size == 0 || extent.size * epsilon_ > fewest) &&
      (speed_ == 0 || (speed_ > fewest && speed_ < most && longest / speed_ < most &&
                       extent.size * epsilon_ / speed_ > fewest && distance < 1e18L * extent.size));
}

Vec3<Real> CastReferee::at(Real t_base, Real t_offset) const {
  const QuadVec d = direction_.cast<Quad>();
  return (from_centre_ + Quad(t_base) * d + Quad(t_offset) * d).cast<Real>();
}

std::string CastReferee::kept_off(const Claim& claim, const Vec3<Real>& n) const {
  const Real gap = n.dot(claim.x) - height(n);
  if (!(gap > rounding_)) return "";
  return "the point found (" + claim.by + ") lies " + number(gap) + " outside (allowed " +
         number(rounding_) + ")";
}

std::string CastReferee::check_miss(const Vec3<Real>& n) const {
  // The part of the line in the ball, as lengths from the closest point.
  const Real squared = radius_ * radius_ - closest_.squaredNorm();
  Real low = -t_closest_ * speed_, high = (t_max_ - t_closest_) * speed_;
  if (speed_ == 0) low = high = 0;
  if (speed_ > 0 && !(squared > 0)) return "";
  if (speed_ > 0) {
    low = std::max(low, -std::sqrt(squared));
    high = std::min(high, std::sqrt(squared));
    if (low > high) return "";
  }
  const Vec3<Real> unit_direction = speed_ > 0 ? Vec3<Real>(direction_ / speed_) : direction_;
  for (const Real lambda : {low, high}) {
    const Vec3<Real> x = closest_ + lambda * unit_direction;
    const Real gap = n.dot(x) - height(n);
    // The ray's end may be off by its rounding.
    const Real end = std::isfinite(t_max_) || lambda == low ? end_rounding_ : 0;
    const Real bound = rounding_ + std::min(end, radius_);
    if (!(gap >= -bound))
      return "a miss whose plane cuts the ray: " + number(gap) + " on the wrong side (allowed " +
             number(bound) + ")";
  }
  return "";
}

std::string CastReferee::check(std::string_view solver, const CastResult<double>& result) {
  const Vec3<Real> n = result.normal.cast<Real>();
  if (result.supports < 0 || result.supports > most_supports)
    return "supports: " + std::to_string(result.supports);
  if (result.iterations < 0 || result.iterations > most_supports)
    return "iterations: " + std::to_string(result.iterations);
  if (!in_range_ || result.status == Status::exhausted) return "";
  if (!n.allFinite()) return "a normal that is not finite";
  if (std::isnan(result.t_base) || std::isnan(result.t_offset) || std::isnan(result.offset_lo) ||
      std::isnan(result.offset_hi))
    return "a NaN";
  if (result.status == Status::inside) {
    if (result.t_base != 0 || result.t_offset != 0) return "inside, but not at t = 0";
    if (!n.isZero(0)) return "inside, with a normal";
    claimed_.push_back({at(0, 0), std::string(solver) + ", inside"});
    return "";
  }
  if (!(std::abs(n.norm() - 1) < 64 * epsilon_)) return "a normal of length " + number(n.norm());
  planes_.push_back(n);
  if (result.status == Status::miss) return check_miss(n);

  // A hit.
  if (!std::isfinite(result.t_base) || !std::isfinite(result.t_offset)) return "t is not finite";
  const Real t = Real(result.t_base) + Real(result.t_offset);
  const Real slack = (rounding_ + end_rounding_);
  if (!(t * speed_ >= -slack)) return "a hit behind the ray's origin, t = " + number(t);
  if (!(t * speed_ <= t_max_ * speed_ + slack))
    return "a hit beyond the ray's end, t = " + number(t);
  if (result.offset_lo > result.t_offset || result.offset_hi < result.t_offset)
    return "t is not within its bounds";
  const Vec3<Real> x = at(result.t_base, result.t_offset);
  const Real above = n.dot(x) - height(n);
  if (!(std::abs(above) <= rounding_))
    return "the hit's plane does not hold the hit: " + number(above) + " off (allowed " +
           number(rounding_) + ")";
  claimed_.push_back({x, std::string(solver) + ", hit at t = " + number(t)});
  return "";
}

std::string CastReferee::check_exit(std::string_view solver, const CastResult<double>& entry,
                                    const CastResult<double>& exit) {
  if (!in_range_ || exit.status != Status::hit) return "";
  const Vec3<Real> n = exit.normal.cast<Real>();
  if (!n.allFinite() || !std::isfinite(exit.t_base) || !std::isfinite(exit.t_offset))
    return "an exit that is not finite";
  planes_.push_back(n);
  const Vec3<Real> x = at(exit.t_base, exit.t_offset);
  const Real above = n.dot(x) - height(n);
  if (!(std::abs(above) <= rounding_))
    return "the exit's plane does not hold the exit: " + number(above) + " off (allowed " +
           number(rounding_) + ")";
  claimed_.push_back({x, std::string(solver) +
                             ", exit at t = " + number(Real(exit.t_base) + Real(exit.t_offset))});
  if (entry.status != Status::hit) return "";
  const Vec3<Real> first = at(entry.t_base, entry.t_offset);
  // Entry and exit in order, as distances between planes.
  const Real back = (first - x).dot(direction_ / speed_);
  const Real shallow =
      std::min(std::abs(n.dot(direction_)), std::abs(entry.normal.cast<Real>().dot(direction_))) /
      speed_;
  if (back * shallow > 2 * rounding_) return "the ray leaves before it enters";
  return "";
}

std::string CastReferee::check_claimed() {
  for (const Claim& claim : claimed_) {
    const Vec3<Real>& x = claim.x;
    for (const Vec3<Real>& n : planes_)
      if (const std::string bad = kept_off(claim, n); !bad.empty()) return bad;
    // Towards the point of the hull of the support points so far that is nearest to x.
    std::vector<oracle::Column<3>> points;
    Vec3<Real> n = x;
    for (int step = 0; step < most_steps; ++step) {
      const Real length = n.stableNorm();
      if (!(length > rounding_)) break;
      n /= length;
      if (const std::string bad = kept_off(claim, n); !bad.empty()) return bad;
      points.push_back((shape_.support(n) - centre_ - x) / radius_);
      n = -radius_ * oracle::nearest_to_origin<3>(points, most_turns);
    }
  }
  return "";
}

}  // namespace minkray::fuzz
