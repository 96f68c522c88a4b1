// SPDX-License-Identifier: MIT
// The builder: top down, 16 bins on each of the three axes, in place. Subtrees are built at once on
// several threads; where a subtree's nodes go depends on the numbers of primitives alone, so that
// the result does not depend on who came first.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "core/bvh/bvh.h"
#include "core/parallel/parallel.h"

namespace minkray {
namespace {

constexpr std::size_t bin_count = 16;

/// What testing a primitive costs, in units of visiting a node: a cast takes several support
/// points, each about as dear as a node. Leaves of several primitives are therefore rare.
constexpr double primitive_cost = 8;
constexpr std::size_t max_leaf_size = 8;

/// From this depth on ranges are split into halves, which takes at most 32 levels more.
constexpr int sah_depth = bvh_max_depth - 34;

/// Ranges at least as large are worth a second thread.
constexpr std::size_t parallel_size = 4096;

struct Box {
  std::array<float, 3> lower = {INFINITY, INFINITY, INFINITY};
  std::array<float, 3> upper = {-INFINITY, -INFINITY, -INFINITY};

  void extend(const Box& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], other.lower[i]);
      upper[i] = std::max(upper[i], other.upper[i]);
    }
  }

  /// Half of the surface; in double, which float extents cannot overflow.
  double area() const {
    const auto extent = [&](std::size_t i) { return double(upper[i]) - double(lower[i]); };
    return extent(0) * extent(1) + extent(1) * extent(2) + extent(2) * extent(0);
  }
};

struct Primitive {
  Box box;
  std::uint32_t index;

  /// Twice the middle, and never NaN.
  float middle(std::size_t axis) const {
    const float sum = box.lower[axis] + box.upper[axis];
    return std::isfinite(sum) ? sum : 0.0f;
  }
};

struct Bin {
  Box box;
  std::size_t count = 0;

  void extend(const Bin& other) {
    box.extend(other.box);
    count += other.count;
  }
};
using Bins = std::array<std::array<Bin, bin_count>, 3>;

/// The boxes of a range: of the primitives, and of their (doubled) middles.
struct Extent {
  Box box;
  Box middles;

  void extend(const Extent& other) {
    box.extend(other.box);
    middles.extend(other.middles);
  }
};

/// Where a primitive's middle falls among the bins of a range.
struct Binning {
  std::array<float, 3> lower;
  std::array<float, 3> scale;

  explicit Binning(const Box& middles) : lower(middles.lower) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      scale[axis] = static_cast<float>(bin_count) / (middles.upper[axis] - lower[axis]);
  }

  std::size_t operator()(const Primitive& primitive, std::size_t axis) const {
    const float at = (primitive.middle(axis) - lower[axis]) * scale[axis];
    // NaN (no extent at all) must fall through to the first bin.
    return at > 0.0f
               ? std::min(static_cast<std::size_t>(std::min(at, float(bin_count))), bin_count - 1)
               : 0;
  }
};

struct Split {
  double cost = std::numeric_limits<double>::infinity();  ///< sum of area * count over both sides
  std::size_t axis = 0;
  std::size_t bin = 0;  ///< the first bin of the right side
};

Box box_of(const Bounds<float>& bounds) {
  return {{bounds.lower.x(), bounds.lower.y(), bounds.lower.z()},
          {bounds.upper.x(), bounds.upper.y(), bounds.upper.z()}};
}

