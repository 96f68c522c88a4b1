// SPDX-License-Identifier: MIT
// Casts at sums and differences of two operands, compared with a portal refinement in long double.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "tests/oracle/portal.h"
#include "tests/support/ray_families.h"
#include "tests/support/values_asked_for.h"

namespace minkray::testing {
namespace {

struct OfTwo {
  std::string name;
  Shape shape;
};
void PrintTo(const OfTwo& row, std::ostream* out) {
  *out << row.name;
}

Shape turned(const Shape& shape, std::uint64_t seed) {
  return Transform{shape, AffineMap(Affine<double>{Random(seed).rotation(), {0.3, -0.2, 0.1}})};
}

std::vector<OfTwo> sums_of_two() {
  Random random(3);
  std::vector<Vec3<double>> points;
  for (int i = 0; i < 12; ++i) points.push_back(0.6 * random.direction());
  const std::vector<OfTwo> operands = {
      {"segment", Segment{{Vec3<double>(0, 0.1, -0.5), Vec3<double>(0.2, 0, 0.4)}}},
      {"box", Box{{0.3, 0.5, 0.2}}},
      {"hull", Hull{PointCloud(points)}},
      {"capsule", Capsule{0.2, 0.4}},
      {"cylinder", Cylinder{0.4, 0.5}},
      {"cone", Cone{0.5, 0.4}},
      {"frustum", Frustum{{0.5, 0.2}, 0.4}},
      {"disk", Disk{0.5}},
      {"ellipsoid", Ellipsoid{{0.2, 0.6, 0.4}}},
      {"needle", Cylinder{0.004, 0.5}},
      {"large", Cone{30, 20}},
  };
  std::vector<OfTwo> rows;
  std::uint64_t seed = 0;
  for (const OfTwo& a : operands)
    for (const OfTwo& b : operands) {
      const Shape other = turned(b.shape, ++seed);
      const bool adds = seed % 2 == 0;
      rows.push_back({a.name + (adds ? "_and_" : "_less_") + b.name,
                      adds ? Shape(MinkowskiSum{{a.shape, other}})
                           : Shape(MinkowskiDifference{a.shape, other})});
    }
  for (const OfTwo& a : operands)
    rows.push_back({"grown_" + a.name,
                    Rounded{0.1, Shape(MinkowskiSum{{a.shape, turned(Cone{0.3, 0.2}, ++seed)}})}});
  return rows;
}

class SumsOfTwo : public ::testing::TestWithParam<OfTwo> {};

/// As a distance between planes, in radii.
constexpr Long gap = 1e-16L;
/// The oracle moves a far origin near the shape in one step, along a rounded unit vector.
constexpr Long oracle_rounding = 8 * std::numeric_limits<Long>::epsilon();

void expect_within(const CastResult<double>& result, const PortalHit& truth,
                   const std::string& of) {
  const Long base = result.t_base, rounding = oracle_rounding * std::abs(base);
  EXPECT_LE(base + result.offset_lo, truth.t_hi + rounding) << of;
  EXPECT_GE(base + result.offset_hi, truth.t_lo - rounding) << of;
}

/// Compares one ray. Returns true for a hit.
bool compare(const PreparedShape& shape, const PortalCast& portal, const Ray<double>& ray,
             const std::string& of) {
  const CastResult<double> result = cast_ray(shape, ray);
  EXPECT_NE(result.status, Status::exhausted) << of;
  const Vec3<Long> o = ray.origin.cast<Long>(), d = ray.direction.cast<Long>();
  const PortalHit truth = portal(o, d, gap);
  if (truth.answer == PortalHit::Answer::undecided) return false;
  const bool is_hit = truth.answer == PortalHit::Answer::hit;
  EXPECT_EQ(result.status == Status::hit, is_hit) << of;
  if (!is_hit || result.status != Status::hit) return false;
  expect_within(result, truth, of);

  // From the middle of the chord the ray begins inside, and leaves where the opposite ray enters.
  const Vec3<Long> back = -d;
  const PortalHit exit = portal(o, back, gap);
  if (exit.answer != PortalHit::Answer::hit) return true;
  const Long chord = -exit.t_hi - truth.t_hi;
  if (!(chord * d.norm() > 1e-6L * portal.radius())) return true;
  const Ray<double> within{(o + (truth.t_hi + chord / 2) * d).cast<double>(), ray.direction};
  EXPECT_EQ(cast_ray(shape, within).status, Status::inside) << of;
  const CastResult<double> leaving = cast_exit(shape, ray);
  EXPECT_EQ(leaving.status, Status::hit) << of;
  EXPECT_LE(Long(leaving.t_base) + Long(leaving.t_offset), -exit.t_lo + 1e-9L) << of;
  EXPECT_GE(Long(leaving.t_base) + Long(leaving.offset_hi),
            -exit.t_hi - oracle_rounding * std::abs(exit.t_hi))
      << of;

  // Past the shape, and in the opposite direction, it misses.
  const Ray<double> past{(o + (-exit.t_lo + chord / 4) * d).cast<double>(), ray.direction};
  EXPECT_EQ(cast_ray(shape, past).status, Status::miss) << of;
  for (const Long beyond : {1e-6L, 1e-8L}) {
    const Long t = -exit.t_lo + beyond * portal.radius() / d.norm();
    const Ray<double> just_past{(o + t * d).cast<double>(), ray.direction};
    EXPECT_EQ(cast_ray(shape, just_past).status, Status::miss) << of;
  }
  Ray<double> shorter = ray;
  shorter.t_max = static_cast<double>(truth.t_lo - chord / 4);
  if (shorter.t_max > 0) {
    EXPECT_EQ(cast_ray(shape, shorter).status, Status::miss) << of;
  }
  return true;
}

TEST_P(SumsOfTwo, are_met_within_the_bounds) {
  const OfTwo& row = GetParam();
  const PreparedShape shape(row.shape);
  const PortalCast portal(row.shape);
  for (const auto& [family, count, least] : {std::tuple(RayFamily::random, 20, 5),
                                             {RayFamily::grazing, 10, 2},
                                             {RayFamily::far, 5, 1}}) {
    FamilyRays rays(row.shape, family, 11);
    int hits = 0;
    for (int i = 0; i < count; ++i)
      hits += compare(shape, portal, rays.next(),
                      std::string(name_of(family)) + " " + std::to_string(i));
    EXPECT_GE(hits, least) << name_of(family);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, SumsOfTwo, values_asked_for<SumsOfTwo>(sums_of_two),
                         [](const auto& tested) { return tested.param.name; });

/// The plane of a miss separates the ray from the shape from beginning to end.
TEST(SumsOfTwo, are_missed_by_a_plane) {
  for (const OfTwo& row : sums_of_two()) {
    const PreparedShape shape(row.shape);
    FamilyRays rays(row.shape, RayFamily::random, 12);
    for (int i = 0; i < 40; ++i) {
      Ray<double> ray = rays.next();
      if (i % 2 == 1) ray.t_max = 0.75;  // ends near the shape
      const CastResult<double> result = cast_ray(shape, ray);
      if (result.status != Status::miss) continue;
      const Vec3<double>& n = result.normal;
      const double reach = n.dot(row.shape.support(n)), begin = n.dot(ray.origin),
                   towards = n.dot(ray.direction);
      EXPECT_GT(begin, reach) << row.name << " " << i;
      if (std::isinf(ray.t_max)) {
        EXPECT_GE(towards, -1e-14 * ray.direction.norm()) << row.name << " " << i;
      } else {
        EXPECT_GT(begin + ray.t_max * towards, reach) << row.name << " " << i;
      }
    }
  }
}

Shape placed(const Shape& shape, const std::array<double, 9>& rows) {
  Mat3<double> turn;
  for (int i = 0; i < 9; ++i) turn(i / 3, i % 3) = rows[static_cast<std::size_t>(i)];
  return Transform{shape, AffineMap(Affine<double>{turn, {0, 0, 0}})};
}

/// The ray begins 3e-9 R past a sum of two cones. Four points of the sum around the beginning are
/// the corners of a thin tetrahedron, so rounding tilts its faces: "inside" was returned once.
TEST(SumsOfTwo, do_not_contain_a_start_just_outside) {
  const Shape thin = placed(Cone{0.0071767948465549705, 0.73420315724174467},
                            {0.6847002463324261, -0.52003408747118829, -0.51063697529685759,
                             0.70145709097061515, 0.28001126564076761, 0.6554018924608761,
                             -0.19784721933693508, -0.80694376444846772, 0.55650538076318612});
  const Shape thick = placed(Cone{3.4657316135220646, 5.4089113112007263},
                             {0.040541135570657083, -0.047961091459216759, 0.99802612692889092,
                              0.41260756851949953, 0.91050880310596383, 0.026994700720173015,
                              -0.9100062696086596, 0.41069873772947718, 0.056702170155524367});
  const PreparedShape sum(
      placed(MinkowskiSum{{thin, thick}},
             {0.59189353999188699, -0.71959512495929534, 0.36310452138563176, -0.031662245125010147,
              0.4293871214310987, 0.90256534510403108, -0.80539402751045797, -0.54571930154973558,
              0.23136746609355574}));
  const Ray<double> ray{{-0.099471460462513761, 1.8283347327411121, -1.2042897329016569},
                        {-0.10954258974469901, 0.36657826652243536, -0.23158486239462954}};
  EXPECT_EQ(cast_ray(sum, ray).status, Status::miss);
}

/// The triangle of points that bounds t from above is 3e-10 wide. Weights of its corners are
/// rounded to 1e-7, and the bound was once too early by 2e-14 R.
TEST(SumsOfTwo, are_bounded_by_thin_triangles) {
  const Shape needle = placed(Cylinder{0.0054533121962582519, 1.0318090973756797},
                              {0.33631997887907217, 0.62580039465637127, 0.70374905886595029,
                               -0.13259363487970929, 0.77130194540170915, -0.62250480882393622,
                               -0.93236677321543748, 0.11604815839757637, 0.34238140302353492});
  const Shape box = placed(Box{{0.25346761738055473, 0.0026625870360263309, 0.21695894449702091}},
                           {1, 0, 0, 0, -2.2204460492503131e-16, -1.0000000000000002, 0,
                            1.0000000000000002, -2.2204460492503131e-16});
  const Shape shape = placed(Rounded{0.046221865942275814, Shape(MinkowskiDifference{needle, box})},
                             {-0.42918452347726488, 0.33348183577719015, -0.83939889803017265,
                              -0.69099548395079757, -0.71971244590811589, 0.067373855200370092,
                              -0.58165787707826666, 0.60893666371112243, 0.53932388563939138});
  const Ray<double> ray{{-2.496680343116779, -3.0905215225496381, -8.0323398830099357},
                        {2.6133392589791558, 3.4547919316324913, 8.0605610828182233}};
  EXPECT_TRUE(compare(PreparedShape(shape), PortalCast(shape), ray, "needle less box"));
}

TEST(SumsOfTwo, take_few_support_points) {
  for (const OfTwo& row : sums_of_two()) {
    const PreparedShape shape(row.shape);
    if (!shape.definition().operands()) continue;
    FamilyRays rays(row.shape, RayFamily::random, 13);
    constexpr int count = 50, most = 30;
    int supports = 0;
    for (int i = 0; i < count; ++i) supports += cast_ray(shape, rays.next()).supports;
    EXPECT_LT(supports, most * count) << row.name;
  }
}

}  // namespace
}  // namespace minkray::testing
