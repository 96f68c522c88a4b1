// SPDX-License-Identifier: MIT
// Shapes somewhere in the world, for tests of queries on pairs.
#pragma once

#include <vector>

#include "renderer/paper/distance.h"
#include "renderer/paper/shape_cast.h"
#include "tests/core/pair_distance/random_numbers.h"
#include "tests/support/shifted.h"

namespace minkray::testing {

class RandomPoses : public RandomNumbers {
 public:
  using RandomNumbers::RandomNumbers;
  Vec3<double> in_cube(double half) { return {in(-half, half), in(-half, half), in(-half, half)}; }
  Affine<double> pose(double spread) { return {turn(), in_cube(spread)}; }
  /// Points of the cube, or of the square in it where z is 0.
  std::vector<Vec3<double>> points(int count, bool flat) {
    std::vector<Vec3<double>> result;
    for (int i = 0; i < count; ++i) {
      result.push_back(in_cube(1));
      if (flat) result.back().z() = 0;
    }
    return result;
  }
};

inline Affine<double> at(const Vec3<double>& where) {
  return shifted_by(where);
}
inline Affine<double> at(double x, double y, double z) {
  return at(Vec3<double>(x, y, z));
}

inline CentredShape place(const Shape& shape, const Affine<double>& pose = {}) {
  return centred(shape, pose);
}

inline PreparedPair pair_of(const Shape& a, const Affine<double>& pose_a, const Shape& b,
                            const Affine<double>& pose_b) {
  return PreparedPair(centred(a, pose_a), centred(b, pose_b));
}

}  // namespace minkray::testing
