// SPDX-License-Identifier: MIT
// Random shapes of all kinds, each ready for signed distances and posed somewhere.
#pragma once

#include <utility>
#include <vector>

#include "core/pair_distance/signed_distance.h"
#include "tests/core/pair_distance/random_numbers.h"

namespace minkray::testing {

class RandomShapes : public RandomNumbers {
 public:
  using RandomNumbers::RandomNumbers;
  Shape hull(int count, double size) {
    std::vector<Vec3<double>> points;
    for (int i = 0; i < count; ++i) points.push_back(size * direction());
    return Hull{PointCloud(points)};
  }
};

inline constexpr int kinds_of_bodies = 17;

inline Shape random_shape(int kind, double s, RandomShapes& random) {
  const auto size = [&](double low, double high) { return s * random.in(low, high); };
  const auto sizes = [&]() -> Vec3<double> { return {size(0.1, 1), size(0.1, 1), size(0.1, 1)}; };
  switch (kind) {
    case 0:
      return Point{s * random.direction()};
    case 1:
      return Segment{{s * random.direction(), s * random.direction()}};
    case 2:
      return Triangle{{s * random.direction(), s * random.direction(), s * random.direction()}};
    case 3:
      return Sphere{size(0.2, 1)};
    case 4:
      return Ellipsoid{sizes()};
    case 5:
      return Box{sizes()};
    case 6:
      return Disk{size(0.2, 1)};
    case 7:
      return Cylinder{size(0.2, 1), size(0.1, 1)};
    case 8:
      return Cone{size(0.2, 1), size(0.1, 1)};
    case 9:
      return Capsule{size(0.1, 0.5), size(0.1, 1)};
    case 10:
      return Frustum{{size(0.1, 1), size(0.1, 1)}, size(0.1, 1)};
    case 11:
      return random.hull(12, s);
    case 12:
      return random.hull(64, s);
    case 13:
      return Rounded{size(0.05, 0.3), Nested(Shape(Box{sizes()}))};
    case 14:
      return Rounded{size(0.05, 0.3), Nested(random_shape(7, s, random))};
    case 15:
      return TaperedCapsule{{size(0.1, 0.5), size(0.1, 0.5)}, size(0.1, 1)};
    default:
      return Transform{
          Nested(random_shape(4, 1, random)),
          Affine<double>{Mat3<double>(random.turn() * Vec3<double>(s, 2 * s, s / 2).asDiagonal() *
                                      random.turn()),
                         s * random.direction()}};
  }
}

/// Plates, needles and blades: of size 1 one way and 1:`thin` another.
inline Shape slender_shape(double thin, RandomShapes& random) {
  const double t = 1 / thin, between = std::pow(t, random.in(0, 1));
  const bool is_plate = random.in(0, 1) < 0.5;
  switch (static_cast<int>(random.in(0, 7))) {
    case 0:
      return Ellipsoid{{1, between, t}};
    case 1:
      return is_plate ? Cylinder{1, t} : Cylinder{t, 1};
    case 2:
      return is_plate ? Cone{1, t} : Cone{t, 1};
    case 3:
      return Box{{1, between, t}};
    case 4:
      return Frustum{{t, 1}, t * random.in(0.1, 10)};
    case 5:
      return Capsule{t, 1};
    default: {
      std::vector<Vec3<double>> points;
      for (int i = 0; i < 32; ++i)
        points.push_back(Vec3<double>(1, between, t).cwiseProduct(random.direction()));
      return Hull{PointCloud(points)};
    }
  }
}

struct Body {
  Shape shape;
  ContactShape ready;
  Affine<double> pose;

  Body(Shape of, const Affine<double>& at) : shape(of), ready(of), pose(at) {}
  Vec3<double> in_body(const Vec3<double>& n) const { return pose.linear.transpose() * n; }
  /// The support function along n, seen from a point in the world that is near the body.
  long double support_function(const Vec3<double>& n, const Vec3<double>& from) const {
    const Vec3<double> s = shape.support(in_body(n));
    return n.cast<long double>().dot(
               pose.linear.cast<long double>() * s.cast<long double>() +
               (pose.translation.cast<long double>() - from.cast<long double>())) /
           n.cast<long double>().norm();
  }
};

inline double size_of(const Body& a, const Body& b) {
  return a.ready.ball_radius() + b.ready.ball_radius();
}

/// With the options and the memory that the library's own takes.
template <class... More>
SignedDistance signed_distance(const Body& a, const Body& b, More&&... more) {
  return minkray::signed_distance(a.ready, a.pose, b.ready, b.pose, std::forward<More>(more)...);
}

}  // namespace minkray::testing
