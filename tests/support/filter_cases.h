// SPDX-License-Identifier: MIT
// Shapes whose casts a filter answers, oracles for where lines meet them, and the judge of the
// filter's results.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "core/cast/cast.h"
#include "core/proof/certificate.h"
#include "core/proof/check_certificate.h"
#include "tests/oracle/filter_truth.h"
#include "tests/oracle/rounded_hull.h"
#include "tests/support/hull_points.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {

struct FilterShape {
  std::string name;
  Shape shape;
  Points points = {};    ///< corners, for rays along edges
  bool is_posed = true;  ///< false: elsewhere, numbers are further apart than it is large
};

/// Interval of a line in a prepared shape's inner frame.
using LineIn = std::function<Interval(const Vec3<Long>& at, const Vec3<Long>& along)>;

/// Shapes of one oracle.
struct FilterGroup {
  std::vector<FilterShape> shapes;
  std::function<LineIn(const PreparedShape&)> oracle;
  int rays;  ///< of each family, per shape and pose
};

/// School geometry.
inline FilterGroup closed_forms() {
  const Shape box = Box{{1, 0.7, 0.5}};
  return {{
              {"sphere", Sphere{0.3}},
              {"a minute sphere", Sphere{1e-12}, {}, false},
              {"ellipsoid", Ellipsoid{{1, 0.5, 0.25}}},
              {"box", box},
              {"cube", Box{{1, 1, 1}}},
              {"capsule", Capsule{1, 1}},
              {"long capsule", Capsule{0.2, 2}},
              {"cylinder", Cylinder{1, 1}},
              {"coin", Cylinder{2, 0.25}},
              {"cut cylinder", CutCylinder{0.7, {-0.5, 0.6}, {0.2, -0.3}, {-0.5, 0.4}}},
              {"wedge", CutCylinder{1, {0, 0.5}, {0.25, 0}, {-0.25, 0}}},
              {"cone", Cone{1, 1}},
              {"flat cone", Cone{2, 0.2}},
              {"frustum", Frustum{{1, 0.3}, 1}},
              {"upturned frustum", Frustum{{0.25, 1.5}, 0.5}},
              {"even frustum", Frustum{{0.5, 0.5}, 0.5}},
              {"tapered capsule", TaperedCapsule{{1, 0.3}, 1}},
              {"upturned tapered capsule", TaperedCapsule{{0.1, 0.7}, 0.5}},
              {"rounded box", Rounded{0.2, box}},
              {"rounded plate", Rounded{0.1, Shape(Box{{1, 1, 0}})}},
          },
          [](const PreparedShape& prepared) -> LineIn {
            return [inner = prepared.inner_shape()](const Vec3<Long>& at, const Vec3<Long>& along) {
              return *line_in_shape(inner, at, along);
            };
          },
          300};
}

/// Planes through every three points of the inner shape, as they were rounded and moved.
inline FilterGroup polytopes() {
  FilterGroup group{{},
                    [](const PreparedShape& prepared) -> LineIn {
                      const Shape inner = prepared.inner_shape();
                      return [planes = HalfSpaces(std::get<Hull>(inner.kind).points.points())](
                                 const Vec3<Long>& at, const Vec3<Long>& along) -> Interval {
                        const HalfSpaces::Part part = planes.clip(at, along);
                        return {part.lower, part.upper};
                      };
                    },
                    400};
  for (const NamedPoints& named : hulls())
    group.shapes.push_back({named.name, Hull{PointCloud(named.points)}, named.points});
  return group;
}

/// Two points are a segment, three a triangle.
inline Shape rounded_hull(double radius, const Points& points) {
  if (points.size() == 2) return Rounded{radius, Shape(Segment{{points[0], points[1]}})};
  if (points.size() == 3)
    return Rounded{radius, Shape(Triangle{{points[0], points[1], points[2]}})};
  return Rounded{radius, Shape(Hull{PointCloud(points)})};
}

