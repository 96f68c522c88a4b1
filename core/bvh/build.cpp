// SPDX-License-Identifier: MIT
// Builds a BVH from the root down (Wald, Benthin and Boulos, "Getting Rid of Packets", 2008). A
// node's range is split in two, then the heaviest of its parts, until the node is full. Large
// subtrees are built in parallel, each with its own array of nodes. The arrays are joined in the
// order of the tree, so the result does not depend on the order of threads.
#include <algorithm>
#include <array>
#include <memory>

#include "core/bvh/bvh.h"
#include "core/bvh/leaves.h"
#include "core/bvh/split.h"
#include "core/parallel/parallel.h"

namespace minkray {
namespace {

/// Least size of ranges for which a second thread saves time.
constexpr std::size_t parallel_size = 4096;

/// The ranges of a node's children; together they are the node's range.
struct ChildRanges {
  std::array<BuildRange, bvh_width> ranges;
  std::size_t count = 0;

  /// Returns the index of the range with the greatest weight, of those for which may_be(range) is
  /// true. Returns `count` if may_be is false for all ranges.
  template <class MayBe, class Weight>
  std::size_t heaviest(const MayBe& may_be, const Weight& weight) const {
    std::size_t best = count;
    for (std::size_t i = 0; i < count; ++i)
      if (may_be(ranges[i]) && (best == count || weight(ranges[i]) > weight(ranges[best])))
        best = i;
    return best;
  }
};

/// A subtree built by one thread: nodes[0] is its root, and children are indices relative to it. A
/// large subtree stores only its root; the children are subtrees.
struct Subtree {
  FirstTouchVector<BvhNode> nodes;
  std::vector<std::pair<int, std::unique_ptr<Subtree>>>
      below;  ///< with the index of the child in the root
  BuildBox box;

  std::size_t node_count() const {
    std::size_t count = nodes.size();
    for (const auto& [child, subtree] : below) count += subtree->node_count();
    return count;
  }
};

/// Contents of leaves: a single box, or a range of boxes.
enum class Leaves : unsigned char { boxes, ranges };

template <class Splitter, Leaves leaves = Leaves::boxes>
class Builder {
 public:
  Builder(std::span<const Primitive> primitives, const Splitter& splitter)
      : primitives_(primitives), splitter_(splitter) {}

  std::unique_ptr<Subtree> build(const BuildRange& range) const {
    auto subtree = std::make_unique<Subtree>();
    if (range.count() < parallel_size) {
      subtree->nodes.reserve(range.count() / (leaves == Leaves::ranges ? 32 : 3) + 1);
      subtree->box = append(range, subtree->nodes);
      return subtree;
    }
    const ChildRanges children = children_of(range);
    std::array<std::unique_ptr<Subtree>, bvh_width> built;
    parallel_for(children.count, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        if (!is_leaf(children.ranges[i])) built[i] = build(children.ranges[i]);
    });
    BvhNode root = empty_node();
    for (std::size_t i = 0; i < children.count; ++i) {
      const int child = static_cast<int>(i);
      const BuildBox box = built[i] ? built[i]->box : box_of_leaf(children.ranges[i]);
      root.set(child, box.bounds(), leaf_of(children.ranges[i].begin));
      subtree->box.extend(box);
      if (built[i]) subtree->below.emplace_back(child, std::move(built[i]));
    }
    subtree->nodes.push_back(root);
    return subtree;
  }

 private:
  /// Appends the nodes of a range, the root first. Returns the range's box.
  BuildBox append(const BuildRange& range, FirstTouchVector<BvhNode>& nodes) const {
    const std::size_t at = nodes.size();
    nodes.push_back(empty_node());
    const ChildRanges children = children_of(range);
    BuildBox whole;
    for (std::size_t i = 0; i < children.count; ++i) {
      const BuildRange& child = children.ranges[i];
      std::uint32_t what = leaf_of(child.begin);
      BuildBox box;
      if (is_leaf(child)) {
        box = box_of_leaf(child);
      } else {
        what = static_cast<std::uint32_t>(nodes.size());
        box = append(child, nodes);
      }
      nodes[at].set(static_cast<int>(i), box.bounds(), what);
      whole.extend(box);
    }
    return whole;
  }

  ChildRanges children_of(const BuildRange& range) const {
    constexpr std::size_t width = bvh_width;
    ChildRanges children;
    const auto add_all = [&](const BuildRange& of) {
      for (std::size_t i = of.begin; i < of.end; ++i)
        children.ranges[children.count++] = {i, i + 1, of.depth + 1, {}};
    };
    if (range.count() <= width) {  // for leaves of ranges, the single child is a leaf
      if constexpr (leaves == Leaves::boxes)
        add_all(range);
      else
        children.ranges[children.count++] = range;
      return children;
    }
    children.ranges[children.count++] = range;
    while (children.count < width) {
      // Ranges that fit in one node are not split.
      const std::size_t i = children.heaviest([](const BuildRange& r) { return r.count() > width; },
                                              Splitter::weight);
      if (i == children.count) break;
      const BuildHalves halves = splitter_.split(children.ranges[i]);
      children.ranges[i] = halves.left;
      children.ranges[children.count++] = halves.right;
    }
    if constexpr (leaves == Leaves::ranges) return children;
    // Moves the boxes of small child nodes into this node if there is room, which saves the child
    // node.
    for (;;) {
      const std::size_t free = width - children.count;
      const std::size_t i = children.heaviest(
          [&](const BuildRange& r) { return r.count() > 1 && r.count() <= free + 1; },
          Splitter::weight);
      if (i == children.count) return children;
      const BuildRange inlined = children.ranges[i];
      children.ranges[i] = children.ranges[--children.count];
      add_all(inlined);
    }
  }

