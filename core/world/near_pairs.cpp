// SPDX-License-Identifier: MIT
#include "core/world/near_pairs.h"

#include <algorithm>
#include <queue>

#include "core/parallel/parallel.h"
#include "core/parts/parts_distance.h"

namespace minkray {
namespace {

/// Lower bound of the distance of two boxes. The padding covers all rounding, as the boxes' numbers
/// are floats.
double distance(const Bounds<float>& a, const Bounds<float>& b) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double apart = std::max({double(a.lower[axis]) - double(b.upper[axis]),
                                   double(b.lower[axis]) - double(a.upper[axis]), 0.0});
    squared += apart * apart;
  }
  constexpr double padding = 1 - 8 * std::numeric_limits<double>::epsilon();
  return padding * std::sqrt(squared);
}

using Indices = std::pair<std::size_t, std::size_t>;

/// A child in a BVH: a node or a body.
struct Child {
  std::uint32_t what;
  Bounds<float> box;

  bool is_leaf() const { return (what & BvhNode::leaf) != 0; }
  std::size_t body() const { return what & ~BvhNode::leaf; }
};

/// Finds pairs of bodies whose boxes are near enough.
class PairWalk {
 public:
  PairWalk(const ContactWorld& first, const ContactWorld& second, const NearPairsOptions& options)
      : first_(first), second_(second), options_(options), is_self_(&first == &second) {}

  std::vector<Indices> run() {
    if (first_.bodies().empty() || second_.bodies().empty()) return {};
    open_.push_back({root_of(first_), root_of(second_)});
    while (!open_.empty()) {
      const auto [a, b] = open_.back();
      open_.pop_back();
      visit(a, b);
    }
    std::ranges::sort(found_);
    return found_;
  }

 private:
  static Child root_of(const ContactWorld&) {
    Bounds<float> everywhere;
    everywhere.lower.setConstant(-std::numeric_limits<float>::infinity());
    everywhere.upper.setConstant(std::numeric_limits<float>::infinity());
    return {0, everywhere};
  }

  static std::size_t children_of(const Child& child, const ContactWorld& world, Child* children) {
    if (child.is_leaf()) {
      children[0] = child;
      return 1;
    }
    const BvhNode& node = world.hierarchy().nodes[child.what];
    std::size_t count = 0;
    for (int i = 0; i < bvh_width && node.children[i] != BvhNode::none; ++i)
      children[count++] = {node.children[i], node.box(i)};
    return count;
  }

  void visit(const Child& a, const Child& b) {
    if (a.is_leaf() && b.is_leaf()) return add(a.body(), b.body());
    Child of_a[bvh_width], of_b[bvh_width];
    const std::size_t count_a = children_of(a, first_, of_a),
                      count_b = children_of(b, second_, of_b);
    const bool is_same = is_self_ && a.what == b.what;
    for (std::size_t i = 0; i < count_a; ++i)
      for (std::size_t j = is_same ? i : 0; j < count_b; ++j) {
        if (is_same && i == j && of_a[i].is_leaf()) continue;
        if (distance(of_a[i].box, of_b[j].box) <= options_.at_most)
          open_.push_back({of_a[i], of_b[j]});
      }
  }

  void add(std::size_t a, std::size_t b) {
    if (is_self_ && a > b) std::swap(a, b);
    if (!first_.bodies()[a].is_pair_with(second_.bodies()[b])) return;
    if (options_.wanted && !options_.wanted(a, b)) return;
    found_.emplace_back(a, b);
  }

  const ContactWorld &first_, &second_;
  const NearPairsOptions& options_;
  bool is_self_;
  std::vector<std::pair<Child, Child>> open_;
  std::vector<Indices> found_;
};

}  // namespace

