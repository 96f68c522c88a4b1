// SPDX-License-Identifier: MIT
// Casts do not care for the frame or the unit of length: turned, moved and scaled together, ray and
// shape meet at the same parameter.
#include "core/cast/cast.h"
#include "tests/fuzz/extent.h"
#include "tests/support/property.h"

namespace minkray::testing {
namespace {

using S = Shape;
using P = Vec3<double>;

constexpr int draws = 3000;

struct Case {
  S shape;
  Ray<double> ray;
};

Case draw_case() {
  const std::string drawn = draw_bytes(128);
  fuzz::Bytes bytes(drawn);
  const S shape = fuzz::shape_from(bytes, false, 2);
  const Ray<double> ray = fuzz::ray_from(bytes, shape, false);
  RC_LOG() << write_shape(shape).dump() << "\norigin " << ray.origin.transpose() << " direction "
           << ray.direction.transpose() << " t_max " << ray.t_max << '\n';
  return {shape, ray};
}

Case mapped(const Case& original, const Affine<double>& map) {
  return {S(Transform{original.shape, AffineMap(map)}),
          {map(original.ray.origin), map.linear * original.ray.direction, original.ray.t_max}};
}

CastResult<double> cast(const Case& query) {
  return cast_ray(PreparedShape(query.shape), query.ray);
}

/// Allows, as a distance, the rounding of two casts (tests/core/cast/cast_truths_test.cpp),
/// relative to the largest numbers that occur.
double rounding(const Case& a) {
  constexpr double allowed = 2048;
  const fuzz::Extent extent = fuzz::extent_of(a.shape);
  double reach = static_cast<double>(extent.size * extent.condition) + a.ray.origin.norm();
  if (std::isfinite(a.ray.t_max)) reach += a.ray.t_max * a.ray.direction.norm();
  return allowed * std::numeric_limits<double>::epsilon() * reach;
}

struct Counts {
  int hits = 0, misses = 0;
};

/// The case and its image under a map that keeps shapes similar, each with its answer.
void expect_same(const Case& plain, const Case& image, const Affine<double>& map, Counts& counts) {
  const CastResult<double> a = cast(plain), b = cast(image);
  if (a.status == Status::exhausted || b.status == Status::exhausted) return;
  // The image's lengths in the plain case's.
  const double scale = map.linear.col(0).norm();
  const double allowed = rounding(plain) + rounding(image) / scale;
  (a.found() ? counts.hits : counts.misses) += 1;
  const P n_a = a.normal, n_b = b.normal;
  if (a.found() && b.found()) {
    // As a distance between planes: t is as much less certain as the ray grazes.
    const double towards = std::max(std::abs(n_a.dot(plain.ray.direction)),
                                    std::abs(n_b.dot(image.ray.direction) / scale));
    RC_ASSERT(std::abs(double(a.t()) - double(b.t())) * towards <= allowed);
  } else if (a.found() != b.found()) {
    // Only a touch may be taken for a miss: the plane of the miss lies at the point found.
    const Case& at = a.found() ? plain : image;
    const double t = a.found() ? double(a.t()) : double(b.t());
    const P n = a.found() ? P(map.linear.transpose() * n_b / scale) : P(map.linear * n_a / scale);
    const double gap = n.dot(at.ray.at(t) - at.shape.support(n));
    RC_ASSERT((a.found() ? gap : gap / scale) <= allowed);
  }
}

TEST(Equivariance, turned_and_moved_a_cast_finds_the_same) {
  Counts counts;
  expect_always(
      [&] {
        const Case plain = draw_case();
        const P by = draw_direction();
        const Affine<double> map{draw_rotation(), by};
        expect_same(plain, mapped(plain, map), map, counts);
      },
      draws);
  EXPECT_GT(counts.hits, draws / 4);
  EXPECT_GT(counts.misses, draws / 8);
}

TEST(Equivariance, half_the_speed_takes_twice_as_long) {
  int hits = 0;
  expect_always(
      [&] {
        const Case plain = draw_case();
        Case slower = plain;
        slower.ray.direction *= 0.5;
        slower.ray.t_max *= 2;
        const CastResult<double> a = cast(plain), b = cast(slower);
        RC_ASSERT(a.status == b.status);
        if (a.status != Status::hit) return;
        ++hits;
        RC_ASSERT(2 * a.t() == b.t());
      },
      draws);
  EXPECT_GT(hits, draws / 4);
}

void expect_same_at(int exponent) {
  const Affine<double> map{Mat3<double>::Identity() * std::ldexp(1.0, exponent), P::Zero()};
  Counts counts;
  expect_always(
      [&] {
        const Case plain = draw_case();
        expect_same(plain, mapped(plain, map), map, counts);
      },
      draws / 3);
  EXPECT_GT(counts.hits, draws / 12);
  EXPECT_GT(counts.misses, draws / 24);
}

TEST(Equivariance, sizes_of_1e30_and_1e_30_are_like_any_other) {
  for (const int exponent : {-100, -60, 60, 100}) {
    SCOPED_TRACE(exponent);
    expect_same_at(exponent);
  }
}

}  // namespace
}  // namespace minkray::testing