/// The facets' prisms and the edges' capsules. The oracle is slow at hulls of 64 points.
inline FilterGroup rounded_polytopes() {
  std::vector<NamedPoints> cores = hulls();
  std::erase_if(cores, [](const NamedPoints& core) { return core.points.size() > 40; });
  cores.push_back({"segment", {{-1, 0.2, 0}, {0.7, 1, -0.4}}});
  cores.push_back({"segment of no length", {{0.5, 0.25, 1}, {0.5, 0.25, 1}}});
  cores.push_back({"segment along x", {{-1, 0, 0}, {1, 0, 0}}});
  cores.push_back({"segment off centre", {{3, 2, 1}, {4, 2.5, 0}}});
  cores.push_back({"triangle", {{-1, -0.5, 0.1}, {1, -0.3, 0}, {0.2, 1, -0.4}}});
  cores.push_back({"triangle along the axes", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  cores.push_back({"slender triangle", {{0, 0, 0}, {1, 0, 0}, {0.4, 0.02, 0.01}}});
  FilterGroup group{
      {},
      [](const PreparedShape& prepared) -> LineIn {
        const Shape inner = prepared.inner_shape();
        const auto& rounded = std::get<Rounded>(inner.kind);
        Points points;
        std::visit(
            [&]<class Core>(const Core& core) {
              if constexpr (std::is_same_v<Core, Hull>)
                points.assign(core.points.points().begin(), core.points.points().end());
              else if constexpr (requires { core.points; })
                points.assign(core.points.begin(), core.points.end());
            },
            rounded.shape->kind);
        return
            [oracle = RoundedHull(points, rounded.radius)](
                const Vec3<Long>& at, const Vec3<Long>& along) { return oracle.line(at, along); };
      },
      60};
  for (const NamedPoints& core : cores)
    for (const double radius : {0.1, 0.01, 2.0})
      group.shapes.push_back({core.name, rounded_hull(radius, core.points), core.points});
  return group;
}

struct Posed {
  std::string name;
  Affine<double> pose;
};

inline std::vector<Posed> poses() {
  Affine<double> moved, turned, sheared;
  moved.translation = {100, -50, 2};
  turned.linear =
      Eigen::AngleAxis<double>(0.7, Vec3<double>(1, 2, 3).normalized()).toRotationMatrix();
  turned.translation = {0.3, -4, 7};
  sheared.linear << 1, 2, 0.5, 0, 1.5, -1, 0.3, 0, 0.4;
  sheared.translation = {1, 2, 3};
  return {{"as it is", {}}, {"moved", moved}, {"turned", turned}, {"sheared", sheared}};
}

/// Begun and ended anywhere along it, in one case of four.
inline Ray<double> cut(Ray<double> ray, Random& random) {
  const double way = 2 * ray.origin.norm() / ray.direction.norm();
  const int kind = random.below(8);
  if (kind == 0) ray.t_max = random.uniform() * way;
  if (kind == 1) ray.origin += ray.direction * (random.uniform() * way);
  return ray;
}

struct Counted {
  int answered = 0, in_doubt = 0, hits = 0, misses = 0, insides = 0;
};

/// Compares the filter's results of entry and exit with the oracle's interval of the line.
inline void judge(const LineIn& line_in, const PreparedShape& prepared, const Ray<double>& ray,
                  Counted& counted) {
  for (const bool leaves : {false, true}) {
    const CastResult<double> answer = leaves ? cast_exit(prepared, ray) : cast_ray(prepared, ray);
    if (answer.path != Path::filter) {
      counted.in_doubt += leaves ? 0 : 1;
      continue;
    }
    if (!leaves) {
      ++counted.answered;
      counted.hits += answer.status == Status::hit;
      counted.misses += answer.status == Status::miss;
      counted.insides += answer.status == Status::inside;
    }
    const FilterVerdict verdict = judge_bound_by(line_in, prepared, ray, answer, leaves);
    ASSERT_FALSE(verdict.is_false) << name_of(answer.status) << (leaves ? " leaving" : "")
                                   << " at origin " << ray.origin.transpose() << ", direction "
                                   << ray.direction.transpose() << ", t_max " << ray.t_max;
    ASSERT_LE(verdict.error_by_bound, 1)
        << "origin " << ray.origin.transpose() << ", direction " << ray.direction.transpose();
    if (answer.status != Status::inside) {
      ASSERT_NEAR(answer.normal.norm(), 1, 1e-6);
    }
  }
}

/// Rays at a posed shape: makes them of the shape, its posed corners, and random numbers.
using NextRay = std::function<Ray<double>()>;
using MakeRays = std::function<NextRay(const Shape&, const Points&, Random&)>;

inline Counted judge_all(const FilterGroup& group, const MakeRays& make_rays) {
  Counted counted;
  for (const FilterShape& one : group.shapes)
    for (const Posed& posed : poses()) {
      if (!one.is_posed && posed.name != "as it is") continue;
      SCOPED_TRACE(one.name + ", " + posed.name);
      const PreparedShape prepared(one.shape, posed.pose);
      const FormKind form = prepared.definition().form().kind;
      EXPECT_TRUE(form == FormKind::polytope ||
                  (form != FormKind::none && !std::holds_alternative<Hull>(one.shape.kind)));
      const LineIn line_in = group.oracle(prepared);
      const Shape outer = Transform{one.shape, posed.pose};
      Points points;
      for (const Vec3<double>& p : one.points) points.push_back(posed.pose(p));
      Random random(71);
      const NextRay next = make_rays(outer, points, random);
      for (int i = 0; i < group.rays && !::testing::Test::HasFatalFailure(); ++i)
        judge(line_in, prepared, cut(next(), random), counted);
    }
  return counted;
}

/// Checks the filter's results for `rays_each` rays of each family, by a checker that uses
/// supports only.
inline void expect_certified(const Shape& shape, int rays_each) {
  const PreparedShape prepared(shape);
  const SupportFunction support = supports_of(shape);
  for (const RayFamilyDescription& family : ray_families) {
    FamilyRays rays(shape, family.family, 74);
    for (int i = 0; i < rays_each; ++i) {
      const Ray<double> ray = rays.next();
      const CastResult<double> answer = cast_ray(prepared, ray);
      if (answer.path != Path::filter) continue;
      const Claim claim = claim_of(answer);
      const Certificate proof = certify(support, ray, claim);
      EXPECT_EQ(check_certificate(support, ray, claim, proof).complaint, "")
          << family.name << ", " << name_of(answer.status) << ", origin " << ray.origin.transpose()
          << ", direction " << ray.direction.transpose();
    }
  }
}

}  // namespace minkray::testing
