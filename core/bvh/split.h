// SPDX-License-Identifier: MIT
// Splits a range of primitives in two. BVH builders differ only in this step.
#pragma once

#include <cstddef>
#include <span>

#include "core/bvh/primitive.h"
#include "core/parallel/first_touch.h"

namespace minkray {

/// The primitives [begin, end), which are the result of `depth` splits.
struct BuildRange {
  std::size_t begin = 0, end = 0;
  int depth = 0;
  Extent extent;  ///< set by the area splitter only

  std::size_t count() const { return end - begin; }
};

struct BuildHalves {
  BuildRange left, right;
  int axis = 0;  ///< axis of the area splitter's split
};

/// Depth up to which splitters choose freely. From there on, ranges are split into halves of equal
/// count, which gives at most 32 more levels.
inline constexpr int free_split_depth = 46;

/// Splits by the surface area heuristic in bins on each axis (Wald, "On fast Construction of
/// SAH-based Bounding Volume Hierarchies", 2007). Reorders the primitives.
class AreaSplitter {
 public:
  explicit AreaSplitter(std::span<Primitive> primitives) : primitives_(primitives) {}
  BuildRange whole() const;
  BuildHalves split(const BuildRange& range) const;
  /// Weight of a range; the range with the largest weight in a node is split next.
  static double weight(const BuildRange& range) { return range.extent.box.area(); }

 private:
  std::span<Primitive> primitives_;
};

/// Like AreaSplitter, but small ranges are split at multiples of bvh_width, so that nearly all
/// leaves are full.
class FullLeafSplitter {
 public:
  explicit FullLeafSplitter(std::span<Primitive> primitives)
      : primitives_(primitives), by_area_(primitives) {}
  BuildRange whole() const { return by_area_.whole(); }
  BuildHalves split(const BuildRange& range) const;
  static double weight(const BuildRange& range) { return AreaSplitter::weight(range); }

 private:
  std::span<Primitive> primitives_;
  AreaSplitter by_area_;
};

/// Splits at the first bit that differs among the middles' positions on a Morton curve (Lauterbach
/// et al., "Fast BVH Construction on GPUs", 2009). Sorts the primitives when constructed.
class CurveSplitter {
 public:
  explicit CurveSplitter(FirstTouchVector<Primitive>& primitives);
  BuildRange whole() const { return {0, codes_.size(), 0, {}}; }
  BuildHalves split(const BuildRange& range) const;
  static double weight(const BuildRange& range) { return static_cast<double>(range.count()); }

 private:
  FirstTouchVector<std::uint32_t> codes_;
};

}  // namespace minkray
