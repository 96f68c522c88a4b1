// SPDX-License-Identifier: MIT
// Casts wherever a body is: the same query moved by a vector that doubles hold exactly has the same
// answer, so intervals must hold it and statuses be true at any distance from the frame's origin.
// The truth is a GJK ray cast in long double, next to the origin; at needles and plates made by
// maps it is a closed form in the innermost frame, where the ray is moved in 113 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/cast/cast.h"
#include "core/gjk/gjk_ray_cast.h"
#include "core/proof/check_certificate.h"
#include "core/world/world.h"
#include "tests/oracle/closed_form.h"
#include "tests/oracle/quad.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/ray_families.h"
#include "tests/support/shifted.h"

namespace minkray::testing {
namespace {

using S = Shape;
using V = Vec3<double>;
using Long = long double;

/// Lengths are multiples of this, so that sums with places up to 2^33 away are exact.
constexpr double grain = 0x1p-18;

double in_grains(double x) {
  return std::round(x / grain) * grain;
}

V in_grains(const V& v) {
  return {in_grains(v.x()), in_grains(v.y()), in_grains(v.z())};
}

/// Makes random shapes of one kind: the same with the same seed, but for their place.
class Maker {
 public:
  Maker(std::uint64_t seed, const V& place) : random_(seed), place_(place) {}

  S leaf() {
    const auto r = [&] { return random_.uniform(0.2, 1); };
    switch (random_.below(10)) {
      case 0:
        return Sphere{r()};
      case 1:
        return Box{{r(), r(), r()}};
      case 2:
        return Capsule{r(), r()};
      case 3:
        return Cylinder{r(), r()};
      case 4:
        return Cone{r(), r()};
      case 5:
        return Ellipsoid{{r(), r(), r()}};
      case 6:
        return Disk{r()};
      case 7:
        return TaperedCapsule{{r(), r()}, r()};
      case 8:
        return Superellipsoid{{r(), r(), r()}, random_.uniform(2, 6)};
      default:
        return points(V::Zero());
    }
  }
  S points(const V& at) {
    if (random_.below(2)) {
      Triangle triangle;
      for (V& p : triangle.points) p = at + in_grains(random_.in_cube());
      return triangle;
    }
    std::vector<V> cloud;
    for (int i = 0; i < 12; ++i) cloud.push_back(at + in_grains(random_.in_cube()));
    return Hull{PointCloud(std::move(cloud))};
  }
  Mat3<double> linear() {
    switch (random_.below(3)) {
      case 0:
        return Mat3<double>::Identity();
      case 1:
        return random_.rotation();
      default:
        return random_.rotation() *
               V(random_.uniform(0.5, 2), random_.uniform(0.5, 2), 1).asDiagonal() *
               random_.rotation();
    }
  }
  /// Some place near `times` the maker's.
  V somewhere(double times) { return in_grains(random_.in_cube()) + times * place_; }
  S mapped(S shape, const V& to) {
    return Transform{std::move(shape), {Affine<double>{linear(), to}}};
  }
  S at(double times) { return mapped(leaf(), somewhere(times)); }

  S of_kind(int kind) {
    switch (kind) {
      case 0:
        return at(1);
      case 1:
        return points(place_);
      case 2:
        return MinkowskiSum{{at(1), at(0)}};
      case 3:
        return MinkowskiSum{{at(3), at(-2), at(0)}};
      case 4:
        return MinkowskiDifference{at(2), at(1)};
      case 5:
        return HullOf{{at(1), at(1), points(place_)}};
      case 6:
        return Rounded{random_.uniform(0.01, 0.5), at(1)};
      case 7:
        return Rounded{random_.uniform(0.01, 0.5), points(place_)};
      case 8: {  // there and back
        Mat3<double> turn;
        turn << 0, 1, 0, 0, 0, 1, 1, 0, 0;
        const V inner = turn.transpose() * (3 * place_);
        return Transform{
            S(Transform{leaf(), Affine<double>{linear(), inner + in_grains(random_.in_cube())}}),
            Affine<double>{turn, V(in_grains(random_.in_cube()) - 2 * place_)}};
      }
      default:
        return MinkowskiSum{{S(HullOf{{at(1), at(1)}}), S(MinkowskiDifference{at(1), at(1)}),
                             S(Rounded{0.1, at(0)})}};
    }
  }
  static constexpr std::array<const char*, 10> kinds = {"leaf",
                                                        "points",
                                                        "sum",
                                                        "sum of far parts",
                                                        "difference",
                                                        "hull_of",
                                                        "rounded",
                                                        "rounded points",
                                                        "nested transforms",
                                                        "nests"};

