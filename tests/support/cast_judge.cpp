// SPDX-License-Identifier: MIT
#include "tests/support/cast_judge.h"

#include <algorithm>
#include <cmath>

#include "tests/oracle/silhouette.h"

namespace minkray::testing {

using Long = long double;

namespace {

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
  // Moved near, by a step with few digits, whose products are exact in long double.
  const auto base = Long(static_cast<float>((ball_.centre - ray.origin).dot(ray.direction) /
                                            ray.direction.squaredNorm()));
  const Vec3<Long> d = ray.direction.cast<Long>();
  TrueEntry truth;
  truth.entry = entries_(ray.origin.cast<Long>() + base * d, d, normal);
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

}  // namespace minkray::testing
