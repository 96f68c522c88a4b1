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

std::vector<SampleShape> certified_shapes() {
  std::vector<SampleShape> all = sample_shapes();
  for (std::uint64_t seed = 300; seed < 340; ++seed) {
    const Shape shape = random_nesting(seed);
    all.push_back({"seed " + std::to_string(seed) + " " + name_of_nesting(shape), shape});
  }
  return all;
}

/// In epsilons of the shape's radius, as a distance between planes: what closed_form_test.cpp
/// allows a cast, for each of the two casts that are compared.
constexpr double allowed_epsilons = 2 * 512;

/// True if the support points span space.
bool is_solid(const Shape& shape) {
  Random random(51);
  std::vector<Vec3<double>> points;
  for (int i = 0; i < 64; ++i) points.push_back(shape.support(random.direction()));
  constexpr double flatness = 1e-9;  // far above rounding, far below the thinnest sample
  return round_frame(points, flatness).rank == 3;
}

struct Chord {
  CastResult<double> entry, exit;
};

Chord chord_of(const PreparedShape& shape, const Ray<double>& ray, SolverKind solver) {
  const CastOptions options{solver};
  return {cast_ray(shape, ray, options), cast_exit(shape, ray, options)};
}

struct CountedCasts {
  int rays = 0, hits = 0;
};

/// Calls visit(name, shape, ray, solver) for many rays at all solid shapes; about half of them
/// hit.
template <class Visit>
void for_rays(int count, double distance, const Visit& visit) {
  for (const SampleShape& sample : certified_shapes()) {
    const Shape shape = sample.shape;
    const Bounds<double> bounds = bounds_of(shape);
    if (!is_solid(sample.shape)) continue;
    const PreparedShape prepared(shape);
    AimedRays rays(bounds, 21, distance);
    const double spread = rays.spread_for_half(
        [&](const Ray<double>& ray) { return cast_ray(prepared, ray).found(); });
    CountedCasts counted;
    for (const SolverDescription& solver : accurate_solvers()) {
      for (int i = 0; i < count; ++i) {
        ++counted.rays;
        counted.hits += visit(sample.name + ", solver " + std::string(solver.name), shape, prepared,
                              rays.next(spread), solver.kind);
      }
    }
    EXPECT_GT(counted.hits, 0.3 * counted.rays) << sample.name;
    EXPECT_LT(counted.hits, 0.7 * counted.rays) << sample.name;
  }
}

double radius_of(const PreparedShape& shape) {
  return double(shape.definition().bounds_of(Affine<double>{}).half_extents().norm());
}

/// The certificate of a hit: its plane touches the shape, and the hit point lies on it. For a
/// miss: no point of the shape lies on the ray's side of the plane. Checked with supports alone.
TEST(CastTruths, planes_of_hits_touch_and_planes_of_misses_separate) {
  const double epsilon = std::numeric_limits<double>::epsilon();
  for_rays(60, 3,
           [&](const std::string& name, const Shape& shape, const PreparedShape& prepared,
               const Ray<double>& ray, SolverKind solver) {
             const CastOptions options{solver};
             const CastResult<double> result = cast_ray(prepared, ray, options);
             const Vec3<double> n = result.normal;
             const double radius = radius_of(prepared);
             EXPECT_NE(result.status, Status::exhausted) << name;
             EXPECT_NE(result.status, Status::inside) << name;
             if (result.status == Status::hit) {
               const double t = double(result.t_base) + double(result.t_offset);
               EXPECT_NEAR(n.dot(ray.at(t)), n.dot(shape.support(n)),
                           allowed_epsilons * epsilon * radius)
                   << name;
               EXPECT_LE(n.dot(ray.direction), 8 * epsilon * ray.direction.norm()) << name;
             }
             if (result.status == Status::miss) {
               const double above = n.dot(ray.origin - shape.support(n));
               EXPECT_GE(above, -allowed_epsilons * epsilon * radius) << name;
               // Normals go through the rounded inverses of nested maps.
               EXPECT_GE(n.dot(ray.direction), -32 * epsilon * ray.direction.norm()) << name;
             }
             return result.found();
           });
}

TEST(CastTruths, a_reversed_ray_enters_where_the_ray_leaves) {
  const double epsilon = std::numeric_limits<double>::epsilon();
  for_rays(60, 3,
           [&](const std::string& name, const Shape&, const PreparedShape& prepared,
               const Ray<double>& ray, SolverKind solver) {
             const auto [entry, exit] = chord_of(prepared, ray, solver);
             // From the other end: the same line, whose origin is rounded.
             const Ray<double> back{Vec3<double>(ray.origin + 4.0 * ray.direction),
                                    Vec3<double>(-ray.direction)};
             const CastOptions options{solver};
             const CastResult<double> reversed = cast_ray(prepared, back, options);
             if (entry.status == Status::hit && exit.status == Status::hit &&
                 reversed.status == Status::hit) {
               // Entry and exit in order, as distances from the surface: a ray that runs along a
               // thin pancake crosses it at a shallow angle, and t is as much less certain.
               const Vec3<double> direction = ray.direction;
               const double shallow = std::min(std::abs(exit.normal.dot(direction)),
                                               std::abs(entry.normal.dot(direction)));
               EXPECT_LE((double(entry.t()) - double(exit.t())) * shallow,
                         allowed_epsilons * epsilon * radius_of(prepared))
                   << name;
               // Both normals may be used where an edge leaves a choice.
               const double towards = std::min(std::abs(exit.normal.dot(direction)),
                                               std::abs(reversed.normal.dot(direction)));
               const double difference = std::abs(double(exit.t()) - (4 - double(reversed.t())));
               // The origin's rounding: a few epsilon of its distance, 4 lengths of the ray.
               const double moved = 4 * epsilon * (back.origin.norm() + 4 * direction.norm());
               EXPECT_LE(difference * towards,
                         allowed_epsilons * epsilon * radius_of(prepared) + 4 * moved)
                   << name;
             }
             return entry.found();
           });
}

