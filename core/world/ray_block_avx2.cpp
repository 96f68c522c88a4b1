// SPDX-License-Identifier: MIT
// All functions have internal linkage or the lanes' type in their name (core/math/wide.h explains
// why).
#include "core/world/ray_block.h"

#include <cstring>

#include "core/query/tolerances.h"
#include "core/screen/form_in_lanes.h"
#include "core/world/block_of_rays.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

/// A block's rays in the frame of an instance's form. At parameter k the middle ray is at `near`.
/// Its direction is `d`; other rays have the direction d + map delta.
struct Seen {
  W map[3][3], near[3], d[3];
  W k, E, share;
  float wide;   ///< greatest length of map delta
  float steep;  ///< a slope that is far above rounding
  bool is_bounded;
};

void see(const Block& block, const InstancePlace& place, const ScreenForm& form, Seen& seen) {
  double outer[3], near[3];
  double along = 0, near_squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    outer[axis] = block.origin[axis] - place.origin[axis];
    along += outer[axis] * block.middle[axis];
  }
  const auto k = static_cast<float>(-along / block.middle_squared);
  float near_float[3], middle[3];
  for (int axis = 0; axis < 3; ++axis) {
    near[axis] = outer[axis] + static_cast<double>(k) * block.middle[axis];
    near_squared += near[axis] * near[axis];
    near_float[axis] = static_cast<float>(near[axis]);
    middle[axis] = static_cast<float>(block.middle[axis]);
  }
  float map_squared = 0, dd = 0;
  const float largest_scale = std::max(std::max(form.scale[0], form.scale[1]), form.scale[2]);
  for (int row = 0; row < 3; ++row) {
    const float* const m = place.to_inner + row;
    const float turn = row == 2 ? form.up : 1.0f;
    const float scale = form.scale[static_cast<std::size_t>(row)] * turn;
    map_squared += m[0] * m[0] + m[3] * m[3] + m[6] * m[6];
    const float d = scale * (m[0] * middle[0] + m[3] * middle[1] + m[6] * middle[2]);
    seen.near[row] =
        W(scale * ((m[0] * near_float[0] + m[3] * near_float[1] + m[6] * near_float[2]) +
                   form.offset[static_cast<std::size_t>(row)]));
    seen.d[row] = W(d);
    dd += d * d;
    for (int column = 0; column < 3; ++column) seen.map[row][column] = W(scale * m[3 * column]);
  }
  // Magnitude of all numbers that are summed, for the ray with the largest. Compare `look` in
  // core/screen/screen_kernel_avx2.cpp.
  const auto wide = static_cast<float>(block.widest);
  const float size = std::sqrt(map_squared) * largest_scale;
  const float reach_near = static_cast<float>(std::sqrt(near_squared)) + std::abs(k) * wide;
  const float least_d = std::sqrt(dd) * (1 - 0x1p-10f) - size * wide;
  const float most_d = static_cast<float>(std::sqrt(block.middle_squared)) + wide;
  const float step = (size * reach_near + form.extent + form.R) / least_d * most_d;
  const float reach = 1.7321f * size * (reach_near + step);
  const float E = tolerance::screen_rounding * (reach + form.extent);
  seen.k = W(k);
  seen.wide = size * wide * (1 + 0x1p-10f);
  seen.steep = 0x1p-10f * std::sqrt(dd);
  seen.E = W(E);
  const float share = E / form.R;
  seen.share = W(share * share * 0x1p-4f);
  seen.is_bounded =
      least_d > 0 && E < tolerance::screen_largest_share * std::min(form.least, form.R);
}

/// Planes of a polytope by how a block's rays cross them.
class PlanesByFacing {
 public:
  bool is_empty() const { return planes_ == nullptr; }

  /// Rays have directions within `wide` of d. Their slopes at sorted planes are at least `steep`.
  void sort(const ScreenPlanes& planes, const Vec3<W>& d, float wide, float steep) {
    planes_ = &planes;
    entered_count_ = left_count_ = other_count_ = 0;
    const W margin(wide + steep);
    for (std::size_t first = 0; first < planes.count; first += screen_lanes) {
      const float* const row = planes.row(first / screen_lanes);
      const auto number = [&](std::size_t k) { return W::load(row + k * screen_lanes); };
      const W slope = PlanesCrossed::product({number(0), number(1), number(2)}, d);
      const std::uint32_t used =
          lane_bits(first_lanes(std::min<std::size_t>(planes.count - first, screen_lanes)));
      const std::uint32_t entered = lane_bits(slope < -margin) & used,
                          left = lane_bits(slope > margin) & used;
      add(entered_, entered_count_, first, entered);
      add(left_, left_count_, first, left);
      add(others_, other_count_, first, used & ~(entered | left));
    }
  }

