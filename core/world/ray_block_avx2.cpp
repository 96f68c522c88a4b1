// SPDX-License-Identifier: MIT
// Everything here has internal linkage or the type of the lanes in its name: see core/math/wide.h.
#include "core/world/ray_block.h"

#include "core/cast/form_in_lanes.h"
#include "core/query/tolerances.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

using W = Wide<float, 8, IsaAvx2>;
constexpr int all_rays = static_cast<int>(rays_of_block);
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Directions further apart than this, in units of the first one's largest component, gain nothing
/// together.
constexpr double widest = 0.25;

/// Each comparison of two planes' parameters is of numbers rounded five times: 16 roundings' room.
constexpr float block_padding = 1 + 8 * std::numeric_limits<float>::epsilon();

struct alignas(32) Block {
  /// Of each ray: its direction less the middle's, and 1 / direction, which is never infinite.
  float delta[3][all_rays], inverse[3][all_rays];
  double origin[4], middle[4];
  double middle_squared;
  double widest;  ///< the greatest length of delta
  /// The origin from both sides, and of all inverses the bounds; see `Bounds`.
  float above[3], below[3];
  float inverse_near[3], inverse_far[3];
  float least_up[3], least_down[3];
  bool down[3], mixed[3];
};

__m256d load(const double* from) { return _mm256_loadu_pd(from); }

/// Rows to columns.
[[gnu::always_inline]] inline void transpose(const __m256d (&row)[4], __m256d (&column)[4]) {
  const __m256d a = _mm256_unpacklo_pd(row[0], row[1]), b = _mm256_unpackhi_pd(row[0], row[1]);
  const __m256d c = _mm256_unpacklo_pd(row[2], row[3]), d = _mm256_unpackhi_pd(row[2], row[3]);
  column[0] = _mm256_permute2f128_pd(a, c, 0x20);
  column[1] = _mm256_permute2f128_pd(b, d, 0x20);
  column[2] = _mm256_permute2f128_pd(a, c, 0x31);
  column[3] = _mm256_permute2f128_pd(b, d, 0x31);
}

float least_of(__m256 v) {
  __m128 x = _mm_min_ps(_mm256_castps256_ps128(v), _mm256_extractf128_ps(v, 1));
  x = _mm_min_ps(x, _mm_movehl_ps(x, x));
  return _mm_cvtss_f32(_mm_min_ss(x, _mm_shuffle_ps(x, x, 1)));
}
float greatest_of(__m256 v) {
  __m128 x = _mm_max_ps(_mm256_castps256_ps128(v), _mm256_extractf128_ps(v, 1));
  x = _mm_max_ps(x, _mm_movehl_ps(x, x));
  return _mm_cvtss_f32(_mm_max_ss(x, _mm_shuffle_ps(x, x, 1)));
}

float above(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafterf(f, infinity) : f;
}
float below(double x) { return -above(-x); }

