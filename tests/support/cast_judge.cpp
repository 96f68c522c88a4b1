// SPDX-License-Identifier: MIT
#include "tests/support/cast_judge.h"

#include <algorithm>
#include <cmath>

#include "tests/oracle/silhouette.h"

namespace minkray::testing {

using Long = long double;
namespace {

/// Hits at planes with a smaller slope against the ray count as tangent.
constexpr double tangent_slope = 0x1p-20;
/// Distance from the silhouette within which hit and miss may be mistaken, in units of R.
constexpr double band = 1e-12;

}  // namespace

CastJudge::CastJudge(const Shape& shape)
    : shape_(shape), ball_(ball_around(bounds_of(shape))), entries_(shape) {}

/// The cosine between the ray and a normal, if that is one of the shape where the ray enters, to
/// within float's rounding; else 1, which allows least.
double CastJudge::cosine_at(const Ray<double>& ray, Long t, const Vec3<double>& normal) const {
  const Vec3<double> n = normal.normalized();
  const Vec3<Long> x = ray.origin.cast<Long>() + t * ray.direction.cast<Long>();
  const auto beyond = static_cast<double>(n.cast<Long>().dot(shape_.support(n).cast<Long>() - x));
  if (!(std::abs(beyond) <= 5e-7 * ball_.radius)) return 1;
  return std::abs(n.dot(ray.direction)) / ray.direction.norm();
}

TrueEntry CastJudge::truth(const Ray<double>& ray, const Vec3<double>& normal) const {
  return truth(ray, Vec3<Long>::Zero(), normal);
}

TrueEntry CastJudge::truth(const Ray<double>& ray, const Vec3<Long>& move,
                           const Vec3<double>& normal) const {
  // Moved near, by a step with few digits, whose products are exact in long double.
  const auto base = Long(static_cast<float>((ball_.centre - ray.origin).dot(ray.direction) /
                                            ray.direction.squaredNorm()));
  const Vec3<Long> d = ray.direction.cast<Long>();
  TrueEntry truth;
  truth.entry = entries_(ray.origin.cast<Long>() + base * d + move, d, normal);
  truth.entry.t += base;
  if (truth.entry.answer == LineEntry::Answer::hit)
    truth.cosine = cosine_at(ray, truth.entry.t, normal);
  return truth;
}

Judgement CastJudge::operator()(const Ray<double>& ray, const CastResult<double>& answer,
                                const TrueEntry& truth) const {
  if (answer.status == Status::exhausted) return {Verdict::exhausted};
  if (truth.entry.answer == LineEntry::Answer::undecided) return {Verdict::undecided};
  const auto is_at_silhouette = [&] {
    return std::abs(room_in_shadow(shape_, ray)) <= band * ball_.radius;
  };
  const bool is_hit = answer.status == Status::hit;
  if (is_hit != (truth.entry.answer == LineEntry::Answer::hit))
    return {is_at_silhouette() ? Verdict::at_silhouette : Verdict::wrong};
  if (!is_hit) return {Verdict::right};
  const Long late = (Long(answer.t_base) - truth.entry.t) + Long(answer.t_offset);
  const double cosine = std::min(truth.cosine, cosine_at(ray, truth.entry.t, answer.normal));
  const double error =
      std::abs(static_cast<double>(late)) * ray.direction.norm() * cosine / ball_.radius;
  // Along a side: entered anywhere, or not at all.
  if (!(error <= band) && is_at_silhouette()) return {Verdict::at_silhouette, error};
  return {Verdict::right, error};
}

double CastJudge::error_by_bound(const Ray<double>& ray, const CastResult<double>& answer,
                                 const TrueEntry& truth) const {
  const Long unknown = 8 * std::numeric_limits<Long>::epsilon() *
                       (ray.origin.norm() + ball_.radius) / (ray.direction.norm() * truth.cosine);
  const Long error = truth.entry.t - answer.t_base - answer.t_offset;
  const Long bound = error > 0 ? Long(answer.offset_hi) - answer.t_offset
                               : Long(answer.t_offset) - answer.offset_lo;
  const Long certain = std::max(Long(0), std::abs(error) - unknown);
  if (!(certain > bound)) return certain == 0 ? 0 : static_cast<double>(certain / bound);
  const Long end = Long(answer.t_base) + (error > 0 ? answer.offset_hi : answer.offset_lo);
  const double slope = -answer.normal.dot(ray.direction) / ray.direction.norm();
  const bool is_excused = slope > tangent_slope && meets_edge(ray, end, error > 0);
  return is_excused ? 1 : static_cast<double>(certain / bound);
}

/// True if the ray misses, or its t is within the interval's end, after a small move.
bool CastJudge::meets_edge(const Ray<double>& ray, Long end, bool is_upper) const {
  const Long step = std::numeric_limits<double>::epsilon() / 2 * ball_.radius;
  const Vec3<Long> d = ray.direction.cast<Long>();
  const Vec3<Long> u = d.unitOrthogonal(), v = d.cross(u).normalized();
  for (const Vec3<Long>& move : {u, v, Vec3<Long>(-u), Vec3<Long>(-v)}) {
    const TrueEntry moved = truth(ray, step * move, Vec3<double>(-ray.direction));
    if (moved.entry.answer != LineEntry::Answer::hit) return true;
    if (is_upper ? moved.entry.t <= end : moved.entry.t >= end) return true;
  }
  return false;
}

}  // namespace minkray::testing