  exact::Entry<W> enter(const exact::Line<W>& line, const Mask<W>& open) const {
    PlanesCrossed crossed;
    const auto for_all = [&](const Numbers& numbers, std::size_t count, const auto& work) {
      for (std::size_t i = 0; i < count; ++i) with_plane(*planes_, numbers[i], work);
    };
    for_all(entered_, entered_count_, [&](const Vec3<W>& n, const W& offset, const W& below) {
      crossed.cross_alike<true>(n, offset, below, line.s, line.d, line.E);
    });
    for_all(left_, left_count_, [&](const Vec3<W>& n, const W& offset, const W& below) {
      crossed.cross_alike<false>(n, offset, below, line.s, line.d, line.E);
    });
    for_all(others_, other_count_, [&](const Vec3<W>& n, const W& offset, const W& below) {
      crossed.cross(n, offset, below, line.s, line.d, line.E);
    });
    return crossed.entry(open);
  }

 private:
  using Numbers = std::array<std::uint8_t, ScreenPlanes::most + 8>;  // adding writes eight
  static void add(Numbers& numbers, std::size_t& count, std::size_t first, std::uint32_t lanes) {
    const std::uint64_t eight = lanes_of_set.lanes[lanes] + 0x0101010101010101u * first;
    std::memcpy(numbers.data() + count, &eight, sizeof eight);
    count += static_cast<std::size_t>(__builtin_popcount(lanes));
  }

  const ScreenPlanes* planes_ = nullptr;
  Numbers entered_, left_, others_;
  std::size_t entered_count_ = 0, left_count_ = 0, other_count_ = 0;
};

/// Uses the sorted planes of a polytope, if there are some.
template <class F>
[[gnu::always_inline]] inline exact::Entry<W> enter_by(const PlanesByFacing& planes,
                                                       const FormInLanes& form,
                                                       const exact::Line<W>& line,
                                                       const Mask<W>& open) {
  if constexpr (F::lanes == exact::Lanes::planes)
    if (!planes.is_empty()) return planes.enter(line, open);
  return enter<F>(form, line, open);
}

/// Returns lower and upper bounds of t for eight rays at the form; `box` has the parameters at
/// which the rays enter the instance's box. Lanes that are not open miss. An infinite upper bound
/// means that the hit is not certain.
template <class F>
[[gnu::always_inline]] inline void look(const Seen& seen, const FormInLanes& form,
                                        const PlanesByFacing& planes, const Vec3<W>& delta,
                                        const W& box, const Mask<W>& used, W& first, W& last,
                                        Mask<W>& open) {
  const W &x = delta.x(), &y = delta.y(), &z = delta.z();
  Vec3<W> p, d;
  for (int row = 0; row < 3; ++row) {
    const W e = fma(seen.map[row][0], x, fma(seen.map[row][1], y, seen.map[row][2] * z));
    p[row] = fma(seen.k, e, seen.near[row]);
    d[row] = seen.d[row] + e;
  }
  exact::Line<W> line;
  line.d = d;
  line.dd = d.squaredNorm();
  line.inv = W(1) / line.dd;
  const W rest = -p.dot(d) * line.inv;
  for (int axis = 0; axis < 3; ++axis) line.s[axis] = fma(d[axis], rest, p[axis]);
  line.E = seen.E;
  line.parallel = seen.share * line.dd;
  const Mask<W> bounded = used & (line.dd > W(tolerance::screen_shortest_squared)) &
                          (line.dd < W(tolerance::screen_longest_squared));
  const exact::Entry<W> entry = enter_by<F>(planes, form, line, bounded);
  const auto slack_of = [&](const exact::Entry<W>& of) {
    return W(2) * of.e + W(tolerance::screen_digits) * (abs(seen.k) + abs(rest) + abs(of.t));
  };
  const W t = seen.k + (rest + entry.t), slack = slack_of(entry), lo = t - slack, hi = t + slack;
  const Mask<W> sure = entry.hit & (lo >= W(0)), behind = entry.hit & (hi < W(0));
  Mask<W> miss = entry.miss & bounded;
  if (any(behind)) {
    const exact::Entry<W> exit = enter_again<F>(form, line.reversed(), behind);
    miss |= exit.hit & (seen.k + (rest - exit.t) + slack_of(exit) < W(0));
  }
  open = used & !miss;
  first = select(sure, lo, box);
  last = select(sure, hi, W(infinity));
}

/// Size of arrays: a store may write up to eight items after the last.
constexpr int room = all_rays + 8;

/// Rays of a block that hit the box of one instance, in contiguous arrays.
struct MeetingRays {
  std::uint32_t count = 0;
  alignas(32) float boxes[room], limits[room], los[room], deltas[3][room];
  alignas(32) std::uint32_t rays[room];
};