bool make_block(const char* rays, std::size_t stride, std::size_t count, Block& block,
                float* limits) {
  const auto ray = [&](std::size_t i) {
    return reinterpret_cast<const double*>(rays + stride * i);
  };
  const double *const first = ray(0), *const last = ray(count - 1);
  for (int axis = 0; axis < 3; ++axis) {
    block.origin[axis] = first[axis];
    if (first[axis] != last[axis]) return false;
    block.middle[axis] = 0.5 * (first[3 + axis] + last[3 + axis]);
  }
  block.origin[3] = block.middle[3] = 0;
  const double* const m = block.middle;
  const double size = std::max(std::max(std::abs(m[0]), std::abs(m[1])), std::abs(m[2]));
  if (!(size > 0x1p-20 && size < 0x1p20)) return false;
  block.middle_squared = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];

  const __m256d origin[3] = {_mm256_set1_pd(first[0]), _mm256_set1_pd(first[1]),
                             _mm256_set1_pd(first[2])};
  const __m256d middle[3] = {_mm256_set1_pd(m[0]), _mm256_set1_pd(m[1]), _mm256_set1_pd(m[2])};
  __m256d differ = _mm256_setzero_pd();
  __m256 wide = _mm256_setzero_ps();
  __m256 least[3], most[3];
  for (int axis = 0; axis < 3; ++axis) {
    least[axis] = _mm256_set1_ps(infinity);
    most[axis] = _mm256_set1_ps(-infinity);
  }
  const __m256 sign = _mm256_set1_ps(-0.0f);
  const __m256 tiny = _mm256_set1_ps(static_cast<float>(size * 0x1p-60));
  for (std::size_t from = 0; from < rays_of_block; from += 8) {
    __m128 direction[3][2], delta[3][2], limit[2];
    for (std::size_t half = 0; half < 2; ++half) {
      __m256d row[4], column[4];
      const double* at[4];
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t k = from + 4 * half + i;
        at[i] = ray(k < count ? k : 0);
        row[i] = load(at[i]);
      }
      transpose(row, column);
      for (int axis = 0; axis < 3; ++axis)
        differ = _mm256_or_pd(differ, _mm256_cmp_pd(column[axis], origin[axis], _CMP_NEQ_UQ));
      for (std::size_t i = 0; i < 4; ++i) row[i] = load(at[i] + 3);
      transpose(row, column);
      for (int axis = 0; axis < 3; ++axis) {
        direction[axis][half] = _mm256_cvtpd_ps(column[axis]);
        delta[axis][half] = _mm256_cvtpd_ps(_mm256_sub_pd(column[axis], middle[axis]));
      }
      limit[half] = _mm256_cvtpd_ps(column[3]);
    }
    __m256 squared = _mm256_setzero_ps();
    for (int axis = 0; axis < 3; ++axis) {
      const __m256 d = _mm256_set_m128(direction[axis][1], direction[axis][0]);
      const __m256 e = _mm256_set_m128(delta[axis][1], delta[axis][0]);
      const __m256 safe = _mm256_or_ps(_mm256_max_ps(_mm256_andnot_ps(sign, d), tiny),
                                       _mm256_and_ps(sign, d));
      const __m256 inverse = _mm256_div_ps(_mm256_set1_ps(1), safe);
      _mm256_store_ps(block.delta[axis] + from, e);
      _mm256_store_ps(block.inverse[axis] + from, inverse);
      squared = _mm256_fmadd_ps(e, e, squared);
      least[axis] = _mm256_min_ps(least[axis], inverse);
      most[axis] = _mm256_max_ps(most[axis], inverse);
    }
    wide = _mm256_max_ps(wide, squared);
    _mm256_store_ps(limits + from, _mm256_mul_ps(_mm256_set_m128(limit[1], limit[0]),
                                                 _mm256_set1_ps(1 + 0x1p-22f)));
  }
  if (_mm256_movemask_pd(differ) != 0) return false;
  for (std::size_t i = count; i < rays_of_block; ++i) limits[i] = -1;
  block.widest = std::sqrt(static_cast<double>(greatest_of(wide))) * (1 + 0x1p-20);
  if (!(block.widest < widest * size)) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const float low = least_of(least[axis]), high = greatest_of(most[axis]);
    block.above[axis] = above(first[axis]);
    block.below[axis] = below(first[axis]);
    block.mixed[axis] = low < 0 && high > 0;
    block.down[axis] = low < 0;
    // Near planes by the steepest, far ones by the flattest.
    block.inverse_near[axis] = low < 0 ? high : low;
    block.inverse_far[axis] = low < 0 ? low : high;
    if (!block.mixed[axis]) continue;
    block.least_up[axis] = infinity;
    block.least_down[axis] = -infinity;
    for (const float inverse : block.inverse[axis]) {
      if (inverse > 0) block.least_up[axis] = std::min(block.least_up[axis], inverse);
      if (inverse < 0) block.least_down[axis] = std::max(block.least_down[axis], inverse);
    }
  }
  return true;
}

/// Which of a node's boxes any of the rays may meet up to t_max, and where.
[[gnu::always_inline]] inline std::uint32_t boxes_met(const BvhNode& node, const Block& block,
                                                      float t_max, float* enters) {
  __m256 enter = _mm256_setzero_ps(), leave = _mm256_set1_ps(t_max);
  for (int axis = 0; axis < 3; ++axis) {
    const __m256 lower = _mm256_sub_ps(_mm256_load_ps(node.planes[0][axis]),
                                       _mm256_set1_ps(block.above[axis]));
    const __m256 upper = _mm256_sub_ps(_mm256_load_ps(node.planes[1][axis]),
                                       _mm256_set1_ps(block.below[axis]));
    if (block.mixed[axis]) {
      enter = _mm256_max_ps(_mm256_mul_ps(lower, _mm256_set1_ps(block.least_up[axis])), enter);
      enter = _mm256_max_ps(_mm256_mul_ps(upper, _mm256_set1_ps(block.least_down[axis])), enter);
      continue;
    }
    const __m256 near = block.down[axis] ? upper : lower, far = block.down[axis] ? lower : upper;
    enter = _mm256_max_ps(_mm256_mul_ps(near, _mm256_set1_ps(block.inverse_near[axis])), enter);
    leave = _mm256_min_ps(_mm256_mul_ps(far, _mm256_set1_ps(block.inverse_far[axis])), leave);
  }
  _mm256_store_ps(enters, enter);
  const __m256 padded = _mm256_add_ps(_mm256_mul_ps(leave, _mm256_set1_ps(block_padding)),
                                      _mm256_set1_ps(std::numeric_limits<float>::min()));
  return static_cast<std::uint32_t>(
      _mm256_movemask_ps(_mm256_cmp_ps(enter, padded, _CMP_LE_OQ)));
}

