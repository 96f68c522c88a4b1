// SPDX-License-Identifier: MIT
// Casts at rounded boxes of all proportions, flat ones too, and at sums of boxes and ellipsoids,
// against bisection in long double: the hit, what is missed, and how many support calls it takes.
#include <gtest/gtest.h>

#include "tests/support/cast_truth.h"

namespace minkray::testing {
namespace {

using Long = long double;

/// A box's half extents and the radii of the ellipsoid that it is rounded by.
struct Form {
  Vec3<double> half_extents, radii;

  Form(const Vec3<double>& box, double radius) : Form(box, Vec3<double>::Constant(radius)) {}
  Form(const Vec3<double>& box, const Vec3<double>& ellipsoid)
      : half_extents(box), radii(ellipsoid) {}

  bool is_by_ball() const { return radii == Vec3<double>::Constant(radii.x()); }
  Shape shape() const {
    const Shape box = Box{half_extents};
    if (is_by_ball()) return Rounded{radii.x(), box};
    return MinkowskiSum{{box, Shape(Ellipsoid{radii})}};
  }
  /// Factor of rounding that is relative to size.
  double slenderness() const { return radii.maxCoeff() / radii.minCoeff(); }
};

/// Distance from the box in units of the radii, along a line.
struct FromBox {
  Vec3<Long> units, h, o, d;

  FromBox(const Form& form, const Ray<double>& ray)
      : units(form.radii.cast<Long>()),
        h(form.half_extents.cast<Long>().cwiseQuotient(units)),
        o(ray.origin.cast<Long>().cwiseQuotient(units)),
        d(ray.direction.cast<Long>().cwiseQuotient(units)) {}

