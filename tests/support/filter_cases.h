// SPDX-License-Identifier: MIT
// Shared by the tests of the filter: poses, rays that begin and end anywhere, and the judgement of
// a result.
#pragma once

#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/proof/certificate.h"
#include "core/proof/check_certificate.h"
#include "tests/oracle/filter_truth.h"
#include "tests/support/random.h"
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
  double worst = 0;  ///< error by bound
};

/// Compares a result of the filter with `line_in(at, along)`, the interval of a line in the inner
/// shape's frame.
template <class LineIn>
void judge_by(const LineIn& line_in, const PreparedShape& prepared, const Ray<double>& ray,
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
    counted.worst = std::max(counted.worst, verdict.error_by_bound);
    ASSERT_FALSE(verdict.is_false) << name_of(answer.status) << (leaves ? " leaving" : "")
                                   << " at origin " << ray.origin.transpose() << ", direction "
                                   << ray.direction.transpose() << ", t_max " << ray.t_max;
    ASSERT_LE(verdict.error_by_bound, 1)
        << "origin " << ray.origin.transpose() << ", direction " << ray.direction.transpose();
    if (answer.status != Status::inside) {
      ASSERT_NEAR(double(answer.normal.norm()), 1, 1e-6);
    }
  }
}

/// Checks the filter's results for `rays_each` rays of each family, by a checker that uses
/// supports only.
inline void expect_certified(const Shape& shape, const PreparedShape& prepared, std::uint64_t seed,
                             int rays_each) {
  const SupportFunction support = supports_of(shape);
  for (const RayFamilyDescription& family : ray_families) {
    FamilyRays rays(shape, family.family, seed);
    for (int i = 0; i < rays_each; ++i) {
      const Ray<double> ray = rays.next();
      const CastResult<double> answer = cast_ray(prepared, ray);
      if (answer.path != Path::filter) continue;
      const Claim claim = claim_of(answer);
      const Certificate proof = certify(support, ray, claim);
      EXPECT_TRUE(check_certificate(support, ray, claim, proof).holds)
          << family.name << ", " << name_of(answer.status) << ", origin " << ray.origin.transpose()
          << ", direction " << ray.direction.transpose();
    }
  }
}

}  // namespace minkray::testing