ContactWorld::ContactWorld(std::vector<ContactBody> bodies) : bodies_(std::move(bodies)) {
  std::vector<Bounds<float>> boxes(bodies_.size());
  parallel_for(boxes.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) boxes[i] = rounded_outwards(bounds_of(bodies_[i]));
  });
  hierarchy_ = build_bvh(boxes);
}

std::vector<NearPair> near_pairs(const ContactWorld& first, const ContactWorld& second,
                                 const NearPairsOptions& options) {
  const std::vector<Indices> candidates = PairWalk(first, second, options).run();
  std::vector<NearPair> pairs(candidates.size());
  const auto part = [&](std::size_t begin, std::size_t end) {
    SignedDistanceOptions how;
    how.at_most = options.at_most;
    how.tolerance = options.tolerance;
    for (std::size_t i = begin; i < end; ++i) {
      const auto [a, b] = candidates[i];
      const ContactBody &of_a = first.bodies()[a], &of_b = second.bodies()[b];
      pairs[i] = {a, b, signed_distance(of_a.parts(), of_a.pose, of_b.parts(), of_b.pose, how)};
    }
  };
  constexpr std::size_t part_size = 64;
  if (options.run)
    options.run(pairs.size(), part_size, part);
  else
    parallel_for(pairs.size(), part_size, part);
  std::erase_if(pairs, [&](const NearPair& pair) { return pair.distance.lower > options.at_most; });
  return pairs;
}

std::vector<NearPair> near_pairs(const ContactWorld& world, const NearPairsOptions& options) {
  return near_pairs(world, world, options);
}

std::vector<NearPair> nearest_bodies(const ContactBody& to, const ContactWorld& world,
                                     std::size_t count, double at_most, double* others) {
  std::vector<NearPair> best;
  double least_of_others = std::numeric_limits<double>::infinity();
  if (others) *others = least_of_others;
  if (count == 0 || world.bodies().empty()) return best;
  const auto value_of = [](const NearPair& pair) {
    return pair.distance.is_unknown() ? std::numeric_limits<double>::infinity()
                                      : pair.distance.value;
  };
  const auto is_nearer = [&](const NearPair& a, const NearPair& b) {
    const double of_a = value_of(a), of_b = value_of(b);
    return of_a < of_b || (of_a == of_b && a.b < b.b);
  };
  // Nearest boxes first: a box further away than the worst body kept ends the search.
  struct Open {
    double distance;
    std::uint32_t what;
    bool operator<(const Open& other) const { return distance > other.distance; }
  };
  std::priority_queue<Open> open;
  open.push({0, 0});
  const Bounds<float> box = rounded_outwards(bounds_of(to));
  while (!open.empty()) {
    const Open top = open.top();
    open.pop();
    const bool is_full = best.size() == count;
    if (top.distance > at_most) break;
    // Overlapping boxes give no bound of the depth of the bodies' overlap.
    if (is_full && top.distance > std::max(best.back().distance.upper, 0.0)) break;
    if ((top.what & BvhNode::leaf) == 0) {
      const BvhNode& node = world.hierarchy().nodes[top.what];
      for (int i = 0; i < bvh_width && node.children[i] != BvhNode::none; ++i)
        open.push({distance(box, node.box(i)), node.children[i]});
      continue;
    }
    const std::size_t index = top.what & ~BvhNode::leaf;
    const ContactBody& body = world.bodies()[index];
    if (!to.is_pair_with(body)) continue;
    SignedDistanceOptions how;
    how.at_most = is_full ? std::min(at_most, best.back().distance.upper) : at_most;
    const NearPair pair{0, index,
                        signed_distance(to.parts(), to.pose, body.parts(), body.pose, how)};
    if (pair.distance.lower > at_most) continue;
    best.insert(std::ranges::upper_bound(best, pair, is_nearer), pair);
    if (best.size() <= count) continue;
    least_of_others = std::min(least_of_others, best.back().distance.lower);
    best.pop_back();
  }
  if (others) *others = least_of_others;
  return best;
}

}  // namespace minkray