/// Tests the rays against a child's box, each with its own limit.
void gather_meeting(const Block& block, const BvhNode& node, int child, const BlockAnswer& answer,
                    MeetingRays& meeting) {
  __m256 lower[3], upper[3];
  for (int axis = 0; axis < 3; ++axis) {
    lower[axis] = _mm256_set1_ps(node.planes[0][axis][child] - block.above[axis]);
    upper[axis] = _mm256_set1_ps(node.planes[1][axis][child] - block.below[axis]);
  }
  alignas(32) float enters[all_rays];
  std::uint32_t met_by[all_rays / 8], rows = 0;
#pragma GCC unroll 8
  for (int from = 0; from < all_rays; from += 8) {
    __m256 enter = _mm256_setzero_ps(), leave = _mm256_load_ps(answer.limit + from);
    for (int axis = 0; axis < 3; ++axis) {
      const __m256 inverse = _mm256_load_ps(block.inverse[axis] + from);
      const __m256 a = _mm256_mul_ps(lower[axis], inverse), b = _mm256_mul_ps(upper[axis], inverse);
      enter = _mm256_max_ps(enter, _mm256_min_ps(a, b));
      leave = _mm256_min_ps(leave, _mm256_max_ps(a, b));
    }
    const __m256 padded = _mm256_add_ps(_mm256_mul_ps(leave, _mm256_set1_ps(block_padding)),
                                        _mm256_set1_ps(std::numeric_limits<float>::min()));
    _mm256_store_ps(enters + from, _mm256_mul_ps(enter, _mm256_set1_ps(1 - 0x1p-20f)));
    const auto here =
        static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(enter, padded, _CMP_LE_OQ)));
    met_by[from / 8] = here;
    rows |= (here != 0 ? 1u : 0u) << (from / 8);
  }
  std::uint32_t count = 0;
  for (; rows != 0; rows &= rows - 1) {
    const int row = __builtin_ctz(rows), from = 8 * row;
    const std::uint32_t here = met_by[row];
    const __m256i lanes = lanes_of(here);
    const auto gather = [&](float* to, const float* all) {
      _mm256_storeu_ps(to + count, _mm256_permutevar8x32_ps(_mm256_load_ps(all + from), lanes));
    };
    gather(meeting.boxes, enters);
    gather(meeting.limits, answer.limit);
    gather(meeting.los, answer.lo);
    for (int axis = 0; axis < 3; ++axis) gather(meeting.deltas[axis], block.delta[axis]);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(meeting.rays + count),
                        _mm256_add_epi32(lanes, _mm256_set1_epi32(from)));
    count += static_cast<std::uint32_t>(__builtin_popcount(here));
  }
  meeting.count = count;
}

/// Adds a pair of a ray and an instance. Returns false if there is no room for another.
bool add_other(BlockAnswer& answer, float first, std::uint32_t ray, std::uint32_t instance) {
  if (answer.other_count == BlockAnswer::most_others) return false;
  answer.others[answer.other_count++] = {first, ray, instance};
  return true;
}

enum class Looked { nothing_nearer, nearer, too_much };

template <class F>
Looked look_at_instance(const Seen& seen, const Screen& screen, const MeetingRays& meeting,
                        std::uint32_t instance, BlockAnswer& answer) {
  const FormInLanes form(screen);
  PlanesByFacing planes;
  if constexpr (F::lanes == exact::Lanes::planes) {
    constexpr std::uint32_t least_rays = 12;  // fewer rays do not repay the sorting
    if (meeting.count >= least_rays)
      planes.sort(*screen.planes, {seen.d[0], seen.d[1], seen.d[2]}, seen.wide, seen.steep);
  }
  bool nearer = false;
  for (std::uint32_t at = 0; at < meeting.count; at += 8) {
    W first, last;
    Mask<W> open;
    const Vec3<W> delta(W::load(meeting.deltas[0] + at), W::load(meeting.deltas[1] + at),
                        W::load(meeting.deltas[2] + at));
    const Mask<W> used = first_lanes(std::min<std::size_t>(meeting.count - at, screen_lanes));
    look<F>(seen, form, planes, delta, W::load(meeting.boxes + at), used, first, last, open);
    const W limit = W::load(meeting.limits + at), lo = W::load(meeting.los + at);
    open &= first <= limit;
    const std::uint32_t open_bits = lane_bits(open);
    if (open_bits == 0) continue;
    Mask<W> sure = open & (last <= limit) & (last < W(infinity));
    if (!screen.is_whole) sure = Mask<W>(false);
    const std::uint32_t replaces = lane_bits(sure & (last < lo));
    alignas(32) float firsts[8], lasts[8];
    first.store(firsts);
    select(sure, last, limit).store(lasts);
    nearer = true;
    for (std::uint32_t left = replaces; left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      const std::uint32_t ray = meeting.rays[at + static_cast<std::uint32_t>(lane)];
      answer.limit[ray] = lasts[lane];
      answer.lo[ray] = firsts[lane];
      answer.instance[ray] = instance;
    }
    for (std::uint32_t left = open_bits & ~replaces; left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      const std::uint32_t ray = meeting.rays[at + static_cast<std::uint32_t>(lane)];
      answer.limit[ray] = lasts[lane];
      if (!add_other(answer, firsts[lane], ray, instance)) return Looked::too_much;
    }
  }
  return nearer ? Looked::nearer : Looked::nothing_nearer;
}

