// SPDX-License-Identifier: MIT
// Random rays at a shape; about half of them hit it.
#pragma once

#include "core/derived/shape_bounds.h"
#include "core/math/ray.h"
#include "tests/support/random.h"

namespace minkray::testing {

/// Rays are spread evenly in the frame where the shape's box is a cube, so that needles and plates
/// are hit as often as balls.
class AimedRays {
 public:
  AimedRays(const Bounds<double>& bounds, std::uint64_t seed, double distance = 3)
      : centre_(bounds.centre()), size_(bounds.half_extents()), random_(seed), distance_(distance) {
    const double largest = size_.maxCoeff();
    for (double& extent : size_)
      if (!(extent > 1e-9 * largest)) extent = largest;
  }

  /// `distance` sizes away from the centre, towards a point within `spread` sizes of it.
  Ray<double> next(double spread) {
    const Vec3<double> target = centre_ + (spread * random_.in_cube()).cwiseProduct(size_);
    const Vec3<double> origin = centre_ + (distance_ * random_.direction()).cwiseProduct(size_);
    return {origin, target - origin};
  }

  /// The spread with which half of the rays hit, by bisection.
  template <class Hits>
  double spread_for_half(const Hits& hits) {
    constexpr int pilot_rays = 300, steps = 12;
    const Random saved = random_;
    double low = 0, high = 2;
    for (int step = 0; step < steps; ++step) {
      random_ = saved;
      const double middle = (low + high) / 2;
      int count = 0;
      for (int i = 0; i < pilot_rays; ++i) count += hits(next(middle)) ? 1 : 0;
      (2 * count > pilot_rays ? low : high) = middle;
    }
    random_ = saved;
    return low;
  }

 private:
  Vec3<double> centre_, size_;
  Random random_;
  double distance_;
};

}  // namespace minkray::testing
