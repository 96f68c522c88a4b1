// SPDX-License-Identifier: MIT
// Boxes to build hierarchies of, and the truth about which of them a ray meets.
#pragma once

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "core/bvh/traverse.h"

namespace minkray::testing {

using Boxes = std::vector<Bounds<double>>;
using BoxSet = std::set<std::uint32_t>;

class BoxRandom {
 public:
  explicit BoxRandom(unsigned seed = 11) : generator_(seed) {}
  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(generator_); }
  Vec3<double> point(double size) {
    return {within(-size, size), within(-size, size), within(-size, size)};
  }

 private:
  std::mt19937 generator_;
};

inline Bounds<double> box(const Vec3<double>& a, const Vec3<double>& b) {
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

inline Boxes scattered_boxes(std::size_t count, BoxRandom& random) {
  Boxes boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3<double> middle = random.point(10), half = random.point(0.3).cwiseAbs();
    boxes.push_back({middle - half, middle + half});
  }
  return boxes;
}

inline std::vector<Bounds<float>> in_float(const Boxes& boxes) {
  std::vector<Bounds<float>> rounded;
  for (const Bounds<double>& b : boxes) rounded.push_back(rounded_outwards(b));
  return rounded;
}

inline Bvh built(const Boxes& boxes, BvhBuild build = BvhBuild::quality) {
  return build_bvh(in_float(boxes), build);
}

inline std::vector<InstructionSet> walk_sets() {
  std::vector<InstructionSet> sets = {InstructionSet::sse2};
  if (has_avx2()) sets.push_back(InstructionSet::avx2);
  return sets;
}

/// Uses the hierarchy.
template <class T>
BoxSet boxes_found(const Bvh& bvh, const Ray<T>& ray, InstructionSet set = best_instruction_set()) {
  BoxSet found;
  const SlabRay slabs(ray);
  traverse(
      bvh, slabs,
      [&](std::uint32_t i) {
        found.insert(i);
        return false;
      },
      ExpectNothing(), set);
  return found;
}

/// True if a ray meets a box that is closed and may be flat or unbounded: by division, in long
/// double.
inline bool meets(const Bounds<double>& box, const Ray<double>& ray) {
  long double enter = 0, leave = ray.t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const long double o = ray.origin[axis], d = ray.direction[axis];
    const long double lower = box.lower[axis], upper = box.upper[axis];
    if (d == 0) {
      if (o < lower || o > upper) return false;
      continue;
    }
    enter = std::max(enter, ((d > 0 ? lower : upper) - o) / d);
    leave = std::min(leave, ((d > 0 ? upper : lower) - o) / d);
  }
  return enter <= leave;
}

template <class T>
BoxSet boxes_met(const Boxes& boxes, const Ray<T>& ray) {
  const Ray<double> exact{ray.origin.template cast<double>(), ray.direction.template cast<double>(),
                          static_cast<double>(ray.t_max)};
  BoxSet met;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (meets(boxes[i], exact)) met.insert(i);
  return met;
}

inline bool includes(const BoxSet& all, const BoxSet& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

}  // namespace minkray::testing