 private:
  Random random_;
  V place_;
};

struct Truth {
  Status status = Status::exhausted;
  Long t = 0;
  double slope = 1;  ///< of the normal against the ray
};

Truth truth_of(const Shape& shape, const Ray<double>& ray) {
  const Ball<Long> ball = ball_around(bounds_of<Long>(shape));
  const Ray<Long> same{ray.origin.cast<Long>(), ray.direction.cast<Long>(), Long(ray.t_max)};
  const RayNearBall<Long> near =
      detail::ray_near_here<Long>(ball.centre, same).mapped(Mat3<Long>::Identity());
  GjkCastOptions<Long> options;
  const CastResult<Long> found = gjk_ray_cast(shape, near, ball, options);
  Truth truth;
  truth.status = found.status;
  truth.t = found.t();
  if (found.status == Status::hit)
    truth.slope = double(-found.normal.dot(same.direction) / same.direction.norm());
  return truth;
}

std::string report(Long off, const CastResult<double>& found) {
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(), ": t is %.17Lg, in %.17g to %.17g (%s)\n", off,
                found.offset_lo, found.offset_hi, std::string(name_of(found.path)).c_str());
  return text.data();
}

/// Error of the certified interval of a hit, if it has one.
std::string complaint_of_certificate(const S& shape, const Ray<double>& ray,
                                     const CastResult<double>& found, const Truth& truth) {
  if (found.status != Status::hit || truth.status != Status::hit) return "";
  const SupportFunction support = supports_of(shape);
  const Claim claim = claim_of(found);
  const CertificateVerdict verdict =
      check_certificate(support, ray, claim, certify(support, ray, claim));
  const Long off = truth.t - Long(verdict.t_base);
  if (!verdict.holds || (Long(verdict.offset_lo) <= off && off <= Long(verdict.offset_hi)))
    return "";
  return "the certified interval is false\n";
}

struct PlaceCounts {
  int rays = 0, hits = 0, exhausted = 0, wide = 0, unbounded = 0;
  std::string false_ones;

  void add_certificate(const S& shape, const Ray<double>& ray, const CastResult<double>& found,
                       const Truth& truth, const std::string& which) {
    const std::string complaint = complaint_of_certificate(shape, ray, found, truth);
    if (!complaint.empty()) false_ones += which + ": " + complaint;
  }