/// Returns false if too many pairs are undecided.
bool walk_block(const BlockWorld& world, const Block& block, RayKinds kinds, BlockAnswer& answer) {
  struct alignas(16) Waiting {
    float enter;
    int child;
    std::uint32_t node, what;  ///< `what` is a node, or an instance with the bit of leaves
  };
  Waiting stack[bvh_max_depth * (bvh_width - 1) + 1];
  int top = 0;
  const BvhNode* const nodes = world.nodes;
  const auto greatest_limit = [&] {
    __m256 all = _mm256_load_ps(answer.limit);
    for (int i = 8; i < all_rays; i += 8)
      all = _mm256_max_ps(all, _mm256_load_ps(answer.limit + i));
    return greatest_of(all);
  };
  float t_max = greatest_limit();
  MeetingRays meeting = {};  // lanes beyond the last are read
  Seen seen;
  std::uint32_t node = 0;
  for (;;) {
    ++answer.nodes;
    alignas(32) float enters[bvh_width];
    std::uint32_t met = boxes_met(nodes[node], block, t_max, enters);
    for (const int bottom = top; met != 0; met &= met - 1) {
      const int child = __builtin_ctz(met);
      const std::uint32_t what = nodes[node].children[child];
      if (what == BvhNode::none) break;
      if (what & BvhNode::leaf) {
        __builtin_prefetch(world.places + (what & ~BvhNode::leaf));
      } else {
        const char* const ahead = reinterpret_cast<const char*>(nodes + what);
        for (int line = 0; line < 4; ++line) __builtin_prefetch(ahead + 64 * line);
      }
      int at = top++;
      for (; at > bottom && stack[at - 1].enter < enters[child]; --at) stack[at] = stack[at - 1];
      stack[at] = {enters[child], child, node, what};
    }
    for (;;) {
      if (top == 0) return true;
      const Waiting next = stack[--top];
      if (!(next.enter <= t_max)) continue;
      if (!(next.what & BvhNode::leaf)) {
        node = next.what;
        break;
      }
      const std::uint32_t instance = next.what & ~BvhNode::leaf;
      if (world.shown_to && (world.shown_to[instance] & kinds) == 0) continue;
      gather_meeting(block, nodes[next.node], next.child, answer, meeting);
      if (meeting.count == 0) continue;
      const InstancePlace& place = world.places[instance];
      const Screen& screen = world.screens[place.body];
      seen.is_bounded = false;
      if (screen.kind != FormKind::none) see(block, place, screen.form, seen);
      if (!seen.is_bounded) {
        for (std::uint32_t i = 0; i < meeting.count; ++i)
          if (!add_other(answer, meeting.boxes[i], meeting.rays[i], instance)) return false;
        continue;
      }
      Looked looked = Looked::nothing_nearer;
      for_kind(screen.kind, [&]<class F>() {
        looked = look_at_instance<F>(seen, screen, meeting, instance, answer);
        return ScreenBits{0, 0};
      });
      if (looked == Looked::too_much) return false;
      if (looked == Looked::nearer) t_max = greatest_limit();
    }
  }
}

}  // namespace

bool trace_block_avx2(const BlockWorld& world, const char* rays, std::size_t stride,
                      std::size_t count, RayKinds kinds, const float* limits, BlockAnswer& answer) {
  Block block;
  if (!make_block(rays, stride, count, block, answer.limit)) return false;
  for (std::size_t i = 0; i < rays_of_block; i += 8) {
    _mm256_store_ps(answer.lo + i, _mm256_set1_ps(infinity));
    _mm256_store_si256(reinterpret_cast<__m256i*>(answer.instance + i), _mm256_set1_epi32(-1));
  }
  for (std::size_t i = 0; limits && i < count; ++i)
    answer.limit[i] = std::min(answer.limit[i], limits[i]);
  answer.other_count = 0;
  answer.nodes = 0;
  return walk_block(world, block, kinds, answer);
}

}  // namespace minkray
#else
namespace minkray {
/// Never called on machines without AVX2.
bool trace_block_avx2(const BlockWorld&, const char*, std::size_t, std::size_t, RayKinds,
                      const float*, BlockAnswer&) {
  return false;
}
}  // namespace minkray
#endif
