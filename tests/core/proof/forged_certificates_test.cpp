// SPDX-License-Identifier: MIT
// No certificate proves a false claim, however it was made: claims that are wrong by far, with
// directions, weights and times from all of the numbers' range.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/proof/check_certificate.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

using V = Vec3<double>;
constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

template <class Value, std::size_t N>
Value one_of(const std::array<Value, N>& values, Random& random) {
  return values[static_cast<std::size_t>(random.below(int(N)))];
}

/// A third of them are not of ordinary length.
V of_any_length(const V& n, Random& random) {
  constexpr std::array lengths = {0.0,   5e-324, 1e-308, 1e-200, 1e-160, 1e-140,
                                  1e140, 1e154,  1e160,  1e200,  1e308,  endless};
  return random.below(3) > 0 ? n : V(n * one_of(lengths, random));
}

double any_weight(Random& random) {
  constexpr std::array weights = {0.0, 5e-324, 1e-308, 1e-17,   0.25,      0.5,  1.0,
                                  2.0, 1e160,  1e308,  endless, no_number, -1.0, -0.5};
  return random.below(2) > 0 ? random.uniform() : one_of(weights, random);
}

double any_time(double t, Random& random) {
  constexpr std::array times = {0.0, 1e-300, 1e300, -1e300, 1e17, endless, no_number};
  if (const int kind = random.below(4); kind > 0) return kind > 1 ? t : random.uniform(-5, 15);
  return one_of(times, random);
}

/// A unit ball or a cube around it, about a middle. Hits of rays are known in closed form.
struct Body {
  bool is_ball;
  V middle;

  V support(const V& n) const {
    if (is_ball) return middle + (n.isZero(0) ? V(1, 0, 0) : unit<double>(n));
    return middle + V(n.x() < 0 ? -1 : 1, n.y() < 0 ? -1 : 1, n.z() < 0 ? -1 : 1);
  }
  bool holds(const V& point, double size) const {
    const V p = point - middle;
    return is_ball ? p.norm() < size : p.cwiseAbs().maxCoeff() < size;
  }
  /// Parameter at which the line enters the body scaled by `size`; infinite if it does not.
  double entry(const Ray<double>& ray, double size) const {
    const V x = ray.origin - middle, d = ray.direction;
    if (is_ball) {
      const double deep = size * size - (x - x.dot(d) * d).squaredNorm();
      return deep > 0 ? -x.dot(d) - std::sqrt(deep) : endless;
    }
    double first = -endless, last = endless;
    for (int i = 0; i < 3; ++i) {
      first = std::max(first, (-x[i] - std::copysign(size, d[i])) / d[i]);
      last = std::min(last, (-x[i] + std::copysign(size, d[i])) / d[i]);
    }
    return first < last ? first : endless;
  }
  V normal_at(const V& point) const {
    const V p = point - middle;
    if (is_ball) return p.normalized();
    int axis = 0;
    p.cwiseAbs().maxCoeff(&axis);
    return V::Unit(axis) * std::copysign(1.0, p[axis]);
  }
};

TEST(Certificate, that_is_forged_proves_nothing_false) {
  Random random(20261126);
  std::array<int, 4> holding{};
  for (int i = 0; i < 1'000'000; ++i) {
    const Body body{random.below(2) > 0, random.below(2) > 0 ? V(0, 0, 0) : V(3, -2, 1)};
    const SupportFunction support = [&](const V& n) { return body.support(n); };
    const V along = random.direction();
    const double away = random.below(4) > 0 ? 6 : 0.5;
    Ray<double> ray{body.middle + random.in_cube() - away * along, along};
    const double t = body.entry(ray, 1);
    if (random.below(4) == 0) ray.t_max = std::max(0.0, std::min(t, away) - random.uniform(0.1, 1));
    // Facts that hold within a tenth of the size; other rays are near to two truths.
    const double late = body.entry(ray, 0.9), early = body.entry(ray, 1.1);
    const bool is_inside = body.holds(ray.origin, 0.9), is_outside = !body.holds(ray.origin, 1.1),
               is_hit = is_outside && early > 0 && late < ray.t_max,
               is_miss = is_outside && (early == endless || early < 0 || early > ray.t_max);
    if (!is_inside && !is_hit && !is_miss) continue;

    const V normal = is_hit ? body.normal_at(ray.at(t)) : V(random.direction());
    const std::array<V, 7> directions = {normal,
                                         -normal,
                                         along,
                                         -along,
                                         along.unitOrthogonal(),
                                         V::Unit(random.below(3)),
                                         random.direction()};
    const auto any_direction = [&] { return of_any_length(one_of(directions, random), random); };
    constexpr std::array claims = {Status::hit, Status::miss, Status::inside};
    Claim claim;
    claim.status = one_of(claims, random);
    claim.normal = random.below(2) > 0 ? normal : any_direction();
    claim.t_base = any_time(std::isfinite(t) ? t : away, random);
    claim.t_offset = random.below(2) > 0 ? 0 : any_time(0, random);
    // Made from nothing, or from the proof of the truth with something else put in; sometimes the
    // nearest to a proof of the claim, whose search takes long for a false one.
    const bool is_changed = random.below(4) == 0;
    Certificate certificate;
    if (is_changed) {
      Claim truth;
      truth.status = is_hit ? Status::hit : is_miss ? Status::miss : Status::inside;
      truth.normal = normal;
      if (is_hit) truth.t_base = t;
      certificate = certify(support, ray, random.below(2000) > 0 ? truth : claim);
      if (random.below(2) > 0) claim.status = truth.status;
    }
    if (!is_changed || random.below(2) > 0) certificate.plane = any_direction();
    for (WeightedSupport& term : certificate.spanning) {
      if (random.below(2) > 0) break;
      term = {any_direction(), any_weight(random)};
    }

    const CertificateVerdict verdict = check_certificate(support, ray, claim, certificate);
    if (!verdict.holds) continue;
    ++holding[static_cast<std::size_t>(claim.status)];
    const double claimed = claim.t_base + claim.t_offset;
    const bool is_true = claim.status == Status::hit    ? is_hit && std::abs(claimed - t) < 1e-9
                         : claim.status == Status::miss ? is_miss
                                                        : is_inside;
    ASSERT_TRUE(is_true) << i << ": " << name_of(claim.status) << " at " << claimed << ", normal "
                         << claim.normal.transpose() << ", plane " << certificate.plane.transpose();
  }
  for (const Status status : {Status::hit, Status::miss, Status::inside})
    EXPECT_GT(holding[static_cast<std::size_t>(status)], 20) << name_of(status);
}

}  // namespace
}  // namespace minkray::testing
