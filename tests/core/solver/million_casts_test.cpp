// SPDX-License-Identifier: MIT
// A million casts, each beside an oracle in long double: no hit is taken for a miss or the other
// way round, and no t is further off than is promised. `./run bench --many` casts many more.
#include <gtest/gtest.h>

#include <cctype>

#include "core/shape/convert.h"
#include "core/shape/shape_bounds.h"
#include "core/solver/cast.h"
#include "tests/oracle/line_entry.h"
#include "tests/oracle/silhouette.h"
#include "tests/support/measured_shapes.h"
#include "tests/support/ray_families.h"
#include "tests/support/rounded.h"

namespace minkray::testing {
namespace {

using Long = long double;

struct Promise {
  double band;   ///< how near the silhouette hit and miss may be mistaken, in radii
  double error;  ///< the greatest |t - exact| * cosine, in radii
};
template <class T>
constexpr Promise promise = std::is_same_v<T, float> ? Promise{1e-6, 5e-7} : Promise{1e-12, 1e-12};

class MillionCasts : public ::testing::TestWithParam<MeasuredShape> {};

template <class T>
void expect_right(const MeasuredShape& measured, RayFamily family, int rays) {
  const Shape<T> shape = convert<T>(measured.shape);
  const Shape<double> same = convert<double>(shape);
  const PreparedShape<T> prepared(shape);
  const LineEntries entries(same);
  FamilyRays source(same, family, 77);
  const Ball<double> ball = source.ball();
  int hits = 0;
  for (int i = 0; i < rays; ++i) {
    const Ray<T> ray = rounded_to<T>(source.next());
    const Ray<double> same_ray = in_double(ray);
    const CastResult<T> answer = cast_ray(prepared, ray);
    ASSERT_NE(name_of(answer.status), name_of(Status::exhausted)) << i;
    const Vec3<double> normal = answer.normal.template cast<double>();
    const LineEntry exact =
        entries(same_ray.origin.cast<Long>(), same_ray.direction.cast<Long>(), normal);
    ASSERT_NE(exact.answer, LineEntry::Answer::undecided) << i;
    const bool is_hit = answer.status == Status::hit;
    const auto is_at_silhouette = [&] {
      return std::abs(room_in_shadow(same, same_ray)) <= promise<T>.band * ball.radius;
    };
    if (is_hit != (exact.answer == LineEntry::Answer::hit)) {
      ASSERT_TRUE(is_at_silhouette()) << name_of(answer.status) << " at ray " << i;
      continue;
    }
    if (!is_hit) continue;
    ++hits;
    const Long late = (Long(answer.t_base) - exact.t) + Long(answer.t_offset);
    const double error =
        std::abs(double(late) * normal.normalized().dot(same_ray.direction)) / ball.radius;
    ASSERT_TRUE(error <= promise<T>.error || is_at_silhouette()) << error << " at ray " << i;
  }
  EXPECT_GT(hits, rays / 50);
  EXPECT_LT(hits, rays);
}

TEST_P(MillionCasts, are_right) {
  expect_right<float>(GetParam(), RayFamily::random, 30000);
  expect_right<double>(GetParam(), RayFamily::random, 30000);
  expect_right<float>(GetParam(), RayFamily::grazing, 4000);
  expect_right<double>(GetParam(), RayFamily::grazing, 4000);
}

INSTANTIATE_TEST_SUITE_P(Shapes, MillionCasts, ::testing::ValuesIn(measured_shapes()),
                         [](const auto& tested) {
                           std::string name = tested.param.name;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

}  // namespace
}  // namespace minkray::testing