  /// `needed` is how far across a plane numbers round, and `unsure` the truth's own error along t.
  void add(const CastResult<double>& found, const Truth& truth, double speed, double needed,
           Long unsure, const std::string& which) {
    ++rays;
    hits += truth.status == Status::hit;
    if (found.status == Status::exhausted) {
      ++exhausted;
      return;
    }
    if (found.status != truth.status) {
      false_ones += which + ": " + std::string(name_of(found.status)) + " is " +
                    std::string(name_of(truth.status)) + "\n";
      return;
    }
    if (truth.status != Status::hit) return;
    const Long off = truth.t - Long(found.t_base);
    if (off < Long(found.offset_lo) - unsure || off > Long(found.offset_hi) + unsure)
      false_ones += which + report(off, found);
    const double width = (found.offset_hi - found.offset_lo) * truth.slope * speed;
    unbounded += !std::isfinite(width);
    // Both ways. Closed forms allow for more than they need.
    wide += found.path != Path::filter && width > 4 * 2 * needed;
  }
};

constexpr double epsilon = std::numeric_limits<double>::epsilon();

constexpr std::array places = {0.0, 10.0, 100.0, 1e4, 1e6, 1e9};

/// Uncertainty of the truth, along t.
Long unsure(const Truth& truth, const Ray<double>& ray, double R) {
  return 1e-17L * R / (truth.slope * ray.direction.norm());
}

class Places : public ::testing::TestWithParam<int> {};

TEST_P(Places, hold_the_truth) {
  const int kind = GetParam();
  for (const double distance : places) {
    PlaceCounts counts;
    for (std::uint64_t seed = 0; seed < std::uint64_t(number_of_cases(20)); ++seed) {
      Random random(1000 * seed + 7);
      const V place = in_grains(V(distance * random.direction()));
      const S here = Maker(seed, V::Zero()).of_kind(kind), there = Maker(seed, place).of_kind(kind);
      const PreparedShape by_pose(here, shifted_by(place)), in_shape(there);
      Instances instances;
      instances.add(here, shifted_by(place));
      const World world(std::move(instances));
      for (const RayFamily family : {RayFamily::random, RayFamily::grazing, RayFamily::camera}) {
        FamilyRays rays(here, family, seed);
        const double R = rays.ball().radius, needed = epsilon * (place.norm() + 8 * R);
        const std::string which = "seed " + std::to_string(seed);
        std::vector<WorldRay> asked;
        std::vector<Truth> truths;
        for (int i = 0; i < 8; ++i) {
          Ray<double> ray = rays.next();
          ray.origin = in_grains(ray.origin);
          const Truth truth = truth_of(here, ray);
          if (truth.status == Status::exhausted) continue;
          ray.origin += place;
          const CastResult<double> found = cast_ray(i % 2 ? by_pose : in_shape, ray);
          counts.add(found, truth, ray.direction.norm(), needed, unsure(truth, ray, R), which);
          if (i == 0) counts.add_certificate(there, ray, found, truth, which);
          asked.push_back({ray});
          truths.push_back(truth);
        }
        std::vector<WorldHit> hits(asked.size());
        QueryCounts queries;
        world.closest_hits(asked, hits, queries);
        for (std::size_t i = 0; i < hits.size(); ++i)
          if (hits[i].found() || queries.exhausted == 0)
            counts.add(hits[i].cast, truths[i], asked[i].ray.direction.norm(), needed,
                       unsure(truths[i], asked[i].ray, R), which + " in a world");
      }
    }
    SCOPED_TRACE(std::string(Maker::kinds[std::size_t(kind)]) + " at " + std::to_string(distance));
    EXPECT_EQ(counts.false_ones, "");
    EXPECT_LE(counts.exhausted, counts.rays / 100);
    EXPECT_GT(counts.hits, counts.rays / 4);
    // Rays that pass an edge within rounding: 6 of 10,000 of `hull_of`.
    EXPECT_LE(counts.unbounded, counts.hits / 500);
    EXPECT_LE(counts.wide, counts.hits / 20);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Places, ::testing::Range(0, int(Maker::kinds.size())));

/// A leaf, turned, scaled and turned again: one map after the other.
struct Needle {
  S leaf;
  std::array<Mat3<double>, 3> maps;  ///< the outermost first
  V place;

  S shape() const {
    const auto mapped = [](const Mat3<double>& map, S inner, const V& to) {
      return S(Transform{std::move(inner), Affine<double>{map, to}});
    };
    return mapped(maps[0], mapped(maps[1], mapped(maps[2], leaf, V::Zero()), V::Zero()), place);
  }
  V outward(const V& x) const { return maps[0] * (maps[1] * (maps[2] * x)) + place; }

  Truth truth_of(const Ray<double>& ray) const {
    QuadVec o = quad(ray.origin) - quad(place), d = quad(ray.direction);
    for (const Mat3<double>& map : maps) {
      o = solved(map.cast<Quad>(), o);
      d = solved(map.cast<Quad>(), d);
    }
    const Quad base = -o.dot(d) / d.squaredNorm();
    const Vec3<Long> at = (o + base * d).cast<Long>(), along = d.cast<Long>();
    const Interval in = *line_in_shape(leaf, at, along);
    Truth truth;
    const Quad first = base + Quad(in.lower);
    truth.status = in.empty() || base + Quad(in.upper) < 0 ? Status::miss
                   : first < 0                             ? Status::inside
                                                           : Status::hit;
    truth.t = static_cast<Long>(first);
    return truth;
  }
};

/// Bounds were false from 1:10^3 on, and statuses at 1:10^12.
TEST(NeedlesByMaps, hold_the_truth) {
  for (const bool plate : {false, true})
    for (const double thin : {1.0, 1e-2, 1e-4, 1e-6, 1e-9, 1e-12}) {
      PlaceCounts counts;
      for (std::uint64_t seed = 0; seed < std::uint64_t(number_of_cases(300)); ++seed) {
        Random random(seed);
        const auto r = [&] { return random.uniform(0.3, 1); };
        const std::array<S, 6> leaves = {Sphere{r()},       Box{{r(), r(), r()}},
                                         Capsule{r(), r()}, Cylinder{r(), r()},
                                         Cone{r(), r()},    Ellipsoid{{r(), r(), r()}}};
        const Needle needle{
            leaves[seed % leaves.size()],
            {random.rotation(), Mat3<double>(V(1, plate ? 1 : thin, thin).asDiagonal()),
             random.rotation()},
            seed % 2 ? V::Zero() : V(1e3 * random.in_cube())};
        const PreparedShape prepared(needle.shape());
        for (int i = 0; i < 10; ++i) {
          const V target = needle.outward(0.9 * random.in_cube());
          const V origin = needle.place + 3 * random.direction();
          const Ray<double> ray{origin, target - origin};
          const Truth truth = needle.truth_of(ray);
          counts.add(cast_ray(prepared, ray), truth, ray.direction.norm(), 1,
                     0x1p-60L * std::abs(truth.t), "seed " + std::to_string(seed));
        }
      }
      SCOPED_TRACE((plate ? "plate 1:" : "needle 1:") + std::to_string(1 / thin));
      EXPECT_EQ(counts.false_ones, "");
      EXPECT_GT(counts.hits, counts.rays / 4);
      if (plate || thin >= 1e-6) {
        EXPECT_LE(counts.exhausted, counts.rays / 100);
      }
    }
}

}  // namespace
}  // namespace minkray::testing
