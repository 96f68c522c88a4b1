// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/bvh/bvh.h"
#include "core/bvh/split.h"
#include "core/parallel/parallel_reduce.h"

namespace minkray {
namespace {

constexpr int most_bins = 16;
/// Ranges of few primitives use few bins, since sweeping over many bins would take longer than
/// filling them.
constexpr int few_bins = 8;
constexpr std::size_t few_primitives = 64;

/// Largest size of ranges that are split so that leaves are full. Larger ranges lose little by
/// leaves that are not full.
constexpr std::size_t most_of_full_leaves = 256;

struct Bins {
  std::array<std::array<BuildBox, most_bins>, 3> boxes;
  std::array<std::array<std::uint32_t, most_bins>, 3> counts{};

  void extend(const Bins& others) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < most_bins; ++i) {
        boxes[axis][i].extend(others.boxes[axis][i]);
        counts[axis][i] += others.counts[axis][i];
      }
  }
};

/// Assigns the middles of a range's primitives to bins.
class Binning {
 public:
  Binning(const BuildBox& middles, int bins)
      : lower_(middles.lower),
        scale_(Float4(static_cast<float>(bins)) / (middles.upper - middles.lower)),
        last_(static_cast<float>(bins - 1)) {}

  /// Returns the bin along each axis as a number in [0, bins), not rounded down.
  Float4 operator()(const Primitive& primitive) const {
    const Float4 at = (primitive.middle() - lower_) * scale_;
    // NaN (if the middles have no extent) must select the first bin.
    return min(select(at > Float4(0.0f), at, Float4(0.0f)), last_);
  }
  /// Returns the bin along one axis. `axis` need not be known when this is compiled.
  float along(int axis, const Primitive& primitive) const {
    const float sum = primitive.box.lower.lane(axis) + primitive.box.upper.lane(axis);
    const float middle = std::abs(sum) <= std::numeric_limits<float>::max() ? sum : 0.0f;
    const float at = (middle - lower_.lane(axis)) * scale_.lane(axis);
    return std::min(at > 0.0f ? at : 0.0f, last_.lane(axis));
  }

 private:
  Float4 lower_, scale_, last_;
};

struct Split {
  double cost = std::numeric_limits<double>::infinity();  ///< sum of area * count over both sides
  int axis = 0;
  int bin = 0;  ///< the first bin of the right side
};

Split best_split(const Bins& bins, int bin_count, std::size_t count) {
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& boxes = bins.boxes[static_cast<std::size_t>(axis)];
    const auto& counts = bins.counts[static_cast<std::size_t>(axis)];
    std::array<double, most_bins> right_costs;
    BuildBox right;
    std::size_t in_right = 0;
    for (int i = bin_count; i-- > 1;) {
      const auto at = static_cast<std::size_t>(i);
      right.extend(boxes[at]);
      in_right += counts[at];
      right_costs[at] = in_right == 0 ? 0 : right.area() * static_cast<double>(in_right);
    }
    BuildBox left;
    std::size_t in_left = 0;
    for (int i = 1; i < bin_count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      left.extend(boxes[at - 1]);
      in_left += counts[at - 1];
      if (in_left == 0 || in_left == count) continue;
      const double cost = left.area() * static_cast<double>(in_left) + right_costs[at];
      if (cost < best.cost) best = {cost, axis, i};
    }
  }
  return best;
}

void join(Extent& extent, const Extent& other) {
  extent.extend(other);
}

Extent extent_of(std::span<const Primitive> primitives, std::size_t begin, std::size_t end) {
  return parallel_reduce<Extent>(
      begin, end, [&](Extent& extent, std::size_t i) { extent.add(primitives[i]); }, join);
}

}  // namespace

BuildRange AreaSplitter::whole() const {
  return {0, primitives_.size(), 0, extent_of(primitives_, 0, primitives_.size())};
}

BuildHalves AreaSplitter::split(const BuildRange& range) const {
  BuildHalves halves;
  std::size_t left = range.begin;
  if (range.depth < free_split_depth) {
    const int bin_count = range.count() < few_primitives ? few_bins : most_bins;
    const Binning binning(range.extent.middles, bin_count);
    const auto fill = [&](Bins& bins, std::size_t i) {
      const Primitive& primitive = primitives_[i];
      const Float4 at = binning(primitive);
#pragma GCC unroll 3
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto bin = static_cast<std::size_t>(at.lane(static_cast<int>(axis)));
        bins.boxes[axis][bin].extend(primitive.box);
        ++bins.counts[axis][bin];
      }
    };
    const auto bins =
        parallel_reduce<Bins>(range.begin, range.end, fill,
                              [](Bins& into, const Bins& of_range) { into.extend(of_range); });
    const Split best = best_split(bins, bin_count, range.count());
    halves.axis = best.axis;

    // Partitions without a branch, which would be unpredictable.
    const auto first_right = static_cast<float>(best.bin);
    for (std::size_t i = range.begin; best.bin > 0 && i < range.end; ++i) {
      const std::size_t is_left = binning.along(best.axis, primitives_[i]) < first_right ? 1 : 0;
      std::swap(primitives_[i], primitives_[left]);
      left += is_left;
    }
  }
  // If all middles are at one place, or if the range is too deep, splits into halves of equal
  // count.
  if (left == range.begin || left == range.end) left = range.begin + range.count() / 2;
  halves.left = {range.begin, left, range.depth + 1, extent_of(primitives_, range.begin, left)};
  halves.right = {left, range.end, range.depth + 1, extent_of(primitives_, left, range.end)};
  return halves;
}

BuildHalves FullLeafSplitter::split(const BuildRange& range) const {
  constexpr std::size_t leaf = bvh_width;
  BuildHalves halves = by_area_.split(range);
  if (range.count() > most_of_full_leaves || halves.left.count() % leaf == 0) return halves;
  const std::size_t most = (range.count() - 1) / leaf * leaf;
  const std::size_t middle =
      range.begin + std::clamp((halves.left.count() + leaf / 2) / leaf * leaf, leaf, most);
  const auto at = [&](std::size_t i) {
    return primitives_.begin() + static_cast<std::ptrdiff_t>(i);
  };
  std::nth_element(at(range.begin), at(middle), at(range.end),
                   [axis = halves.axis](const Primitive& a, const Primitive& b) {
                     return a.middle().lane(axis) < b.middle().lane(axis);
                   });
  halves.left = {range.begin, middle, range.depth + 1, {}};
  halves.right = {middle, range.end, range.depth + 1, {}};
  halves.left.extent = extent_of(primitives_, range.begin, middle);
  halves.right.extent = extent_of(primitives_, middle, range.end);
  return halves;
}

}  // namespace minkray
