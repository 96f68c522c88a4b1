// SPDX-License-Identifier: MIT
// Casts do not care for the frame or the unit of length: turned, moved and scaled together, ray and
// shape meet at the same parameter.
#include "core/solver/cast.h"
#include "tests/fuzz/extent.h"
#include "tests/support/property.h"

namespace minkray::testing {
namespace {

using S = Shape<double>;
using P = Vec3<double>;

constexpr int draws = 3000;

struct Case {
  S shape;
  Ray<double> ray;
};

Case draw_case() {
  const std::string drawn = draw_bytes(128);
  fuzz::Bytes bytes(drawn);
  const S shape = fuzz::shape_from<double>(bytes, false, 2);
  const Ray<double> ray = fuzz::ray_from(bytes, shape, false);
  RC_LOG() << write_shape(shape).dump() << "\norigin " << ray.origin.transpose() << " direction "
           << ray.direction.transpose() << " t_max " << ray.t_max << '\n';
  return {shape, ray};
}

Case mapped(const Case& original, const Affine<double>& map) {
  return {S(Transform<double>{original.shape, AffineMap<double>(map)}),
          {map(original.ray.origin), map.linear * original.ray.direction, original.ray.t_max}};
}

CastResult<double> cast(const Case& query) {
  return cast_ray(PreparedShape<double>(query.shape), query.ray);
}

/// As a distance: the rounding of two casts (tests/core/solver/cast_truths_test.cpp), relative to
/// the largest numbers that occur.
double rounding(const Case& a) {
  constexpr double allowed = 2048;
  const fuzz::Extent extent = fuzz::extent_of(a.shape);
  double reach = static_cast<double>(extent.size * extent.condition) + a.ray.origin.norm();
  if (std::isfinite(a.ray.t_max)) reach += a.ray.t_max * a.ray.direction.norm();
  return allowed * std::numeric_limits<double>::epsilon() * reach;
}

TEST(Equivariance, turned_and_moved_a_cast_finds_the_same) {
  int hits = 0, misses = 0;
  expect_always(
      [&] {
        const Case plain = draw_case();
        const P by = draw_direction();
        const Affine<double> map{draw_rotation(), by};
        const Case turned = mapped(plain, map);
        const CastResult<double> a = cast(plain), b = cast(turned);
        const double allowed = rounding(plain) + rounding(turned);
        if (a.status == Status::exhausted || b.status == Status::exhausted) return;
        hits += a.found() ? 1 : 0;
        misses += a.found() ? 0 : 1;
        if (a.found() && b.found()) {
          // As a distance between planes: t is as much less certain as the ray grazes.
          const double towards = std::max(std::abs(a.normal.dot(plain.ray.direction)),
                                          std::abs(b.normal.dot(turned.ray.direction)));
          RC_ASSERT(std::abs(a.t() - b.t()) * towards <= allowed);
        } else if (a.found() != b.found()) {
          // Only a touch may be taken for a miss: the plane of the miss lies at the point found.
          const Case& at = a.found() ? plain : turned;
          const double t = a.found() ? a.t() : b.t();
          const P n = a.found() ? P(map.linear.transpose() * b.normal) : P(map.linear * a.normal);
          RC_ASSERT(n.dot(at.ray.at(t) - at.shape.support(n)) <= allowed);
        }
      },
      draws);
  EXPECT_GT(hits, draws / 4);
  EXPECT_GT(misses, draws / 8);
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

}  // namespace
}  // namespace minkray::testing
