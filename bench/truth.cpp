// SPDX-License-Identifier: MIT
#include "bench/truth.h"

#include <bit>
#include <numbers>

#include "core/derived/shape_bounds.h"
#include "tests/oracle/closed_form.h"
#include "tests/oracle/portal.h"
#include "tests/oracle/silhouette.h"
#include "tests/support/ray_families.h"

namespace minkray::bench {
namespace {

/// Not inlined: GCC 12 at -O2 drops the rounding to float for some of a ray's numbers.
template <class To, class From>
[[gnu::noinline]] Ray<To> in_precision(const Ray<From>& ray) {
  return {ray.origin.template cast<To>(), ray.direction.template cast<To>(), To(ray.t_max)};
}

using testing::Long;
constexpr std::string_view coherent = "coherent";

/// A camera five radii away; it sees a square with sides of three radii.
std::vector<Ray<double>> camera_rays(const Ball<double>& ball, std::size_t count) {
  constexpr int block_width = 4, block_height = 2;
  const Vec3<double> forward = Vec3<double>(0.5, 0.7, -0.4).normalized();
  const Vec3<double> right = forward.unitOrthogonal(), up = right.cross(forward);
  const Vec3<double> eye = ball.centre - 5 * ball.radius * forward;
  const int side = static_cast<int>(std::sqrt(static_cast<double>(count)));
  std::vector<Ray<double>> rays;
  for (int y = 0; y < side; y += block_height)
    for (int x = 0; x < side; x += block_width)
      for (int i = 0; i < block_width * block_height; ++i) {
        const double u = 3 * ((x + i % block_width + 0.5) / side - 0.5);
        const double v = 3 * ((y + i / block_width + 0.5) / side - 0.5);
        rays.push_back({eye, ball.radius * (5 * forward + u * right + v * up) / 5});
      }
  return rays;
}

/// The shape's reach along n stays near one point where it has an edge or a vertex.
bool is_smooth(const Shape& shape, const Vec3<double>& n, double radius) {
  constexpr double tilt = 1e-3, least_curvature_radius = 0.1;
  const Vec3<double> s = shape.support(n), a = n.unitOrthogonal(), b = n.cross(a);
  for (int i = 0; i < 6; ++i) {
    const double angle = 2 * std::numbers::pi * i / 6;
    const Vec3<double> turned = n + tilt * (std::cos(angle) * a + std::sin(angle) * b);
    if ((shape.support(turned) - s).norm() < least_curvature_radius * tilt * radius) return false;
  }
  return true;
}

Truth truth_of(const Shape& shape, const testing::PortalCast& portal, const Ray<double>& ray,
               const Ball<double>& ball) {
  // The closed forms lose digits to far origins: moved near, by a step whose product is exact.
  const Vec3<Long> d = ray.direction.cast<Long>();
  const auto base = Long(static_cast<float>((ball.centre - ray.origin).dot(ray.direction) /
                                            ray.direction.squaredNorm()));
  const Vec3<Long> o = ray.origin.cast<Long>() + base * d;
  const testing::PortalHit slow = portal(o, d, 1e-15L);
  Truth truth;
  truth.t_base = base;
  if (const auto exact = testing::line_in_shape(shape, o, d)) {
    truth.answer = exact->empty() ? Truth::Answer::miss : Truth::Answer::hit;
    truth.t_offset = exact->lower;
  } else if (slow.answer != testing::PortalHit::Answer::undecided) {
    truth.answer =
        slow.answer == testing::PortalHit::Answer::hit ? Truth::Answer::hit : Truth::Answer::miss;
    truth.t_offset = slow.t_lo;
  }
  if (truth.answer != Truth::Answer::hit) return truth;
  // If the portal has no result, the cosine of errors is unknown too.
  if (slow.answer != testing::PortalHit::Answer::hit) return {};
  truth.normal = slow.normal.cast<double>();
  truth.is_smooth = is_smooth(shape, truth.normal, ball.radius);
  return truth;
}

void mix(std::uint64_t& hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x100000001b3u;
}

}  // namespace

std::vector<std::string> family_names() {
  std::vector<std::string> names = {std::string(coherent)};
  for (const auto& family : testing::ray_families)
    if (family.family != testing::RayFamily::camera) names.emplace_back(family.name);
  return names;
}

RaysWithTruth make_rays(const Shape& shape, std::string_view family, std::size_t count) {
  RaysWithTruth made;
  made.batch.coherent = family == coherent;
  const Ball<double> ball = ball_around(bounds_of(shape));
  made.radius = ball.radius;
  std::vector<Ray<double>> wished;
  if (made.batch.coherent) {
    wished = camera_rays(ball, count);
  } else {
    for (const auto& description : testing::ray_families) {
      if (description.name != family) continue;
      testing::FamilyRays source(shape, description.family, 2004);
      while (wished.size() < count) wished.push_back(source.next());
    }
  }
  const testing::PortalCast portal(shape);
  for (Ray<double>& ray : wished) {
    ray.t_max = 2 * (ball.centre - ray.origin).norm() / ray.direction.norm();
    const Ray<float> in_float = in_precision<float>(ray);
    made.batch.in_float.push_back(in_float);
    made.batch.in_double.push_back(in_precision<double>(in_float));
    made.truths.push_back(truth_of(shape, portal, made.batch.in_double.back(), ball));
  }
  return made;
}

Spread Spread::of(std::vector<double>& values) {
  Spread spread;
  if (values.empty()) return spread;
  std::sort(values.begin(), values.end());
  for (const double value : values) spread.mean += value;
  spread.mean /= static_cast<double>(values.size());
  spread.most_of_all = values[(values.size() - 1) * 999 / 1000];
  spread.max = values.back();
  return spread;
}

Judgement judge(const Shape& shape, const RaysWithTruth& rays, std::span<const Hit> hits,
                double band) {
  Judgement all;
  all.rays = hits.size();
  all.band = band;
  all.hash = 0xcbf29ce484222325u;
  std::vector<double> of_hits, of_misses, along_normal, along_ray, angles;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Hit& hit = hits[i];
    const Truth& truth = rays.truths[i];
    const Ray<double>& ray = rays.batch.in_double[i];
    mix(all.hash, static_cast<std::uint64_t>(hit.outcome));
    mix(all.hash, std::bit_cast<std::uint64_t>(hit.t_base + hit.t_offset));
    if (hit.outcome == Outcome::exhausted) {
      ++all.exhausted;
      continue;
    }
    const bool is_hit = hit.outcome == Outcome::hit;
    (is_hit ? of_hits : of_misses).push_back(hit.supports);
    if (truth.answer == Truth::Answer::unknown) {
      ++all.unknown;
      continue;
    }
    if (is_hit != (truth.answer == Truth::Answer::hit)) {
      ++all.wrong;
      if (std::abs(testing::room_in_shadow(shape, ray)) > band * rays.radius)
        ++(is_hit ? all.false_hits : all.false_misses);
      continue;
    }
    if (!is_hit) continue;
    ++all.hits;
    const auto late = static_cast<double>((Long(hit.t_base) - truth.t_base) +
                                          (Long(hit.t_offset) - truth.t_offset));
    const double length = std::abs(late) / rays.radius;
    along_ray.push_back(length * ray.direction.norm());
    along_normal.push_back(length * std::abs(truth.normal.dot(ray.direction)));
    const Vec3<double> normal = hit.normal.cast<double>().normalized();
    if (truth.is_smooth && normal.squaredNorm() > 0.5)
      angles.push_back(2 * std::asin(std::min(1.0, (normal - truth.normal).norm() / 2)));
  }
  all.supports_of_hits = Spread::of(of_hits);
  all.supports_of_misses = Spread::of(of_misses);
  all.along_normal = Spread::of(along_normal);
  all.along_ray = Spread::of(along_ray);
  all.normal_angle = Spread::of(angles);
  return all;
}

}  // namespace minkray::bench
