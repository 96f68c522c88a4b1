// SPDX-License-Identifier: MIT
// The builder: from the root down, each node at once with all of its children (Wald, Benthin and
// Boulos, "Getting Rid of Packets", 2008): its range is split in two, the heaviest part again,
// until all places are taken. Large subtrees are built at once on several threads, each into nodes
// of its own, which are put together in the order of the tree: the result does not depend on who
// came first.
#include <algorithm>
#include <array>
#include <memory>

#include "core/bvh/bvh.h"
#include "core/bvh/split.h"
#include "core/parallel/parallel.h"

namespace minkray {
namespace {

/// Ranges at least as large are worth a second thread.
constexpr std::size_t parallel_size = 4096;

/// The parts that a node's range is split into.
struct Parts {
  std::array<BuildRange, bvh_width> ranges;
  std::size_t count = 0;

  /// Finds the range of the greatest weight among those that may be chosen; count if none may.
  template <class MayBe, class Weight>
  std::size_t heaviest(const MayBe& may_be, const Weight& weight) const {
    std::size_t best = count;
    for (std::size_t i = 0; i < count; ++i)
      if (may_be(ranges[i]) && (best == count || weight(ranges[i]) > weight(ranges[best])))
        best = i;
    return best;
  }
};

/// A piece of the hierarchy that one thread has built: nodes[0] is its root, and children are
/// counted from there. In a large piece the root stands alone, and its children are pieces.
struct Piece {
  std::vector<BvhNode> nodes;
  std::vector<std::pair<int, std::unique_ptr<Piece>>>
      below;  ///< with the child's place in the root
  BuildBox box;

  std::size_t node_count() const {
    std::size_t count = nodes.size();
    for (const auto& [child, piece] : below) count += piece->node_count();
    return count;
  }
};

template <class Splitter>
class Builder {
 public:
  Builder(std::span<const Primitive> primitives, const Splitter& splitter)
      : primitives_(primitives), splitter_(splitter) {}

  std::unique_ptr<Piece> build(const BuildRange& range) const {
    auto piece = std::make_unique<Piece>();
    if (range.count() < parallel_size) {
      piece->nodes.reserve(range.count() / 3 + 1);
      piece->box = append(range, piece->nodes);
      return piece;
    }
    const Parts parts = parts_of(range);
    std::array<std::unique_ptr<Piece>, bvh_width> built;
    for_parts(parts.count, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        if (parts.ranges[i].count() > 1) built[i] = build(parts.ranges[i]);
    });
    BvhNode root = empty_node();
    for (std::size_t i = 0; i < parts.count; ++i) {
      const int child = static_cast<int>(i);
      const BuildBox box = built[i] ? built[i]->box : primitives_[parts.ranges[i].begin].box;
      root.set(child, box.bounds(), leaf_of(parts.ranges[i].begin));
      piece->box.extend(box);
      if (built[i]) piece->below.emplace_back(child, std::move(built[i]));
    }
    piece->nodes.push_back(root);
    return piece;
  }

 private:
  /// Appends the nodes of a range, the root first, and answers its box.
  BuildBox append(const BuildRange& range, std::vector<BvhNode>& nodes) const {
    const std::size_t at = nodes.size();
    nodes.push_back(empty_node());
    const Parts parts = parts_of(range);
    BuildBox whole;
    for (std::size_t i = 0; i < parts.count; ++i) {
      const BuildRange& part = parts.ranges[i];
      std::uint32_t what = leaf_of(part.begin);
      BuildBox box = primitives_[part.begin].box;
      if (part.count() > 1) {
        what = static_cast<std::uint32_t>(nodes.size());
        box = append(part, nodes);
      }
      nodes[at].set(static_cast<int>(i), box.bounds(), what);
      whole.extend(box);
    }
    return whole;
  }

  Parts parts_of(const BuildRange& range) const {
    constexpr std::size_t width = bvh_width;
    Parts parts;
    const auto add_all = [&](const BuildRange& of) {
      for (std::size_t i = of.begin; i < of.end; ++i)
        parts.ranges[parts.count++] = {i, i + 1, of.depth + 1, {}};
    };
    if (range.count() <= width) {
      add_all(range);
      return parts;
    }
    parts.ranges[parts.count++] = range;
    while (parts.count < width) {
      // Ranges that fill no more than a node stay together.
      const std::size_t i =
          parts.heaviest([](const BuildRange& r) { return r.count() > width; }, Splitter::weight);
      if (i == parts.count) break;
      const BuildHalves halves = splitter_.split(parts.ranges[i]);
      parts.ranges[i] = halves.left;
      parts.ranges[parts.count++] = halves.right;
    }
    // What would be a node of its own, but finds room here.
    for (;;) {
      const std::size_t free = width - parts.count;
      const std::size_t i = parts.heaviest(
          [&](const BuildRange& r) { return r.count() > 1 && r.count() <= free + 1; },
          Splitter::weight);
      if (i == parts.count) return parts;
      const BuildRange inlined = parts.ranges[i];
      parts.ranges[i] = parts.ranges[--parts.count];
      add_all(inlined);
    }
  }

  std::uint32_t leaf_of(std::size_t primitive) const {
    return BvhNode::leaf | primitives_[primitive].index();
  }

  static BvhNode empty_node() {
    BvhNode node;
    for (int child = 0; child < bvh_width; ++child) node.set(child, {}, BvhNode::none);
    return node;
  }

  std::span<const Primitive> primitives_;
  const Splitter& splitter_;
};

/// Puts the nodes of a piece to `begin` and behind, and frees the piece.
void put(std::unique_ptr<Piece> piece, std::vector<BvhNode>& nodes, std::size_t begin) {
  for (std::size_t i = 0; i < piece->nodes.size(); ++i) {
    BvhNode& node = nodes[begin + i] = piece->nodes[i];
    for (std::uint32_t& child : node.children)
      if (!(child & BvhNode::leaf)) child += static_cast<std::uint32_t>(begin);
  }
  std::vector<std::size_t> begins;
  std::size_t next = begin + piece->nodes.size();
  for (const auto& [child, below] : piece->below) {
    nodes[begin].children[child] = static_cast<std::uint32_t>(next);
    begins.push_back(next);
    next += below->node_count();
  }
  for_parts(piece->below.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      put(std::move(piece->below[i].second), nodes, begins[i]);
  });
}

std::unique_ptr<Piece> built(std::vector<Primitive>& primitives, BvhBuild build) {
  if (build == BvhBuild::speed) {
    const CurveSplitter splitter(primitives);
    return Builder<CurveSplitter>(primitives, splitter).build(splitter.whole());
  }
  const AreaSplitter splitter(primitives);
  return Builder<AreaSplitter>(primitives, splitter).build(splitter.whole());
}

}  // namespace

Bvh build_bvh(std::span<const Bounds<float>> boxes, BvhBuild build) {
  Bvh bvh;
  if (boxes.empty()) return bvh;
  std::vector<Primitive> primitives(boxes.size());
  for_parts(boxes.size(), parallel_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      primitives[i] = Primitive(boxes[i], static_cast<std::uint32_t>(i));
  });
  std::unique_ptr<Piece> whole = built(primitives, build);
  // Before the nodes are there twice: of millions of primitives, memory is at its highest here.
  primitives = {};
  bvh.nodes.resize(whole->node_count());
  put(std::move(whole), bvh.nodes, 0);
  return bvh;
}

}  // namespace minkray
