// SPDX-License-Identifier: MIT
// Visits boxes with many rays in rounds: in each round, each ray visits the next box that it meets,
// near boxes first, and the rays at one box visit it together.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "core/bvh/traverse.h"

namespace minkray {

class BoxRounds {
 public:
  /// `bvh` contains the boxes. Limits of `slabs` may be lowered between rounds.
  BoxRounds(const Bvh& bvh, std::span<const Bounds<float>> boxes, std::span<const SlabRay> slabs)
      : boxes_(boxes), slabs_(slabs), next_(slabs.size()), ends_(slabs.size()) {
    for (std::size_t i = 0; i < slabs.size(); ++i) {
      next_[i] = static_cast<std::uint32_t>(met_.size());
      nodes_ += traverse(bvh, slabs_[i], [&](std::uint32_t box) {
        met_.push_back(box);
        return false;
      });
      ends_[i] = static_cast<std::uint32_t>(met_.size());
    }
    end_of_box_.resize(boxes.size());
  }

  /// Number of nodes that the constructor visited.
  std::uint64_t nodes() const { return nodes_; }

  /// Calls visit(box, rays) for each box of the next round. A ray takes part while is_open(ray) is
  /// true. Returns false if no ray takes part.
  template <class IsOpen, class Visit>
  bool next(const IsOpen& is_open, const Visit& visit) {
    // Sorts by box; rays of one box keep their order.
    pairs_.clear();
    std::ranges::fill(end_of_box_, 0u);
    for (std::uint32_t i = 0; i < next_.size(); ++i) {
      const std::uint32_t box = next_box(i, is_open);
      if (box == none) continue;
      pairs_.push_back({box, i});
      ++end_of_box_[box];
    }
    std::uint32_t begin = 0;
    for (std::uint32_t& of : end_of_box_) begin += std::exchange(of, begin);
    rays_.resize(pairs_.size());
    for (const Pair& one : pairs_) rays_[end_of_box_[one.box]++] = one.ray;
    begin = 0;
    for (std::uint32_t box = 0; box < end_of_box_.size(); ++box) {
      const std::uint32_t end = end_of_box_[box];
      if (end > begin) visit(box, std::span(rays_).subspan(begin, end - begin));
      begin = end;
    }
    return !pairs_.empty();
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  struct Pair {
    std::uint32_t box, ray;
  };

  template <class IsOpen>
  std::uint32_t next_box(std::uint32_t ray, const IsOpen& is_open) {
    if (!is_open(ray)) return none;
    while (next_[ray] < ends_[ray]) {
      const std::uint32_t box = met_[next_[ray]++];
      if (is_reached(boxes_[box], slabs_[ray].numbers)) return box;
    }
    return none;
  }

  /// The slab test of a traversal, for one box.
  static bool is_reached(const Bounds<float>& box, const SlabNumbers& ray) {
    float enter = 0, leave = ray.t_max;
    for (int axis = 0; axis < 3; ++axis) {
      const float corners[2] = {box.lower[axis], box.upper[axis]};
      const float in = (corners[ray.near[axis]] - ray.origin_near[axis]) * ray.inverse_near[axis],
                  out =
                      (corners[1 - ray.near[axis]] - ray.origin_far[axis]) * ray.inverse_far[axis];
      enter = in > enter ? in : enter;  // NaN does not count
      leave = out < leave ? out : leave;
    }
    return enter <= leave * slab_padding + slab_tiny;
  }

  std::span<const Bounds<float>> boxes_;
  std::span<const SlabRay> slabs_;
  std::uint64_t nodes_ = 0;
  std::vector<std::uint32_t> met_;          ///< boxes that rays meet, ray by ray
  std::vector<std::uint32_t> next_, ends_;  ///< by ray: its next box in met_, and the end
  std::vector<std::uint32_t> end_of_box_, rays_;
  std::vector<Pair> pairs_;
};

}  // namespace minkray
