// SPDX-License-Identifier: MIT
#include "tests/support/cast_judge.h"

#include <algorithm>
#include <cmath>

#include "tests/oracle/silhouette.h"

namespace minkray::testing {

using Long = long double;

namespace {

/// Distance from the silhouette within which hit and miss may be mistaken, in units of R.
template <class T>
constexpr double band = std::is_same_v<T, float> ? 1e-6 : 1e-12;

}  // namespace

CastJudge::CastJudge(const Shape<double>& shape)
    : shape_(shape), ball_(ball_around(bounds_of<double>(shape))), entries_(shape) {}

/// The cosine between the ray and a normal, if that is one of the shape where the ray enters, to
/// within float's rounding; else 1, which allows least.
double CastJudge::cosine_at(const Ray<double>& ray, Long t, const Vec3<double>& normal) const {
  const Vec3<double> n = normal.normalized();
  const Vec3<Long> x = ray.origin.cast<Long>() + t * ray.direction.cast<Long>();
  const auto beyond = static_cast<double>(n.cast<Long>().dot(shape_.support(n).cast<Long>() - x));
  if (!(std::abs(beyond) <= allowed_error<float> * ball_.radius)) return 1;
  return std::abs(n.dot(ray.direction)) / ray.direction.norm();
}

TrueEntry CastJudge::truth(const Ray<double>& ray, const Vec3<double>& normal) const {
  // Moved near, by a step whose product is exact for rays of floats.
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

template <class T>
Judgement CastJudge::operator()(const Ray<double>& ray, const CastResult<T>& answer,
                                const TrueEntry& truth) const {
  if (answer.status == Status::exhausted) return {Verdict::exhausted};
  if (truth.entry.answer == LineEntry::Answer::undecided) return {Verdict::undecided};
  const auto is_at_silhouette = [&] {
    return std::abs(room_in_shadow(shape_, ray)) <= band<T> * ball_.radius;
  };
  const bool is_hit = answer.status == Status::hit;
  if (is_hit != (truth.entry.answer == LineEntry::Answer::hit))
    return {is_at_silhouette() ? Verdict::at_silhouette : Verdict::wrong};
  if (!is_hit) return {Verdict::right};
  const Long late = (Long(answer.t_base) - truth.entry.t) + Long(answer.t_offset);
  const double cosine =
      std::min(truth.cosine, cosine_at(ray, truth.entry.t, answer.normal.template cast<double>()));
  const double error =
      std::abs(static_cast<double>(late)) * ray.direction.norm() * cosine / ball_.radius;
  // Along a side: entered anywhere, or not at all.
  if (!(error <= band<T>)&&is_at_silhouette()) return {Verdict::at_silhouette, error};
  return {Verdict::right, error};
}

template Judgement CastJudge::operator()(const Ray<double>&, const CastResult<float>&,
                                         const TrueEntry&) const;
template Judgement CastJudge::operator()(const Ray<double>&, const CastResult<double>&,
                                         const TrueEntry&) const;

}  // namespace minkray::testing