TEST(CastTruths, t_does_not_change_under_affine_maps) {
  const double epsilon = std::numeric_limits<double>::epsilon();
  Random random(31);
  for_rays(40, 3,
           [&](const std::string& name, const Shape& shape, const PreparedShape& prepared,
               const Ray<double>& ray, SolverKind solver) {
             // Powers of two, quarter turns, mirrors and a shear by one half keep rays exact or
             // nearly so.
             const double scale[] = {0.5, 2, -1, 1};
             Mat3<double> linear = Vec3<double>(scale[random.below(4)], scale[random.below(4)],
                                                scale[random.below(4)])
                                       .asDiagonal();
             linear(0, 1) = 0.5 * linear(1, 1);
             const Vec3<double> by = random.in_cube();
             const Affine<double> map{linear, by};
             const CastOptions options{solver};
             const CastResult<double> plain = cast_ray(prepared, ray, options);
             const PreparedShape image(shape, map);
             const CastResult<double> mapped = cast_ray(
                 image, {map(ray.origin), Vec3<double>(map.linear * ray.direction)}, options);
             if (plain.status == Status::hit && mapped.status == Status::hit) {
               // Mapped normals: their planes' distances along the ray are compared, in t.
               const double towards = std::abs(plain.normal.dot(ray.direction));
               // The mapped ray is rounded once more; singular values of the map lie between 1/3
               // and 3.
               const double moved =
                   12 * epsilon * (ray.origin.norm() + by.norm() + ray.direction.norm());
               EXPECT_LE(std::abs(double(plain.t()) - double(mapped.t())) * towards,
                         9 * allowed_epsilons * epsilon * radius_of(prepared) + 9 * moved)
                   << name;
             }
             return plain.found();
           });
}

TEST(CastTruths, a_ray_from_within_says_inside) {
  for (const SampleShape& sample : certified_shapes()) {
    const Shape shape = sample.shape;
    if (!is_solid(sample.shape)) continue;
    const PreparedShape prepared(shape);
    Random random(41);
    // The mean of support points lies well inside of a solid.
    Vec3<double> centre = Vec3<double>::Zero();
    constexpr int directions = 64;
    for (int i = 0; i < directions; ++i)
      centre += shape.support(Vec3<double>(random.direction())) / double(directions);
    const auto half = [&](const Vec3<double>& n) {
      return Vec3<double>(0.5 * (centre + shape.support(Vec3<double>(n))));
    };
    for (const SolverDescription& solver : accurate_solvers()) {
      const CastOptions options{solver.kind};
      for (int i = 0; i < 20; ++i) {
        const Vec3<double> origin = i == 0 ? centre : half(random.direction());
        const CastResult<double> result =
            cast_ray(prepared, {origin, Vec3<double>(random.direction())}, options);
        EXPECT_EQ(result.status, Status::inside)
            << sample.name << ", solver " << solver.name << ", origin " << origin.transpose();
        EXPECT_EQ(result.t(), 0.0);
      }
    }
  }
}

/// Rays on faces, edges, corners and along them get any answer that is not given up, and if a hit,
/// a right one.
TEST(CastTruths, rays_at_the_corners_and_along_the_faces_of_a_box_are_answered) {
  const double epsilon = std::numeric_limits<double>::epsilon();
  const PreparedShape box(Box{{1, 1, 1}});
  for (const SolverDescription& solver : accurate_solvers()) {
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
                EXPECT_NEAR(double(result.t()), 2, 64 * epsilon) << solver.name;
              }
            }
    // In the plane of a face, and along an edge.
    for (const Vec3<double>& origin :
         {Vec3<double>(-3, 1, 0), Vec3<double>(-3, 1, 1), Vec3<double>(-3, 0.25, -1)}) {
      const CastResult<double> result =
          cast_ray(box, Ray<double>{origin, Vec3<double>(1, 0, 0)}, options);
      EXPECT_NE(result.status, Status::exhausted) << solver.name;
      if (result.status == Status::hit) {
        EXPECT_NEAR(double(result.t()), 2, allowed_epsilons * epsilon) << solver.name;
      }
    }
  }
}

}  // namespace
}  // namespace minkray::testing