  /// Returns a leaf child. A leaf with a range of boxes is identified by the first primitive of the
  /// range.
  std::uint32_t leaf_of(std::size_t primitive) const {
    if constexpr (leaves == Leaves::ranges)
      return BvhNode::leaf | static_cast<std::uint32_t>(primitive);
    return BvhNode::leaf | primitives_[primitive].index();
  }
  static bool is_leaf(const BuildRange& range) {
    return range.count() <= (leaves == Leaves::ranges ? std::size_t{bvh_width} : 1);
  }
  BuildBox box_of_leaf(const BuildRange& range) const {
    BuildBox box = primitives_[range.begin].box;
    for (std::size_t i = range.begin + 1; i < range.end; ++i) box.extend(primitives_[i].box);
    return box;
  }

  static BvhNode empty_node() {
    BvhNode node;
    for (int child = 0; child < bvh_width; ++child) node.set(child, {}, BvhNode::none);
    return node;
  }

  std::span<const Primitive> primitives_;
  const Splitter& splitter_;
};

/// Moves the nodes of a subtree to index `begin` and following ones, and frees the subtree.
void put(std::unique_ptr<Subtree> subtree, FirstTouchVector<BvhNode>& nodes, std::size_t begin) {
  for (std::size_t i = 0; i < subtree->nodes.size(); ++i) {
    BvhNode& node = nodes[begin + i] = subtree->nodes[i];
    for (std::uint32_t& child : node.children)
      if (!(child & BvhNode::leaf)) child += static_cast<std::uint32_t>(begin);
  }
  std::vector<std::size_t> begins;
  std::size_t next = begin + subtree->nodes.size();
  for (const auto& [child, below] : subtree->below) {
    nodes[begin].children[child] = static_cast<std::uint32_t>(next);
    begins.push_back(next);
    next += below->node_count();
  }
  parallel_for(subtree->below.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      put(std::move(subtree->below[i].second), nodes, begins[i]);
  });
}

std::unique_ptr<Subtree> built(FirstTouchVector<Primitive>& primitives, BvhBuild build) {
  if (build == BvhBuild::speed) {
    const CurveSplitter splitter(primitives);
    return Builder<CurveSplitter>(primitives, splitter).build(splitter.whole());
  }
  const AreaSplitter splitter(primitives);
  return Builder<AreaSplitter>(primitives, splitter).build(splitter.whole());
}

FirstTouchVector<Primitive> primitives_of(std::span<const Bounds<float>> boxes) {
  FirstTouchVector<Primitive> primitives;
  primitives.resize(boxes.size());
  parallel_for(boxes.size(), parallel_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      primitives[i] = Primitive(boxes[i], static_cast<std::uint32_t>(i));
  });
  return primitives;
}

/// Numbers the leaves in the order of their boxes.
void number_leaves(BvhOfLeaves& leaves) {
  FirstTouchVector<std::uint32_t> number;
  number.resize(leaves.boxes.size());
  std::ranges::fill(number, 0u);
  const auto each_leaf = [&](const auto& visit) {
    for (BvhNode& node : leaves.bvh.nodes)
      for (std::uint32_t& child : node.children)
        if (child != BvhNode::none && (child & BvhNode::leaf)) visit(child);
  };
  std::uint32_t count = 0;
  each_leaf([&](std::uint32_t child) { number[child & ~BvhNode::leaf] = 1; });
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    if (number[i] == 0) continue;
    number[i] = count++;
    leaves.begins.push_back(i);
  }
  leaves.begins.push_back(static_cast<std::uint32_t>(number.size()));
  each_leaf([&](std::uint32_t& child) { child = BvhNode::leaf | number[child & ~BvhNode::leaf]; });
}

Bvh bvh_of(FirstTouchVector<Primitive> primitives, BvhBuild build) {
  Bvh bvh;
  if (primitives.empty()) return bvh;
  std::unique_ptr<Subtree> whole = built(primitives, build);
  // Frees the primitives before the nodes are copied: memory use is at its highest here.
  primitives = {};
  bvh.nodes.resize(whole->node_count());
  put(std::move(whole), bvh.nodes, 0);
  return bvh;
}

}  // namespace

Bvh build_bvh(std::span<const Bounds<float>> boxes, BvhBuild build) {
  return bvh_of(primitives_of(boxes), build);
}

Bvh build_bvh(FirstTouchVector<Bounds<float>>&& boxes, BvhBuild build) {
  FirstTouchVector<Primitive> primitives = primitives_of(boxes);
  boxes = {};
  return bvh_of(std::move(primitives), build);
}

BvhOfLeaves build_bvh_of_leaves(FirstTouchVector<Bounds<float>>&& boxes) {
  FirstTouchVector<Primitive> primitives = primitives_of(boxes);
  boxes = {};
  BvhOfLeaves leaves;
  if (primitives.empty()) return leaves;
  const FullLeafSplitter splitter(primitives);
  const Builder<FullLeafSplitter, Leaves::ranges> builder(primitives, splitter);
  std::unique_ptr<Subtree> whole = builder.build(splitter.whole());
  leaves.boxes.resize(primitives.size());
  for (std::size_t i = 0; i < primitives.size(); ++i) leaves.boxes[i] = primitives[i].index();
  primitives = {};
  leaves.bvh.nodes.resize(whole->node_count());
  put(std::move(whole), leaves.bvh.nodes, 0);
  number_leaves(leaves);
  return leaves;
}

}  // namespace minkray