/// An instance as all rays of a block see it: at parameter k the middle one is at `near`, in the
/// form's frame, and runs along `d`; others run along d + map delta.
struct Seen {
  W map[3][3], near[3], d[3];
  W k, E, share;
  bool is_bounded;
};

void see(const Block& block, const LeafPlace<double>& place, const ScreenForm& form, Seen& seen) {
  double outer[3], near[3];
  double along = 0, near_squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    outer[axis] = block.origin[axis] - place.centre[axis];
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
    const float m[7] = {static_cast<float>(place.to_inner[row]), 0, 0,
                        static_cast<float>(place.to_inner[row + 3]), 0, 0,
                        static_cast<float>(place.to_inner[row + 6])};
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
  // How large all is that was added up: see `look` of core/cast/screen_kernel_avx2.cpp, at the worst
  // of the rays.
  const auto wide = static_cast<float>(block.widest);
  const float size = std::sqrt(map_squared) * largest_scale;
  const float reach_near = static_cast<float>(std::sqrt(near_squared)) + std::abs(k) * wide;
  const float least_d = std::sqrt(dd) * (1 - 0x1p-10f) - size * wide;
  const float most_d = static_cast<float>(std::sqrt(block.middle_squared)) + wide;
  const float step = (size * reach_near + form.extent + form.R) / least_d * most_d;
  const float reach = 1.7321f * size * (reach_near + step);
  const float E = tolerance::screen_rounding * (reach + form.extent);
  seen.k = W(k);
  seen.E = W(E);
  const float share = E / form.R;
  seen.share = W(share * share * 0x1p-4f);
  seen.is_bounded =
      least_d > 0 && E < tolerance::screen_largest_share * std::min(form.least, form.R);
}

/// Eight rays: where they meet the form at the earliest and at the latest; `box` is where they enter
/// its box. Not open: they miss. Latest infinite: not sure.
template <FormKind kind>
[[gnu::always_inline]] inline void look(const Seen& seen, const FormInLanes& form,
                                        const Vec3<W>& delta, const W& box, W& first, W& last,
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
  const Mask<W> bounded = (line.dd > W(tolerance::screen_shortest_squared)) &
                          (line.dd < W(tolerance::screen_longest_squared));
  const exact::Entry<W> entry = enter<kind>(form, line, bounded);
  const auto slack_of = [&](const exact::Entry<W>& of) {
    return W(2) * of.e + W(tolerance::screen_digits) * (abs(seen.k) + abs(rest) + abs(of.t));
  };
  const W t = seen.k + (rest + entry.t), slack = slack_of(entry), lo = t - slack, hi = t + slack;
  const Mask<W> sure = entry.hit & (lo >= W(0)), behind = entry.hit & (hi < W(0));
  Mask<W> miss = entry.miss & bounded;
  if (any(behind)) {
    const exact::Entry<W> exit = enter_again<kind>(form, line.reversed(), behind);
    miss |= exit.hit & (seen.k + (rest - exit.t) + slack_of(exit) < W(0));
  }
  open = !miss;
  first = select(sure, lo, box);
  last = select(sure, hi, W(infinity));
}

/// For each set of lanes, their numbers from the lowest up.
struct LanesOfSet {
  std::uint64_t lanes[256] = {};
  constexpr LanesOfSet() {
    for (std::uint32_t set = 0; set < 256; ++set)
      for (std::uint32_t lane = 0, count = 0; lane < 8; ++lane)
        if (set >> lane & 1) lanes[set] |= static_cast<std::uint64_t>(lane) << (8 * count++);
  }
};
constexpr LanesOfSet lanes_of_set;

