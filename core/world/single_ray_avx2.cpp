// SPDX-License-Identifier: MIT
// All functions have internal linkage or the lanes' type in their name (core/math/wide.h explains
// why).
#include "core/world/single_ray.h"

#include "core/bvh/slab_test.h"
#include "core/math/wide.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

using Lanes = Wide<float, 8, IsaAvx2>;

/// Collects instances whose boxes the ray hits until they fill the lanes, or until no node is
/// nearer.
class Pending {
 public:
  Pending(const SingleWorld& world, SingleRay& ray)
      : world_(world),
        ray_(ray),
        list_{reinterpret_cast<const char*>(ray.ray), 0, world.places, world.screens, &ray.limit} {}

  bool is_nearer_than(float enter) const { return count_ != 0 && nearest_ <= enter; }
  bool is_full() const { return count_ + bvh_width > room; }

  void add(std::uint32_t instance, float enter) {
    if (instance == ray_.skip || (world_.shown_to && (world_.shown_to[instance] & ray_.kinds) == 0))
      return;
    nearest_ = count_ == 0 ? enter : std::min(nearest_, enter);
    enter_[count_] = enter;
    instance_[count_++] = instance;
    __builtin_prefetch(world_.places + instance);
  }

  /// Screens all candidates. Returns false if there are too many.
  bool look() {
    while (count_ != 0) {
      const FormKind kind = kind_of(count_ - 1);
      std::uint32_t same[screen_lanes];
      float enters[screen_lanes];
      std::size_t lanes = 0, left = 0;
      for (std::size_t i = count_; i-- > 0;) {
        if (lanes == screen_lanes || kind_of(i) != kind) continue;
        same[lanes] = instance_[i];
        enters[lanes++] = enter_[i];
        instance_[i] = no_instance;
      }
      for (std::size_t i = 0; i < count_; ++i)
        if (instance_[i] != no_instance) {
          instance_[left] = instance_[i];
          enter_[left++] = enter_[i];
        }
      count_ = left;
      if (!look_at(kind, same, enters, lanes)) return false;
    }
    return true;
  }

 private:
  static constexpr std::size_t room = 2 * bvh_width;

  FormKind kind_of(std::size_t i) const {
    return world_.screens[world_.places[instance_[i]].body].kind;
  }

  /// Lower bound of t inside a box that the ray enters at the parameter `entered`: the inverse of
  /// SlabRay::limit.
  float least_t(float entered) const {
    const double from = static_cast<double>(entered) - static_cast<double>(slab_tiny);
    return static_cast<float>(from / (ray_.slabs.steps * static_cast<double>(hit_padding)));
  }

  bool add_candidate(std::uint32_t instance, float first) {
    if (ray_.candidate_count == SingleRay::most_candidates) {
      // Drops candidates beyond the limit.
      std::size_t kept = 0;
      for (const SingleRay::Candidate& one : ray_.candidates)
        if (one.first <= ray_.limit) ray_.candidates[kept++] = one;
      ray_.candidate_count = kept;
      if (kept == SingleRay::most_candidates) return false;
    }
    ray_.candidates[ray_.candidate_count++] = {instance, first};
    if (world_.digits) __builtin_prefetch(world_.digits + instance);
    return true;
  }

  bool look_at(FormKind kind, std::uint32_t (&same)[screen_lanes],
               const float (&enters)[screen_lanes], std::size_t lanes) {
    if (kind == FormKind::none) {
      for (std::size_t i = 0; i < lanes; ++i)
        if (!add_candidate(same[i], least_t(enters[i]))) return false;
      return true;
    }
    for (std::size_t i = lanes; i < screen_lanes; ++i) same[i] = same[0];
    static constexpr std::uint32_t this_ray[screen_lanes] = {};
    Screened answers;
    const ScreenBits bits = screen_avx2(kind, list_, this_ray, same, lanes, answers);
    for (std::uint32_t open = bits.open & ((1u << lanes) - 1u); open != 0; open &= open - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(open));
      if (!add_candidate(same[lane], answers.first[lane])) return false;
      if (!(bits.sure >> lane & 1u) || !(answers.last[lane] < ray_.limit) ||
          !world_.screens[world_.places[same[lane]].body].is_whole)
        continue;
      ray_.is_sure = true;
      ray_.limit = answers.last[lane];
      ray_.slabs.numbers.t_max = ray_.slabs.limit(static_cast<double>(ray_.limit));
    }
    return true;
  }

  const SingleWorld& world_;
  SingleRay& ray_;
  ScreenList list_;
  std::size_t count_ = 0;
  float nearest_ = 0;
  std::uint32_t instance_[room];
  float enter_[room];
};

}  // namespace

bool trace_single_avx2(const SingleWorld& world, SingleRay& ray) {
  struct Waiting {
    float enter;
    std::uint32_t node;
  };
  Waiting stack[bvh_max_depth * (bvh_width - 1) + 1];
  int top = 0;
  const SlabNumbers& numbers = ray.slabs.numbers;
  Pending pending(world, ray);
  std::uint32_t node = 0;
  for (;;) {
    ++ray.nodes;
    float enters[bvh_width];
    const BvhNode& here = world.nodes[node];
    std::uint32_t met = boxes_met<Lanes>(here, numbers, numbers.t_max, enters);
    for (const int bottom = top; met != 0; met &= met - 1) {
      const int child = __builtin_ctz(met);
      const std::uint32_t what = here.children[child];
      if (what == BvhNode::none) break;  // for origins outside the range of float
      if (what & BvhNode::leaf) {
        pending.add(what & ~BvhNode::leaf, enters[child]);
        continue;
      }
      const char* const ahead = reinterpret_cast<const char*>(world.nodes + what);
      for (int line = 0; line < 4; ++line) __builtin_prefetch(ahead + 64 * line);
      int at = top++;
      for (; at > bottom && stack[at - 1].enter < enters[child]; --at) stack[at] = stack[at - 1];
      stack[at] = {enters[child], what};
    }
    for (;;) {
      const float next = top == 0 ? std::numeric_limits<float>::infinity() : stack[top - 1].enter;
      if (pending.is_full() || pending.is_nearer_than(next)) {
        if (!pending.look()) return false;
        if (ray.ends_if_sure && ray.is_sure) return true;
      }
      if (top == 0) return pending.look();
      --top;
      if (stack[top].enter <= numbers.t_max) break;
    }
    node = stack[top].node;
  }
}

}  // namespace minkray
#else
namespace minkray {
/// Never called on machines without AVX2.
bool trace_single_avx2(const SingleWorld&, SingleRay&) {
  return false;
}
}  // namespace minkray
#endif
