// SPDX-License-Identifier: MIT
// Judge of a filter's results: compared with an oracle's interval of each line, and by
// certificates.
#pragma once

#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/exact/polytope_form.h"
#include "core/proof/certificate.h"
#include "core/proof/check_certificate.h"
#include "tests/support/filter_cases.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {

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
      ASSERT_NEAR(answer.normal.norm(), 1, 1e-14);  // rounding of a root and three quotients
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
      EXPECT_TRUE(form == exact::PolytopeForm::kind ||
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
