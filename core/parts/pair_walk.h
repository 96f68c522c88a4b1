// SPDX-License-Identifier: MIT
// Traverses the pairs of parts of two bodies, nearest boxes first.
#pragma once

#include <algorithm>
#include <vector>

#include "core/parts/body_tree.h"

namespace minkray {

/// Relative poses of two bodies, with the middle of each as its origin.
struct Sight {
  Turned b_in_a, a_in_b;
  Vec3<double> middle_a;  ///< in the world
  Mat3<double> turn_a;    ///< from A's frame to the world
  double rounding;        ///< error bound of points, boxes and distances in A's frame

  Sight(const BodyTree& a, const Affine<double>& pose_a, const BodyTree& b,
        const Affine<double>& pose_b);
};

class PairWalk {
 public:
  PairWalk(const BodyTree& a, const BodyTree& b, const Sight& sight)
      : a_(a), b_(b), sight_(sight) {}

  /// Sets a unit vector in A's frame that points from A to B. Planes perpendicular to this vector
  /// are likely to separate many of the following pairs.
  void set_direction(const Vec3<double>& n) {
    has_direction_ = true;
    n_ = n;
    n_in_b_ = sight_.b_in_a.turn.transpose() * n;
    if (a_.is_shape()) up_a_ = a_.reach_along(n_);
    if (b_.is_shape()) down_b_ = b_.reach_along(-n_in_b_);
  }
  bool has_direction() const { return has_direction_; }
  const Vec3<double>& direction() const { return n_; }
  /// Extent of shape A along the direction, and of shape B in the opposite direction, from their
  /// middles.
  double up_a() const { return up_a_; }
  double down_b() const { return down_b_; }

  /// Calls visit(part_a, part_b) for pairs until it returns true. key(gap, box_a, box_b) must be a
  /// lower bound of every value that a call of visit() can find for parts in these two boxes. For
  /// boxes that overlap, the key must be below 0. Omits pairs whose key is above limit(). Returns
  /// the least key of the omitted pairs, or 0 after a visit that returned true.
  template <class Key, class Limit, class Visit>
  double run(const Key& key, const Limit& limit, const Visit& visit) {
    return run_leaves(key, limit, [&](BodyTree::Box a, BodyTree::Box b) {
      return visit_leaves(a, b, key, limit, visit);
    });
  }
  /// Same as run(), but calls visit_leaves(a, b) for two leaves.
  template <class Key, class Limit, class VisitLeaves>
  double run_leaves(const Key& key, const Limit& limit, const VisitLeaves& visit_leaves);

 private:
  struct Open {
    double key;
    BodyTree::Box a, b;
    bool operator<(const Open& other) const {
      if (key != other.key) return key > other.key;
      return a != other.a ? a > other.a : b > other.b;
    }
  };

  double up(const MiddleBox& box) const { return a_.is_shape() ? up_a_ : reach_along(box, n_); }
  double down(const MiddleBox& box) const {
    return b_.is_shape() ? down_b_ : reach_along(box, -n_in_b_);
  }
  double gap_along_direction(const MiddleBox& a, const MiddleBox& b) const {
    return n_.dot(sight_.b_in_a.shift) - down(b) - up(a);
  }
  void gaps_of_a(const EightBoxes& boxes, const MiddleBox& of_b, double* gaps) const {
    const KnownDirection known{n_, has_direction_ ? down(of_b) : 0};
    box_gaps(boxes, of_b, sight_.b_in_a, has_direction_ ? &known : nullptr, gaps);
  }
  void gaps_of_b(const EightBoxes& boxes, const MiddleBox& of_a, double* gaps) const {
    const KnownDirection known{-n_in_b_, has_direction_ ? up(of_a) : 0};
    box_gaps(boxes, of_a, sight_.a_in_b, has_direction_ ? &known : nullptr, gaps);
  }
  /// Records that a pair with this key was omitted.
  void leave_out(double key) { left_out_ = std::min(left_out_, key); }
  /// Returns true if a visit ends the traversal.
  template <class Key, class Limit, class Visit>
  bool visit_leaves(BodyTree::Box leaf_a, BodyTree::Box leaf_b, const Key& key, const Limit& limit,
                    const Visit& visit);

  const BodyTree &a_, &b_;
  const Sight& sight_;
  bool has_direction_ = false;
  Vec3<double> n_ = Vec3<double>::Zero(), n_in_b_ = Vec3<double>::Zero();
  double up_a_ = 0, down_b_ = 0;
  std::vector<Open> open_;
  double left_out_ = std::numeric_limits<double>::infinity();
};

/// Up to eight indices with their keys, the least key first.
class OrderOfEight {
 public:
  void add(double key, int index) {
    int at = count_++;
    for (; at > 0 && keys_[at - 1] > key; --at) {
      keys_[at] = keys_[at - 1];
      indices_[at] = indices_[at - 1];
    }
    keys_[at] = key;
    indices_[at] = index;
  }
  int size() const { return count_; }
  double key(int i) const { return keys_[i]; }
  int index(int i) const { return indices_[i]; }