class Builder {
 public:
  template <class T>
  explicit Builder(std::span<const Bounds<T>> boxes)
      : primitives_(boxes.size()), nodes_(2 * boxes.size() - 1) {
    for_parts(boxes.size(), parallel_size, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        primitives_[i] = {box_of(rounded_outwards(boxes[i])), static_cast<std::uint32_t>(i)};
    });
  }

  Bvh build() {
    build_node(0, 1, 0, primitives_.size(), 0);
    Bvh bvh;
    bvh.primitives.reserve(primitives_.size());
    for (const Primitive& primitive : primitives_) bvh.primitives.push_back(primitive.index);
    // Before the nodes are there twice: of millions of primitives, memory is at its highest here.
    primitives_ = {};
    bvh.nodes = without_gaps();
    return bvh;
  }

 private:
  /// Builds the node `at` of the primitives [begin, end); its descendants, at most
  /// 2 (end - begin) - 2, go to free_nodes and behind.
  void build_node(std::size_t at, std::size_t free_nodes, std::size_t begin, std::size_t end,
                  int depth) {
    const std::size_t count = end - begin;
    const Extent extent = extent_of(begin, end);
    BvhNode& node = nodes_[at];
    for (std::size_t i = 0; i < 3; ++i) {
      node.planes[0][i] = extent.box.lower[i];
      node.planes[1][i] = extent.box.upper[i];
    }
    node.first = static_cast<std::uint32_t>(begin);
    node.count = static_cast<std::uint32_t>(count);
    if (count == 1) return;

    std::size_t middle = begin;
    if (depth < sah_depth) {
      const Binning binning(extent.middles);
      const Split split = best_split(binning, begin, end);
      const double area = extent.box.area();
      if (count <= max_leaf_size &&
          !(area + primitive_cost * split.cost < primitive_cost * area * double(count)))
        return;
      const auto first_right =
          std::partition(primitives_.begin() + offset(begin), primitives_.begin() + offset(end),
                         [&](const Primitive& p) { return binning(p, split.axis) < split.bin; });
      middle = static_cast<std::size_t>(first_right - primitives_.begin());
    }
    // Nothing to choose between (all in one place), or too deep: halves.
    if (middle == begin || middle == end) middle = begin + count / 2;

    node.first = static_cast<std::uint32_t>(free_nodes);
    node.count = 0;
    node_count_.fetch_add(2, std::memory_order_relaxed);
    const std::size_t left = free_nodes, right = free_nodes + 1;
    const std::size_t free_left = free_nodes + 2, free_right = free_left + 2 * (middle - begin) - 2;
    const auto build_left = [&] { build_node(left, free_left, begin, middle, depth + 1); };
    const auto build_right = [&] { build_node(right, free_right, middle, end, depth + 1); };
    if (count >= parallel_size) {
      run_both(build_left, build_right);
    } else {
      build_left();
      build_right();
    }
  }

  /// fold(result, i) for all i of a range, in parts; results of parts are joined in their order.
  template <class Result, class Fold>
  static Result folded(std::size_t begin, std::size_t end, const Fold& fold) {
    if (end - begin < 4 * parallel_size) {
      Result result;
      for (std::size_t i = begin; i < end; ++i) fold(result, i);
      return result;
    }
    constexpr std::size_t part_size = 2 * parallel_size;
    const std::size_t part_count = (end - begin + part_size - 1) / part_size;
    std::vector<Result> parts(part_count);
    for_parts(part_count, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t part = first; part < last; ++part)
        for (std::size_t i = begin + part * part_size;
             i < std::min(begin + (part + 1) * part_size, end); ++i)
          fold(parts[part], i);
    });
    Result result;
    for (const Result& part : parts) join(result, part);
    return result;
  }

  static void join(Extent& extent, const Extent& other) { extent.extend(other); }
  static void join(Bins& bins, const Bins& others) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < bin_count; ++i) bins[axis][i].extend(others[axis][i]);
  }

  Extent extent_of(std::size_t begin, std::size_t end) const {
    return folded<Extent>(begin, end, [&](Extent& extent, std::size_t i) {
      const Primitive& primitive = primitives_[i];
      extent.box.extend(primitive.box);
      Box middle;
      for (std::size_t axis = 0; axis < 3; ++axis)
        middle.lower[axis] = middle.upper[axis] = primitive.middle(axis);
      extent.middles.extend(middle);
    });
  }

  Split best_split(const Binning& binning, std::size_t begin, std::size_t end) const {
    const Bins bins = folded<Bins>(begin, end, [&](Bins& into, std::size_t i) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        into[axis][binning(primitives_[i], axis)].extend(Bin{primitives_[i].box, 1});
    });
    Split best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<double, bin_count> right_costs;
      Bin right;
      for (std::size_t i = bin_count; i-- > 1;) {
        right.extend(bins[axis][i]);
        right_costs[i] = right.count == 0 ? 0 : right.box.area() * double(right.count);
      }
      Bin left;
      for (std::size_t i = 1; i < bin_count; ++i) {
        left.extend(bins[axis][i - 1]);
        if (left.count == 0 || left.count == end - begin) continue;
        const double cost = left.box.area() * double(left.count) + right_costs[i];
        if (cost < best.cost) best = {cost, axis, i};
      }
    }
    return best;
  }

  /// The nodes without the room that leaves of several primitives left, siblings side by side,
  /// parents before children.
  std::vector<BvhNode> without_gaps() const {
    std::vector<BvhNode> packed;
    packed.reserve(node_count_);
    packed.push_back(nodes_[0]);
    std::vector<std::size_t> open = {0};  // packed nodes whose children are still to come
    while (!open.empty()) {
      BvhNode& parent = packed[open.back()];
      open.pop_back();
      if (parent.is_leaf()) continue;
      const std::size_t from = parent.first, to = packed.size();
      parent.first = static_cast<std::uint32_t>(to);
      packed.push_back(nodes_[from]);
      packed.push_back(nodes_[from + 1]);
      open.push_back(to + 1);
      open.push_back(to);
    }
    return packed;
  }

  static std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  std::vector<Primitive> primitives_;
  std::vector<BvhNode> nodes_;
  std::atomic<std::size_t> node_count_ = 1;
};

}  // namespace

template <class T>
Bvh build_bvh(std::span<const Bounds<T>> boxes) {
  if (boxes.empty()) return {};
  return Builder(boxes).build();
}

template Bvh build_bvh(std::span<const Bounds<float>>);
template Bvh build_bvh(std::span<const Bounds<double>>);

}  // namespace minkray
