// SPDX-License-Identifier: MIT
// Casts return what tests/golden/casts.txt records, bit for bit, and on the same paths: each
// solver, exits, packets and proofs, at every kind of shape, in poses that are easy and hard.
// Other tests check that the results are right; here nothing changes unnoticed, not even the cost
// of a cast. `./run golden` records the results.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/cast/packet_cast.h"
#include "core/proof/certificate.h"
#include "core/proof/check_certificate.h"
#include "renderer/paper/solvers.h"
#include "tests/support/hashed_bits.h"
#include "tests/support/measured_shapes.h"
#include "tests/support/ray_families.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/values_asked_for.h"

namespace minkray::testing {
namespace {

struct Bits : HashedBits {
  using HashedBits::add;

  void add(const CastResult<double>& answer) {
    add(answers, answer.status);
    if (answer.found()) {
      for (const double number :
           {answer.t_base, answer.t_offset, answer.offset_lo, answer.offset_hi})
        add(answers, number);
    }
    add(answers, answer.normal);
    add(costs, answer.path);
    add(costs, answer.iterations);
    add(costs, answer.supports);
  }

  void add(const Certificate& proof, const CertificateVerdict& check) {
    add(answers, check.holds);
    for (const double number : {check.offset_lo, check.offset_hi, check.offset_spanned, check.gap,
                                check.lateral, check.margin, check.claim_error, check.allowed})
      add(answers, number);
    add(answers, proof.plane);
    for (const WeightedSupport& spanning : proof.spanning) {
      add(answers, spanning.direction);
      add(answers, spanning.weight);
    }
    add(costs, proof.supports);
  }
};

using AllBits = std::map<std::string, Bits>;

constexpr int rays_each = 24;        ///< of a family, for each pose and precision
constexpr int slow_rays_each = 3;    ///< for the slow reference
constexpr int proven_rays_each = 6;  ///< proofs take some hundred support points

/// As it is; turned and moved; sheared; tiny; and far from the origin.
std::vector<Affine<double>> golden_poses(double size) {
  Affine<double> turned, sheared, tiny, far;
  turned.linear =
      Eigen::AngleAxis<double>(0.7, Vec3<double>(1, 2, 3).normalized()).toRotationMatrix();
  turned.translation = Vec3<double>(0.3, -4, 7) * size;
  sheared.linear << 1, 2, 0.5, 0, 1.5, -1, 0.3, 0, 0.4;
  sheared.translation = Vec3<double>(1, 2, 3) * size;
  tiny.linear *= 1e-3;
  far.translation = Vec3<double>(2e3, -1e3, 3e2) * size;
  return {{}, turned, sheared, tiny, far};
}

/// One in four begins or ends somewhere along its way, ends near the surface, or has another
/// length. Rays reach the shape at t near 1 or 5.
Ray<double> cut(Ray<double> ray, Random& random) {
  switch (random.below(16)) {
    case 0:
      ray.t_max = random.uniform() * 10;
      break;
    case 1:
      ray.origin += ray.direction * (random.uniform() * 10);
      break;
    case 2:
      ray.t_max = 5;
      break;
    case 3:
      ray.direction *= std::pow(10.0, random.uniform(-12, 12));
      break;
    default:
      break;
  }
  return ray;
}

void cast_all(const Shape& shape, const Affine<double>& pose, AllBits& bits) {
  const Shape placed = Transform{shape, AffineMap(pose)};
  const PreparedShape prepared(placed);
  const SupportFunction support = supports_of(placed);
  for (const RayFamilyDescription& family : ray_families) {
    FamilyRays rays(placed, family.family, 2004);
    Random random(17);
    RayPacket packet;
    for (int i = 0; i < rays_each; ++i) {
      const Ray<double> ray = cut(rays.next(), random);
      for (const auto& solver : named_solvers) {
        const bool is_slow = solver.kind == &solver::first_solution;
        if (is_slow && i >= slow_rays_each) continue;
        CastOptions options;
        options.solver = solver.kind;
        if (i % 8 == 5) options.v0 = Vec3<double>(1.0, 2.0, -3.0);
        if (i % 8 == 6) options.max_iterations = 4;
        bits[std::string(solver.name)].add(cast_ray(prepared, ray, options));
        if (solver.kind == &solver::automatic || solver.kind == &solver::jet)
          bits["exit-" + std::string(solver.name)].add(cast_exit(prepared, ray, options));
      }
      if (i < proven_rays_each) {
        const Claim claim = claim_of(cast_ray(prepared, ray));
        const Certificate proof = certify(support, ray, claim);
        bits["proof"].add(proof, check_certificate(support, ray, claim, proof));
      }
      packet.set(i % packet_lanes, ray);
      if (i % packet_lanes < packet_lanes - 1) continue;
      CastPacket answers;
      cast_packet(prepared, packet, all_lanes, answers);
      for (int lane = 0; lane < packet_lanes; ++lane) bits["packet"].add(answers.result(lane));
    }
  }
}

std::vector<SampleShape> golden_shapes() {
  std::vector<SampleShape> shapes = sample_shapes();
  for (const MeasuredShape& measured : measured_shapes())
    if (measured.name.find("hull") != std::string::npos)
      shapes.push_back({measured.name, measured.shape});
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Shape shape = random_nesting(seed);
    shapes.push_back({"nesting " + std::to_string(seed) + ", " + name_of_nesting(shape), shape});
  }
  return shapes;
}

class GoldenCasts : public ::testing::TestWithParam<SampleShape> {};

TEST_P(GoldenCasts, are_as_recorded) {
  const Shape& shape = GetParam().shape;
  AllBits bits;
  for (const Affine<double>& pose : golden_poses(ball_around(bounds_of(shape)).radius)) {
    cast_all(shape, pose, bits);
  }
  RecordedHashes recorded("casts.txt", "the casts of golden_casts_test.cpp answer");
  expect_as_recorded(recorded, GetParam().name, bits);
}

INSTANTIATE_TEST_SUITE_P(Shapes, GoldenCasts, values_asked_for<GoldenCasts>(golden_shapes),
                         [](const auto& instance) {
                           std::string name = std::to_string(instance.index);
                           for (const char c : instance.param.name)
                             name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

}  // namespace
}  // namespace minkray::testing