 private:
  int count_ = 0;
  double keys_[EightBoxes::most];
  int indices_[EightBoxes::most];
};

template <class Key, class Limit, class Visit>
bool PairWalk::visit_leaves(BodyTree::Box leaf_a, BodyTree::Box leaf_b, const Key& key,
                            const Limit& limit, const Visit& visit) {
  EightBoxes of_a, of_b;
  std::uint32_t parts_a[EightBoxes::most], parts_b[EightBoxes::most];
  const int count_a = a_.open_leaf(leaf_a, of_a, parts_a),
            count_b = b_.open_leaf(leaf_b, of_b, parts_b);
  double gaps[EightBoxes::most];
  const MiddleBox all_b = b_.bounds(leaf_b);
  OrderOfEight first;
  gaps_of_a(of_a, all_b, gaps);
  for (int i = 0; i < count_a; ++i)
    first.add(key(gaps[i] - sight_.rounding, of_a.box(i), all_b), i);
  for (int i = 0; i < first.size(); ++i) {
    if (first.key(i) > limit()) {
      leave_out(first.key(i));
      return false;
    }
    const MiddleBox box_a = of_a.box(first.index(i));
    OrderOfEight second;
    gaps_of_b(of_b, box_a, gaps);
    for (int j = 0; j < count_b; ++j)
      second.add(key(gaps[j] - sight_.rounding, box_a, of_b.box(j)), j);
    for (int j = 0; j < second.size(); ++j) {
      if (second.key(j) > limit()) {
        leave_out(second.key(j));
        break;
      }
      if (visit(parts_a[first.index(i)], parts_b[second.index(j)])) return true;
    }
  }
  return false;
}

template <class Key, class Limit, class VisitLeaves>
double PairWalk::run_leaves(const Key& key, const Limit& limit, const VisitLeaves& visit_leaves) {
  constexpr double least = -std::numeric_limits<double>::infinity();
  EightBoxes boxes;
  BodyTree::Box children[EightBoxes::most];
  double gaps[EightBoxes::most];
  open_.assign(1, {least, BodyTree::whole, BodyTree::whole});
  while (!open_.empty()) {
    Open pair = open_.front();
    std::pop_heap(open_.begin(), open_.end());
    open_.pop_back();
    if (pair.key > limit()) return std::min(left_out_, pair.key);
    MiddleBox box_a = a_.bounds(pair.a), box_b = b_.bounds(pair.b);
    if (has_direction_) {  // the direction may be newer than the pair
      const double again = key(gap_along_direction(box_a, box_b) - sight_.rounding, box_a, box_b);
      if (again > limit()) {
        leave_out(again);
        continue;
      }
    }
    // Descends to leaves by the nearest child, so that a distance is found early.
    for (;;) {
      const bool is_leaf_a = a_.is_leaf(pair.a), is_leaf_b = b_.is_leaf(pair.b);
      if (is_leaf_a && is_leaf_b) {
        if (visit_leaves(pair.a, pair.b)) return 0;
        break;
      }
      const bool is_a = is_leaf_b || (!is_leaf_a && box_a.half.sum() >= box_b.half.sum());
      const int count = (is_a ? a_ : b_).open(is_a ? pair.a : pair.b, boxes, children);
      if (is_a)
        gaps_of_a(boxes, box_b, gaps);
      else
        gaps_of_b(boxes, box_a, gaps);
      OrderOfEight order;
      for (int i = 0; i < count; ++i) {
        const double gap = gaps[i] - sight_.rounding;
        const double its = is_a ? key(gap, boxes.box(i), box_b) : key(gap, box_a, boxes.box(i));
        if (its > limit())
          leave_out(its);
        else
          order.add(its == its ? its : least, i);  // NaN (from overflow) gives no bound
      }
      if (order.size() == 0) break;
      const auto child = [&](int i) -> Open {
        const BodyTree::Box box = children[order.index(i)];
        return {order.key(i), is_a ? box : pair.a, is_a ? pair.b : box};
      };
      for (int i = 1; i < order.size(); ++i) {
        open_.push_back(child(i));
        std::push_heap(open_.begin(), open_.end());
      }
      pair = child(0);
      (is_a ? box_a : box_b) = boxes.box(order.index(0));
    }
  }
  return left_out_;
}

}  // namespace minkray