__m256i lanes_of(std::uint32_t set) {
  return _mm256_cvtepu8_epi32(
      _mm_cvtsi64_si128(static_cast<std::int64_t>(lanes_of_set.lanes[set])));
}

/// Eight more are written behind the last.
constexpr int room = all_rays + 8;

template <FormKind kind>
void look_at_block(const BlockWorld& world, const Block& block, BlockAnswer& answer) {
  struct alignas(16) Waiting {
    float enter;
    int child;
    std::uint32_t node, what;  ///< what: a node, or the bit of leaves and a place
  };
  Waiting stack[bvh_max_depth * (bvh_width - 1) + 1];
  int top = 0;
  const BvhNode* const nodes = world.nodes;
  const auto greatest_limit = [&] {
    __m256 all = _mm256_load_ps(answer.limit);
    for (int i = 8; i < all_rays; i += 8) all = _mm256_max_ps(all, _mm256_load_ps(answer.limit + i));
    return greatest_of(all);
  };
  float t_max = greatest_limit();
  std::uint32_t node = 0;
  for (;;) {
    ++answer.nodes;
    alignas(32) float enters[bvh_width];
    std::uint32_t met = boxes_met(nodes[node], block, t_max, enters);
    const __m256i children =
        _mm256_load_si256(reinterpret_cast<const __m256i*>(nodes[node].children));
    const auto leaves =
        static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(children)));
    const std::uint32_t first_leaf = world.first_leaves[node];
    for (const int bottom = top; met != 0; met &= met - 1) {
      const int child = __builtin_ctz(met);
      std::uint32_t what = nodes[node].children[child];
      if (what == BvhNode::none) break;
      if (what & BvhNode::leaf) {
        const std::uint32_t place =
            first_leaf +
            static_cast<std::uint32_t>(__builtin_popcount(leaves & ((1u << child) - 1u)));
        const char* const ahead = reinterpret_cast<const char*>(world.places + place);
        __builtin_prefetch(ahead);
        __builtin_prefetch(ahead + sizeof(LeafPlace<double>) - 1);
        what = BvhNode::leaf | place;
      } else {
        const char* const ahead = reinterpret_cast<const char*>(nodes + what);
        for (int line = 0; line < 4; ++line) __builtin_prefetch(ahead + 64 * line);
      }
      int at = top++;
      for (; at > bottom && stack[at - 1].enter < enters[child]; --at) stack[at] = stack[at - 1];
      stack[at] = {enters[child], child, node, what};
    }
    for (;;) {
      if (top == 0) return;
      const Waiting& next = stack[--top];
      if (!(next.enter <= t_max)) continue;
      const BvhNode& parent = nodes[next.node];
      const std::uint32_t what = next.what;
      if (!(what & BvhNode::leaf)) {
        node = what;
        break;
      }
      // Which rays meet the box, eight by eight.
      const std::uint32_t leaf = what & ~BvhNode::leaf;
      __m256 lower[3], upper[3];
      for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = _mm256_set1_ps(parent.planes[0][axis][next.child] - block.above[axis]);
        upper[axis] = _mm256_set1_ps(parent.planes[1][axis][next.child] - block.below[axis]);
      }
      // They are gathered, so that lanes are full.
      alignas(32) float boxes[room], limits[room], los[room], deltas[3][room];
      alignas(32) std::uint32_t rays[room];
      alignas(32) float enters_of[all_rays];
      std::uint32_t met_by[all_rays / 8], rows = 0;
