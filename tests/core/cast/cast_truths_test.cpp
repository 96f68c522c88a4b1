// SPDX-License-Identifier: MIT
// Properties of every cast at every shape, with every solver.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/geometry/convex_hull.h"
#include "tests/support/aimed_rays.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/solvers.h"

namespace minkray::testing {
namespace {

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon();

/// True if the support points span space.
bool is_solid(const Shape& shape) {
  Random random(51);
  std::vector<Vec3<double>> points;
  for (int i = 0; i < 64; ++i) points.push_back(shape.support(random.direction()));
  constexpr double flatness = 1e-9;  // far above rounding, far below the thinnest sample
  return round_frame(points, flatness).rank == 3;
}

std::vector<SampleShape> solids() {
  std::vector<SampleShape> all = sample_shapes_and_nestings(300, 340);
  std::erase_if(all, [](const SampleShape& sample) { return !is_solid(sample.shape); });
  return all;
}

struct SolidQuery {
  const Shape& shape;
  const PreparedShape& prepared;
  Ray<double> ray;
  CastOptions options;
  double rounding;  ///< as closed_form_test.cpp allows, of two casts that are compared
};

/// Calls visit(query) for many rays at all solid shapes with all solvers; visit returns the ray's
/// cast. About half of them hit.
template <class Visit>
void for_rays(int count, const Visit& visit) {
  for (const SampleShape& sample : solids()) {
    const Bounds<double> bounds = bounds_of(sample.shape);
    const PreparedShape prepared(sample.shape);
    const double radius = prepared.definition().bounds_of(Affine<double>{}).half_extents().norm();
    AimedRays aimed(bounds, 21);
    const double spread = aimed.spread_for_half(
        [&](const Ray<double>& ray) { return cast_ray(prepared, ray).found(); });
    int rays = 0, hits = 0;
    for (const auto& solver : accurate_solvers()) {
      SCOPED_TRACE(sample.name + ", solver " + std::string(solver.name));
      for (int i = 0; i < count; ++i, ++rays)
        hits += visit(SolidQuery{sample.shape,
                                 prepared,
                                 aimed.next(spread),
                                 {solver.kind},
                                 2 * 512 * unit_roundoff * radius})
                    .found();
    }
    EXPECT_GT(hits, 0.3 * rays) << sample.name;
    EXPECT_LT(hits, 0.7 * rays) << sample.name;
  }
}

/// The lesser of two normals' parts against the ray.
double shallower(const CastResult<double>& a, const CastResult<double>& b, const Ray<double>& ray) {
  return std::min(std::abs(a.normal.dot(ray.direction)), std::abs(b.normal.dot(ray.direction)));
}

/// The certificate of a hit: its plane touches the shape, and the hit point lies on it. For a
/// miss: no point of the shape lies on the ray's side of the plane. Checked with supports alone.
TEST(CastTruths, planes_of_hits_touch_and_planes_of_misses_separate) {
  for_rays(60, [](const auto& query) {
    const auto& [shape, prepared, ray, options, rounding] = query;
    const CastResult<double> result = cast_ray(prepared, ray, options);
    const Vec3<double>& n = result.normal;
    EXPECT_NE(result.status, Status::exhausted);
    EXPECT_NE(result.status, Status::inside);
    const double along = n.dot(ray.direction) / (unit_roundoff * ray.direction.norm());
    if (result.status == Status::hit) {
      const double t = result.t_base + result.t_offset;
      EXPECT_NEAR(n.dot(ray.at(t)), n.dot(shape.support(n)), rounding);
      EXPECT_LE(along, 8);
    }
    if (result.status == Status::miss) {
      EXPECT_GE(n.dot(ray.origin - shape.support(n)), -rounding);
      EXPECT_GE(along, -32);  // normals go through the rounded inverses of nested maps
    }
    return result;
  });
}

TEST(CastTruths, a_reversed_ray_enters_where_the_ray_leaves) {
  for_rays(60, [](const auto& query) {
    const auto& [shape, prepared, ray, options, rounding] = query;
    const CastResult<double> entry = cast_ray(prepared, ray, options),
                             exit = cast_exit(prepared, ray, options);
    // From the other end: the same line, whose origin is rounded.
    const Ray<double> back{ray.origin + 4.0 * ray.direction, -ray.direction};
    const CastResult<double> reversed = cast_ray(prepared, back, options);
    if (entry.status != Status::hit || exit.status != Status::hit || reversed.status != Status::hit)
      return entry;
    // Entry and exit in order, as distances from the surface: a ray that runs along a thin pancake
    // crosses it at a shallow angle, and t is as much less certain.
    EXPECT_LE((entry.t() - exit.t()) * shallower(entry, exit, ray), rounding);
    // Both normals may be used where an edge leaves a choice.
    const double difference = std::abs(exit.t() - (4 - reversed.t()));
    // The origin's rounding: a few epsilon of its distance, 4 lengths of the ray.
    const double moved = 4 * unit_roundoff * (back.origin.norm() + 4 * ray.direction.norm());
    EXPECT_LE(difference * shallower(exit, reversed, ray), rounding + 4 * moved);
    return entry;
  });
}

TEST(CastTruths, t_does_not_change_under_affine_maps) {
  Random random(31);
  for_rays(40, [&](const auto& query) {
    const auto& [shape, prepared, ray, options, rounding] = query;
    // Powers of two, quarter turns, mirrors and a shear by one half keep rays exact or nearly so.
    const double scale[] = {0.5, 2, -1, 1};
    Mat3<double> linear =
        Vec3<double>(scale[random.below(4)], scale[random.below(4)], scale[random.below(4)])
            .asDiagonal();
    linear(0, 1) = 0.5 * linear(1, 1);
    const Affine<double> map{linear, random.in_cube()};
    const CastResult<double> plain = cast_ray(prepared, ray, options),
                             mapped =
                                 cast_ray(PreparedShape(shape, map),
                                          {map(ray.origin), map.linear * ray.direction}, options);
    if (plain.status != Status::hit || mapped.status != Status::hit) return plain;
    // The mapped ray is rounded once more; singular values of the map lie between 1/3 and 3.
    const double moved =
        12 * unit_roundoff * (ray.origin.norm() + map.translation.norm() + ray.direction.norm());
    EXPECT_LE(std::abs(plain.t() - mapped.t()) * std::abs(plain.normal.dot(ray.direction)),
              9 * rounding + 9 * moved);
    return plain;
  });
}

TEST(CastTruths, a_ray_from_within_says_inside) {
  for (const auto& [name, shape] : solids()) {
    const PreparedShape prepared(shape);
    Random random(41);
    // The mean of support points lies well inside of a solid.
    Vec3<double> centre = Vec3<double>::Zero();
    constexpr int directions = 64;
    for (int i = 0; i < directions; ++i) centre += shape.support(random.direction()) / directions;
    for (const auto& solver : accurate_solvers())
      for (int i = 0; i < 20; ++i) {
        const Vec3<double> side = i == 0 ? centre : shape.support(random.direction()),
                           origin = 0.5 * (centre + side);
        const CastResult<double> result =
            cast_ray(prepared, {origin, random.direction()}, {solver.kind});
        EXPECT_EQ(result.status, Status::inside)
            << name << ", solver " << solver.name << ", origin " << origin.transpose();
        EXPECT_EQ(result.t(), 0.0);
      }
  }
}

/// Rays on faces, edges, corners and along them get any answer that is not given up, and if a hit,
/// a right one.
TEST(CastTruths, rays_at_the_corners_and_along_the_faces_of_a_box_are_answered) {
  const PreparedShape box(Box{{1, 1, 1}});
  for (const auto& solver : accurate_solvers()) {
    const CastOptions options{solver.kind};
    for (int x = -2; x <= 2; ++x)
      for (int y = -2; y <= 2; ++y)
        for (int dx = -1; dx <= 1; ++dx)
          for (int dy = -1; dy <= 1; ++dy)
            for (const int dz : {-1, 1}) {
              // Through (x/2, y/2) on the face's plane z = -dz, where (+-1, *) are edges.
              const Vec3<double> target = {double(x) / 2, double(y) / 2, double(-dz)};
              const Vec3<double> direction = {double(dx), double(dy), double(dz)};
              const Ray<double> ray{Vec3<double>(target - 2.0 * direction), direction};
              const CastResult<double> result = cast_ray(box, ray, options);
              EXPECT_NE(result.status, Status::exhausted);
              const bool on_face = std::abs(x) < 2 && std::abs(y) < 2;
              if (on_face) {
                EXPECT_EQ(result.status, Status::hit)
                    << ray.origin.transpose() << " along " << direction.transpose() << " "
                    << solver.name;
                EXPECT_NEAR(double(result.t()), 2, 64 * unit_roundoff) << solver.name;
              }
            }
    // In the plane of a face, and along an edge.
    for (const Vec3<double>& origin :
         {Vec3<double>(-3, 1, 0), Vec3<double>(-3, 1, 1), Vec3<double>(-3, 0.25, -1)}) {
      const CastResult<double> result =
          cast_ray(box, Ray<double>{origin, Vec3<double>(1, 0, 0)}, options);
      EXPECT_NE(result.status, Status::exhausted) << solver.name;
      if (result.status == Status::hit) {
        EXPECT_NEAR(double(result.t()), 2, 1024 * unit_roundoff) << solver.name;
      }
    }
  }
}

}  // namespace
}  // namespace minkray::testing
