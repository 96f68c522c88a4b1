// SPDX-License-Identifier: MIT
// Compares the interval that a hit in float claims with the hit in double.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/derived/convert.h"
#include "tests/support/ray_families.h"
#include "tests/support/rounded.h"
#include "tests/support/sample_shapes.h"

namespace minkray::testing {
namespace {

struct Beside {
  int hits = 0, outside = 0;
  double worst = 0;  ///< |t - exact| along the normal, in units of R
};

/// Casts one shape's rays that hit in float and in double.
Beside beside_double(const Shape<double>& shape, SolverKind solver, RayFamily family) {
  const Shape<float> in_float = convert<float>(shape);
  const PreparedShape<float> prepared(in_float);
  const PreparedShape<double> same(convert<double>(in_float));
  CastOptions<float> options;
  options.solver = solver;
  FamilyRays rays(shape, family, 5);
  const double R = rays.ball().radius;
  Beside beside;
  for (int i = 0; i < 500; ++i) {
    const Ray<float> ray = rounded_to<float>(rays.next());
    const CastResult<float> coarse = cast_ray(prepared, ray, options);
    const CastResult<double> fine = cast_ray(same, in_double(ray));
    if (coarse.status != Status::hit || fine.status != Status::hit) continue;
    const Vec3<double> direction = ray.direction.cast<double>();
    const double t = fine.t_base - double(coarse.t_base) + fine.t_offset;
    const double unknown = 1e-9 * R / direction.norm();
    ++beside.hits;
    beside.outside +=
        t < double(coarse.offset_lo) - unknown || t > double(coarse.offset_hi) + unknown;
    const double error = std::abs(t - double(coarse.t_offset));
    beside.worst = std::max(beside.worst, error * std::abs(fine.normal.dot(direction)) / R);
  }
  return beside;
}

/// The map around a transformed shape is rounded to float when it is prepared: another shape.
bool is_mapped(const SampleShape& sample) {
  return sample.name.starts_with("transform");
}

TEST(BoundsOfHits, in_float_hold_the_hit_in_double) {
  for (const SolverKind solver : {SolverKind::automatic, SolverKind::jet, SolverKind::paper})
    for (const SampleShape& sample : sample_shapes()) {
      if (is_mapped(sample)) continue;
      for (const RayFamily family : {RayFamily::random, RayFamily::grazing}) {
        const Beside beside = beside_double(sample.shape, solver, family);
        // A plane's offset may be rounded by a little more than jet_gap.
        EXPECT_LE(beside.outside, beside.hits / 50 + 1)
            << sample.name << ", solver " << int(solver) << ", " << beside.hits << " hits";
      }
    }
}

/// Hits by planes of portals that were no more than directions were up to 0.1 R early.
TEST(BoundsOfHits, portals_in_float_are_not_early_at_rounded_shapes) {
  for (const SampleShape& sample : sample_shapes()) {
    if (is_mapped(sample)) continue;
    for (const RayFamily family : {RayFamily::random, RayFamily::grazing}) {
      const Beside beside = beside_double(sample.shape, SolverKind::portal, family);
      EXPECT_LE(beside.worst, 5e-5) << sample.name;
    }
  }
}

}  // namespace
}  // namespace minkray::testing