#pragma GCC unroll 8
      for (int from = 0; from < all_rays; from += 8) {
        __m256 enter = _mm256_setzero_ps(), leave = _mm256_load_ps(answer.limit + from);
        for (int axis = 0; axis < 3; ++axis) {
          const __m256 inverse = _mm256_load_ps(block.inverse[axis] + from);
          const __m256 a = _mm256_mul_ps(lower[axis], inverse),
                       b = _mm256_mul_ps(upper[axis], inverse);
          enter = _mm256_max_ps(enter, _mm256_min_ps(a, b));
          leave = _mm256_min_ps(leave, _mm256_max_ps(a, b));
        }
        const __m256 padded = _mm256_add_ps(_mm256_mul_ps(leave, _mm256_set1_ps(block_padding)),
                                            _mm256_set1_ps(std::numeric_limits<float>::min()));
        _mm256_store_ps(enters_of + from, _mm256_mul_ps(enter, _mm256_set1_ps(1 - 0x1p-20f)));
        const auto here = static_cast<std::uint32_t>(
            _mm256_movemask_ps(_mm256_cmp_ps(enter, padded, _CMP_LE_OQ)));
        met_by[from / 8] = here;
        rows |= (here != 0 ? 1u : 0u) << (from / 8);
      }
      std::uint32_t meeting = 0;
      for (; rows != 0; rows &= rows - 1) {
        const int row = __builtin_ctz(rows), from = 8 * row;
        const std::uint32_t here = met_by[row];
        const __m256i lanes = lanes_of(here);
        const auto gather = [&](float* to, const float* all) {
          _mm256_storeu_ps(to + meeting,
                           _mm256_permutevar8x32_ps(_mm256_load_ps(all + from), lanes));
        };
        gather(boxes, enters_of);
        gather(limits, answer.limit);
        gather(los, answer.lo);
        for (int axis = 0; axis < 3; ++axis) gather(deltas[axis], block.delta[axis]);
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(rays + meeting),
                            _mm256_add_epi32(lanes, _mm256_set1_epi32(from)));
        meeting += static_cast<std::uint32_t>(__builtin_popcount(here));
      }
      if (meeting == 0) continue;
      const LeafPlace<double>& place = world.places[leaf];
      const Screen& screen = world.screens[place.definition];
      const FormInLanes form(screen);
      Seen seen;
      see(block, place, screen.alike_form, seen);
      if (!seen.is_bounded) {
        for (std::uint32_t i = 0; i < meeting; ++i) {
          if (answer.other_count == BlockAnswer::most_others) return;
          answer.others[answer.other_count++] = {boxes[i], rays[i], leaf};
        }
        continue;
      }
      bool nearer = false;
      for (std::uint32_t at = 0; at < meeting; at += 8) {
        W first, last;
        Mask<W> open;
        const Vec3<W> delta(W::load(deltas[0] + at), W::load(deltas[1] + at),
                            W::load(deltas[2] + at));
        look<kind>(seen, form, delta, W::load(boxes + at), first, last, open);
        const W limit = W::load(limits + at), lo = W::load(los + at);
        open &= first <= limit;
        const std::uint32_t used = meeting - at < 8 ? (1u << (meeting - at)) - 1u : 0xffu;
        const std::uint32_t open_bits = lane_bits(open) & used;
        if (open_bits == 0) continue;
        const Mask<W> sure = open & (last <= limit) & (last < W(infinity));
        const std::uint32_t replaces = lane_bits(sure & (last < lo)) & used;
        alignas(32) float firsts[8], lasts[8];
        first.store(firsts);
        select(sure, last, limit).store(lasts);
        nearer = true;
        for (std::uint32_t left = replaces; left != 0; left &= left - 1) {
          const int lane = __builtin_ctz(left);
          const std::uint32_t ray = rays[at + static_cast<std::uint32_t>(lane)];
          answer.limit[ray] = lasts[lane];
          answer.lo[ray] = firsts[lane];
          answer.leaf[ray] = leaf;
        }
        for (std::uint32_t left = open_bits & ~replaces; left != 0; left &= left - 1) {
          const int lane = __builtin_ctz(left);
          const std::uint32_t ray = rays[at + static_cast<std::uint32_t>(lane)];
          answer.limit[ray] = lasts[lane];
          if (answer.other_count == BlockAnswer::most_others) return;
          answer.others[answer.other_count++] = {firsts[lane], ray, leaf};
        }
      }
      if (nearer) t_max = greatest_limit();
    }
  }
}

}  // namespace

bool look_at_block_avx2(const BlockWorld& world, const char* rays, std::size_t stride,
                        std::size_t count, BlockAnswer& answer) {
  Block block;
  if (!make_block(rays, stride, count, block, answer.limit)) return false;
  for (std::size_t i = 0; i < rays_of_block; i += 8) {
    _mm256_store_ps(answer.lo + i, _mm256_set1_ps(infinity));
    _mm256_store_si256(reinterpret_cast<__m256i*>(answer.leaf + i), _mm256_set1_epi32(-1));
  }
  answer.other_count = 0;
  answer.nodes = 0;
  for_kind(world.kind, [&]<FormKind kind>() {
    look_at_block<kind>(world, block, answer);
    return ScreenBits{0, 0};
  });
  return answer.other_count < BlockAnswer::most_others;
}

}  // namespace minkray
#else
namespace minkray {
bool look_at_block_avx2(const BlockWorld&, const char*, std::size_t, std::size_t, BlockAnswer&) {
  return false;
}
}  // namespace minkray
#endif
