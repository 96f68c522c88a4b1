// SPDX-License-Identifier: MIT
// Casts rays of different directions at a mesh in turns, four nodes at once: the processor works on
// several chains of operations and waits for several lines of memory at the same time
// (docs/decisions/streams.md). Everything here has internal linkage.
#include "core/mesh/mesh_walk.h"

#if defined(__AVX2__)
#include "core/bvh/sorted_lanes.h"
#include "core/mesh/triangle_lanes.h"

namespace minkray {
namespace {

/// Number of rays that take turns, and number of rays stepped at once.
constexpr std::uint32_t turns = 32, abreast = 4;

/// Entries that are always live, below each stack's first.
constexpr int sentinels = 8;
constexpr int stack_size = sentinels + bvh_max_depth * (bvh_width - 1) + 1 + bvh_width;

struct Turn {
  SlabRay slabs;
  LeafRay leaf;
  CastRay cast;
  PartHit best;
  std::uint32_t ray;
  std::uint32_t what;  ///< the node or leaf that is next
  int top;
  float enter[stack_size];
  std::uint32_t waiting[stack_size];
};

void begin(Turn& turn, const PartRay& ray, std::uint32_t number) {
  make_slabs_avx2(reinterpret_cast<const char*>(&ray.ray), 0, 1, &turn.slabs);
  const double* const numbers = reinterpret_cast<const double*>(&ray.ray);
  turn.leaf = leaf_ray(numbers, numbers + 3, ray.ray.t_max);
  turn.cast = cast_ray_of(ray.ray, turn.leaf);
  turn.best = {};
  turn.ray = number;
  turn.what = 0;
  turn.top = sentinels;
}

/// Takes the nearest entry from the stack. False if nothing is left that is near enough.
bool next_of(Turn& turn) {
  const __m256 limit = _mm256_set1_ps(turn.slabs.numbers.t_max);
  for (;;) {
    const __m256 top = _mm256_loadu_ps(turn.enter + turn.top - 8);
    const auto live =
        static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(top, limit, _CMP_LE_OQ)));
    if (live == 0 && turn.top > sentinels) {
      turn.top -= 8;
      if (turn.top < sentinels) turn.top = sentinels;
      continue;
    }
    if (live != 0) turn.top -= __builtin_clz(live) - 24;
    if (turn.top <= sentinels) return false;
    turn.what = turn.waiting[--turn.top];
    return true;
  }
}

/// Pushes the children in the nodes of several turns on their stacks, phase by phase.
template <std::uint32_t count>
[[gnu::always_inline]] inline void take_nodes(const BvhNode* nodes, Turn* const* turn) {
  const __m256i lane_numbers = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i lane_bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  const __m256i without_lane = _mm256_set1_epi32(~7);
  __m256 enter[count], leave[count];
  __m256i keys[count], children[count];
  std::uint32_t met[count];
#pragma GCC unroll 8
  for (std::uint32_t k = 0; k < count; ++k) {
    const SlabNumbers& ray = turn[k]->slabs.numbers;
    const BvhNode& node = nodes[turn[k]->what];
    enter[k] = _mm256_setzero_ps();
    leave[k] = _mm256_set1_ps(ray.t_max);
#pragma GCC unroll 3
    for (int axis = 0; axis < 3; ++axis) {
      const __m256 in =
          _mm256_mul_ps(_mm256_sub_ps(_mm256_load_ps(node.planes[ray.near[axis]][axis]),
                                      _mm256_set1_ps(ray.origin_near[axis])),
                        _mm256_set1_ps(ray.inverse_near[axis]));
      const __m256 out =
          _mm256_mul_ps(_mm256_sub_ps(_mm256_load_ps(node.planes[1 - ray.near[axis]][axis]),
                                      _mm256_set1_ps(ray.origin_far[axis])),
                        _mm256_set1_ps(ray.inverse_far[axis]));
      // As std::max and std::min: NaN falls through.
      enter[k] = _mm256_max_ps(in, enter[k]);
      leave[k] = _mm256_min_ps(out, leave[k]);
    }
    children[k] = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.children));
  }
#pragma GCC unroll 8
  for (std::uint32_t k = 0; k < count; ++k) {
    const __m256 padded = _mm256_add_ps(_mm256_mul_ps(leave[k], _mm256_set1_ps(slab_padding)),
                                        _mm256_set1_ps(slab_tiny));
    // All bits set means no child.
    const __m256 is_none =
        _mm256_castsi256_ps(_mm256_cmpeq_epi32(children[k], _mm256_set1_epi32(-1)));
    met[k] = static_cast<std::uint32_t>(
        _mm256_movemask_ps(_mm256_andnot_ps(is_none, _mm256_cmp_ps(enter[k], padded, _CMP_LE_OQ))));
  }
  // Sorts the furthest first. Parameters at which boxes are entered, cut off to make room for the
  // lane's number, are not negative, so they sort as whole numbers. Missed boxes come last, as -1.
#pragma GCC unroll 8
  for (std::uint32_t k = 0; k < count; ++k) {
    const __m256i is_missed =
        _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(static_cast<int>(met[k])), lane_bit),
                           _mm256_setzero_si256());
    keys[k] = _mm256_or_si256(
        _mm256_or_si256(_mm256_and_si256(_mm256_castps_si256(enter[k]), without_lane),
                        lane_numbers),
        is_missed);
  }
  sort_keys(keys);
#pragma GCC unroll 8
  for (std::uint32_t k = 0; k < count; ++k) {
    Turn& to = *turn[k];
    _mm256_storeu_ps(to.enter + to.top,
                     _mm256_castsi256_ps(_mm256_and_si256(keys[k], without_lane)));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to.waiting + to.top),
                        _mm256_permutevar8x32_epi32(children[k], keys[k]));
    to.top += __builtin_popcount(met[k]);
  }
}