  Vec3<Long> at(Long t) const {
    const Vec3<Long> x = o + t * d;
    return x - x.cwiseMax(-h).cwiseMin(h);
  }
  Long slope(Long t) const { return at(t).dot(d); }
  Long outside(Long t) const { return (at(t).norm() - 1) * units.maxCoeff(); }
  Vec3<Long> normal(Long t) const { return at(t).cwiseQuotient(units); }
};

CastTruth truth_of(const Form& form, const Ray<double>& ray) {
  return truth_by_bisection(FromBox(form, ray), ray, form.half_extents.norm() + form.radii.norm());
}

/// The model's own answers: closed forms come before it.
const CastOptions by_model = {&solver::jet};

CastOutcome cast_at(const Form& form, RayFamily family, int count) {
  return cast_family(
      form.shape(), family, count, [&](const Ray<double>& ray) { return truth_of(form, ray); },
      by_model);
}

std::vector<Form> forms() {
  std::vector<Form> all;
  for (const Vec3<double>& half_extents :
       {Vec3<double>(1, 0.7, 0.5), Vec3<double>(0.5, 1, 0.7), Vec3<double>(1, 1, 1),
        Vec3<double>(1, 0.01, 0.001), Vec3<double>(0.7, 1, 0), Vec3<double>(0, 0.7, 1),
        Vec3<double>(0, 1, 0)})
    for (const double radius : {1e-3, 0.2, 1.0, 50.0}) all.push_back({half_extents, radius});
  all.push_back({{0, 0, 0}, 0.2});
  all.push_back({{1, 0.7, 0.5}, 1e4});
  all.push_back({{1, 1e-6, 1e-7}, 0.3});
  for (const Vec3<double>& half_extents :
       {Vec3<double>(1, 0.7, 0.5), Vec3<double>(0, 1, 0.7), Vec3<double>(1, 1, 1e-3)})
    for (const Vec3<double>& radii :
         {Vec3<double>(1, 0.5, 0.25), Vec3<double>(0.3, 0.2, 0.5), Vec3<double>(20, 30, 30)})
      all.push_back({half_extents, radii});
  return all;
}

std::string name_of(const Form& form) {
  std::ostringstream text;
  text << form.half_extents.transpose() << " rounded by " << form.radii.transpose();
  return text.str();
}

/// Rounding error of a support plane: a few epsilon.
constexpr double exactness = 4 * std::numeric_limits<double>::epsilon();

class RoundedBoxes : public ::testing::TestWithParam<RayFamily> {};

TEST_P(RoundedBoxes, are_hit_and_grazed_to_rounding) {
  int misses = 0;
  for (const Form& form : forms()) {
    SCOPED_TRACE(name_of(form));
    const double allowed = exactness * form.slenderness();
    const CastOutcome outcome = cast_at(form, GetParam(), 200);
    expect_within(outcome, {allowed, allowed, 0});
    misses += outcome.misses;
  }
  EXPECT_GT(misses, 300);
}

INSTANTIATE_TEST_SUITE_P(Families, RoundedBoxes,
                         ::testing::Values(RayFamily::random, RayFamily::grazing),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

/// Rays along axes, edges and in the planes of faces, which they touch within rounding.
TEST(RoundedBox, is_hit_by_rays_along_its_edges_and_in_its_planes) {
  for (const Form& form : forms()) {
    SCOPED_TRACE(name_of(form));
    expect_within(cast_at(form, RayFamily::degenerate, 200), {2 * exactness * form.slenderness()});
  }
}

/// Rounded by no more than a few roundings of the box's size, it is a box.
TEST(RoundedBox, that_is_hardly_rounded_is_hit_and_missed) {
  for (const double roundings : {0.3, 1.0, 5.0, 100.0, 1e4}) {
    SCOPED_TRACE(roundings);
    const Form form{{1, 0.7, 0.5}, roundings * std::numeric_limits<double>::epsilon()};
    for (const auto& [family, allowed] : {std::pair(RayFamily::random, exactness),
                                          {RayFamily::grazing, exactness},
                                          {RayFamily::degenerate, tolerance::gjk_stalled<double>}})
      expect_within(cast_at(form, family, 500), {allowed});
  }
}

/// The ray falls towards the far edge's cylinder or corner's ball, whose normal leans with it:
///
///     ----___                  -> no face and no edge that faces the ray is hit
///     ______ ----___
///    |      \       ---
///    |       |
TEST(RoundedBox, is_hit_on_sides_that_lean_with_the_ray) {
  const Form form{{1, 0.7, 0.5}, 0.2};
  const PreparedShape prepared(form.shape());
  const double R = form.half_extents.norm() + form.radii.x();
  Random random(17);
  CastOutcome outcome;
  const int count = 3000;
  for (int i = 0; i < count; ++i) {
    const Vec3<double> n = random.direction();
    const Vec3<double> across = n.cross(random.direction()).normalized();
    const double fall = std::pow(10.0, random.uniform(-2, -0.5));
    const Vec3<double> r = (across - n * fall).normalized();
    const Vec3<double> at = form.half_extents.cwiseProduct(n.cwiseSign()) + n * form.radii.x();
    const Ray<double> ray{at - 5 * R * r, r};
    outcome.add(cast_ray(prepared, ray, by_model), truth_of(form, ray), r, R);
  }
  expect_within(outcome, {exactness, exactness, count});
}

TEST(RoundedBox, is_hit_by_rays_parallel_to_an_edge_on_the_corners_ball) {
  const Vec3<double> h(1, 0.7, 0.5);
  const double radius = 0.2;
  const PreparedShape shape(Form{h, radius}.shape());
  Random random(23);
  for (int i = 0; i < 300; ++i) {
    const int axis = random.below(3), x = (axis + 1) % 3, y = (axis + 2) % 3;
    const double angle = random.uniform(0, std::acos(0.0)), part = random.uniform(0, 1.5);
    Vec3<double> origin, direction = Vec3<double>::Zero();
    origin[axis] = -4;
    origin[x] = h[x] + part * radius * std::cos(angle);
    origin[y] = -h[y] - part * radius * std::sin(angle);
    direction[axis] = 2;
    const CastResult<double> result = cast_ray(shape, Ray<double>{origin, direction});
    ASSERT_EQ(result.status, part < 1 ? Status::hit : Status::miss) << part;
    if (part >= 1) continue;
    const double depth = std::sqrt(1 - part * part);
    EXPECT_NEAR(result.t(), (4 - h[axis] - radius * depth) / 2, 1e-14 / depth);
    EXPECT_NEAR(result.normal[axis], -depth, 1e-13 / depth);
  }
}

TEST(RoundedBox, that_is_flat_in_all_or_two_directions_is_a_sphere_or_a_capsule) {
  const PreparedShape point(Form{{0, 0, 0}, 0.3}.shape()), ball(Sphere{0.3});
  const PreparedShape rod(Form{{0, 0, 0.8}, 0.3}.shape()), capsule(Shape(Capsule{0.3, 0.8}));
  Random random(29);
  int hits = 0;
  const auto compare = [&](const PreparedShape& a, const PreparedShape& b) {
    const Vec3<double> origin = random.direction() * 4;
    const Ray<double> ray{origin, random.direction() * 0.6 - origin};
    const CastResult<double> on_a = cast_ray(a, ray), on_b = cast_ray(b, ray);
    ASSERT_EQ(on_a.status, on_b.status);
    if (on_a.status != Status::hit) return;
    ++hits;
    const double across = -on_b.normal.dot(ray.direction);
    EXPECT_NEAR(on_a.t() * across, on_b.t() * across, 1e-14);
    EXPECT_LE((on_a.normal - on_b.normal).norm() * across, 1e-13);
  };
  for (int i = 0; i < 500; ++i) {
    compare(point, ball);
    compare(rod, capsule);
  }
  EXPECT_GT(hits, 250);
  EXPECT_LT(hits, 900);
}

TEST(RoundedBox, mirrored_with_the_ray_has_the_same_hit_bit_for_bit) {
  const Form form{{1, 0.7, 0.5}, 0.2};
  const PreparedShape prepared(form.shape());
  const Shape shape = form.shape();
  for (const RayFamily family : {RayFamily::random, RayFamily::grazing}) {
    FamilyRays rays(shape, family, 31);
    for (int i = 0; i < 200; ++i) {
      const Ray<double> ray = rays.next();
      const CastResult<double> result = cast_ray(prepared, ray);
      for (int mirrors = 1; mirrors < 8; ++mirrors) {
        const Vec3<double> mirror(mirrors & 1 ? -1.0 : 1.0, mirrors & 2 ? -1.0 : 1.0,
                                  mirrors & 4 ? -1.0 : 1.0);
        const CastResult<double> other = cast_ray(
            prepared,
            Ray<double>{ray.origin.cwiseProduct(mirror), ray.direction.cwiseProduct(mirror)});
        ASSERT_EQ(other.status, result.status);
        if (result.status != Status::hit) continue;
        EXPECT_EQ(other.t_base, result.t_base);
        EXPECT_EQ(other.t_offset, result.t_offset);
        EXPECT_EQ(other.normal, result.normal.cwiseProduct(mirror));
      }
    }
  }
}

}  // namespace
}  // namespace minkray::testing