/// Casts rays at a mesh, until all have results. Hit: PartHit for closest hits, or std::uint8_t.
template <class Hit>
class Stream {
 public:
  Stream(const MeshView& view, const PartRay* rays, std::size_t count, Hit* hits,
         PartCounts& counts)
      : view_(view),
        rays_(rays),
        hits_(hits),
        counts_(counts),
        count_(static_cast<std::uint32_t>(count)) {}

  void walk() {
    for (std::uint32_t i = 0; i < turns && next_ < count_; ++i) {
      Turn& turn = all_[i];
      for (int k = 0; k < sentinels; ++k) turn.enter[k] = -std::numeric_limits<float>::infinity();
      begin(turn, rays_[next_], next_);
      ++next_;
      nodes_[node_count_++] = &turn;
    }
    while (node_count_ + leaf_count_ != 0) {
      if (node_count_ >= abreast)
        take<abreast>();
      else if (leaf_count_ != 0)
        take_leaves();
      else
        take<1>();
    }
  }

 private:
  template <std::uint32_t count>
  void take() {
    Turn* now[count];
    node_count_ -= count;
    for (std::uint32_t k = 0; k < count; ++k) now[k] = nodes_[node_count_ + k];
    counts_.nodes += count;
    take_nodes<count>(view_.nodes, now);
    for (std::uint32_t k = 0; k < count; ++k) file(now[k]);
  }

  /// Queues the turn by its next node or leaf; a turn with nothing left takes another ray.
  void file(Turn* turn) {
    if (!next_of(*turn)) {
      answer(*turn);
      if (next_ == count_) return;
      begin(*turn, rays_[next_], next_);
      ++next_;
    }
    // Branch-free: node or leaf is nearly random.
    const std::uint32_t what = turn->what, is_leaf = what >> 31;
    leaves_[leaf_count_] = turn;
    leaf_count_ += is_leaf;
    nodes_[node_count_] = turn;
    node_count_ += 1 - is_leaf;
    fetch(view_, what);
  }

  void answer(const Turn& turn) {
    if constexpr (std::is_same_v<Hit, PartHit>)
      hits_[turn.ray] = turn.best;
    else
      hits_[turn.ray] = turn.best.found() ? 1 : 0;
  }

  /// Tests all leaves that wait: lanes of each, then places of corners, then the corners are
  /// fetched.
  void take_leaves() {
    Turn* now[turns];
    std::uint32_t lanes[turns];
    const MeshLeaf* leaf[turns];
    std::uint32_t left[turns], left_count = 0;
    const std::uint32_t count = leaf_count_;
    leaf_count_ = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      now[k] = leaves_[k];
      leaf[k] = view_.leaves + (now[k]->what & ~BvhNode::leaf);
      lanes[k] = lanes_that_may_be_met(*leaf[k], now[k]->leaf);
      left[left_count] = k;
      left_count += lanes[k] != 0 ? 1 : 0;
      const std::uint32_t first = leaf[k]->triangles[__builtin_ctz(lanes[k] | 128u)];
      __builtin_prefetch(view_.corners + 3 * std::size_t{first});
    }
    for (std::uint32_t i = 0; i < left_count; ++i) {
      const std::uint32_t k = left[i];
      fetch_corners(view_, leaf[k]->triangles[__builtin_ctz(lanes[k])]);
    }
    for (std::uint32_t i = 0; i < left_count; ++i)
      cast(*now[left[i]], *leaf[left[i]], lanes[left[i]]);
    for (std::uint32_t k = 0; k < count; ++k) file(now[k]);
  }

  void cast(Turn& turn, const MeshLeaf& leaf, std::uint32_t lanes) {
    const PartRay& ray = rays_[turn.ray];
    for (; lanes != 0; lanes &= lanes - 1) {
      ++counts_.triangles;
      const PartHit hit = cast_in_lanes(view_, leaf.triangles[__builtin_ctz(lanes)], turn.cast);
      if (!hit.found() || !(hit.t >= ray.t_min) || !(hit.t <= ray.ray.t_max) ||
          !takes_place(*view_.mesh, ray.ray, turn.best, hit))
        continue;
      turn.best = hit;
      if constexpr (!std::is_same_v<Hit, PartHit>) {
        turn.top = sentinels;  // nothing else matters
        return;
      }
      const float limit = turn.slabs.limit(hit.t + hit.error);
      if (limit < turn.slabs.numbers.t_max) turn.slabs.numbers.t_max = limit;
      turn.leaf.reach = (hit.t + hit.error) * turn.leaf.length;
    }
  }

  const MeshView& view_;
  const PartRay* rays_;
  Hit* hits_;
  PartCounts& counts_;
  std::uint32_t count_, next_ = 0, node_count_ = 0, leaf_count_ = 0;
  Turn* nodes_[turns + 1];
  Turn* leaves_[turns + 1];
  Turn all_[turns];
};

}  // namespace

void closest_parts_avx2(const MeshView& view, const PartRay* rays, std::size_t count, PartHit* hits,
                        PartCounts& counts) {
  Stream<PartHit>(view, rays, count, hits, counts).walk();
}

void meet_parts_avx2(const MeshView& view, const PartRay* rays, std::size_t count,
                     std::uint8_t* met, PartCounts& counts) {
  Stream<std::uint8_t>(view, rays, count, met, counts).walk();
}

}  // namespace minkray
#else
namespace minkray {

/// Never called on other machines.
void closest_parts_avx2(const MeshView&, const PartRay*, std::size_t, PartHit*, PartCounts&) {}
void meet_parts_avx2(const MeshView&, const PartRay*, std::size_t, std::uint8_t*, PartCounts&) {}

}  // namespace minkray
#endif
