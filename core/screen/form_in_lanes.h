// SPDX-License-Identifier: MIT
// Closed forms in float lanes, for screening kernels. All functions have internal linkage
// (core/math/wide.h explains why).
#pragma once

#include "core/exact/forms.h"
#include "core/math/wide.h"
#include "core/query/tolerances.h"
#include "core/screen/screen.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

using W = Wide<float, screen_lanes, IsaAvx2>;

inline __m128 four(const float* from) {
  return _mm_loadu_ps(from);
}

/// Transposes the four numbers that four_of(lane) returns for each lane.
template <class FourOf>
[[gnu::always_inline]] inline std::array<W, 4> side_by_side(const FourOf& four_of) {
  const auto both = [&](std::size_t lane) {
    return _mm256_set_m128(four_of(lane + 4), four_of(lane));
  };
  const __m256 a = both(0), b = both(1), c = both(2), d = both(3);
  const __m256 ab_low = _mm256_unpacklo_ps(a, b), ab_high = _mm256_unpackhi_ps(a, b);
  const __m256 cd_low = _mm256_unpacklo_ps(c, d), cd_high = _mm256_unpackhi_ps(c, d);
  const auto w = [](const __m256& lanes) { return W(W::Lanes(lanes)); };
  return {w(_mm256_shuffle_ps(ab_low, cd_low, 0x44)), w(_mm256_shuffle_ps(ab_low, cd_low, 0xEE)),
          w(_mm256_shuffle_ps(ab_high, cd_high, 0x44)),
          w(_mm256_shuffle_ps(ab_high, cd_high, 0xEE))};
}

/// The greatest of the lanes.
inline float greatest_lane(const W& x) {
  const auto lanes = __m256(x.lanes);
  __m128 most = _mm_max_ps(_mm256_castps256_ps128(lanes), _mm256_extractf128_ps(lanes, 1));
  most = _mm_max_ps(most, _mm_permute_ps(most, 0x4E));
  return _mm_cvtss_f32(_mm_max_ps(most, _mm_permute_ps(most, 0xB1)));
}

/// The members of ScreenForm in lanes.
struct FormInLanes {
  std::array<W, 4> sizes;
  W slope, sine, R, least, extent, up;
  Vec3<W> scale, offset;
  const ScreenPlanes* planes = nullptr;  ///< planes of a polytope, the same for all lanes

  /// Uses the same form in all lanes.
  explicit FormInLanes(const Screen& screen) : FormInLanes(screen.form) {
    planes = screen.planes.get();
  }
  explicit FormInLanes(const ScreenForm& form)
      : sizes{W(form.sizes[0]), W(form.sizes[1]), W(form.sizes[2]), W(form.sizes[3])},
        slope(form.slope),
        sine(form.sine),
        R(form.R),
        least(form.least),
        extent(form.extent),
        up(form.up),
        scale(W(form.scale[0]), W(form.scale[1]), W(form.scale[2])),
        offset(W(form.offset[0]), W(form.offset[1]), W(form.offset[2])) {}

  /// Uses one form per lane.
  explicit FormInLanes(const Screen* const (&screens)[screen_lanes]) {
    const auto from = [&](std::size_t place) {
      return side_by_side([&](std::size_t lane) {
        return four(reinterpret_cast<const float*>(&screens[lane]->form) + 4 * place);
      });
    };
    sizes = from(0);
    const auto shape = from(1), scales = from(2), offsets = from(3);
    slope = shape[0];
    sine = shape[1];
    R = shape[2];
    least = shape[3];
    scale = {scales[0], scales[1], scales[2]};
    extent = scales[3];
    offset = {offsets[0], offsets[1], offsets[2]};
    up = offsets[3];
  }
};
static_assert(offsetof(ScreenForm, slope) == 16 && offsetof(ScreenForm, scale) == 32 &&
              offsetof(ScreenForm, offset) == 48 && sizeof(ScreenForm) == 64);

/// A mask of lanes, given as bits.
inline Mask<W> lanes_in(std::uint32_t bits) {
  const __m256i each = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  const __m256i chosen = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), each);
  return Mask<W>(Mask<W>::Bits(_mm256_cmpeq_epi32(chosen, each)));
}

/// The first lanes, up to `count`.
inline Mask<W> first_lanes(std::size_t count) {
  return lanes_in((1u << count) - 1u);
}

/// Bounds of the parameters at which lines enter the last half-space and leave the first.
struct PlanesCrossed {
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  W in_lo{-infinity}, in_hi{-infinity}, out_lo{infinity}, out_hi{infinity};

  /// Crosses a plane with one line per lane, or a plane per lane with one line. `below` is the
  /// plane's offset less its depth. E includes the rounding of planes to float: normal, offset and
  /// sums together have an error of less than 2^-21 of the size of near positions.
  [[gnu::always_inline]] void cross(const Vec3<W>& normal, const W& offset, const W& below,
                                    const Vec3<W>& s, const Vec3<W>& d, const W& E) {
    const W slope = product(normal, d);
    const Mask<W> enters = slope < W(0);
    const W size = W(1) / max(abs(slope), W(exact::least_component<W>));
    const W inv = select(enters, -size, size), height = product(normal, s);
    const W outer = ((offset - height) + E) * inv, inner = ((below - height) - E) * inv;
    in_lo = max(in_lo, select(enters, outer, W(-infinity)));
    in_hi = max(in_hi, select(enters, inner, W(-infinity)));
    out_lo = min(out_lo, select(enters, W(infinity), inner));
    out_hi = min(out_hi, select(enters, W(infinity), outer));
  }
  /// Same for a plane that all lines enter, or that all leave, at slopes that are not small.
  template <bool enters>
  [[gnu::always_inline]] void cross_alike(const Vec3<W>& normal, const W& offset, const W& below,
                                          const Vec3<W>& s, const Vec3<W>& d, const W& E) {
    const W inv = W(1) / product(normal, d), height = product(normal, s);
    const W outer = ((offset - height) + E) * inv, inner = ((below - height) - E) * inv;
    if constexpr (enters) {
      in_lo = max(in_lo, outer);
      in_hi = max(in_hi, inner);
    } else {
      out_lo = min(out_lo, inner);
      out_hi = min(out_hi, outer);
    }
  }
  [[gnu::always_inline]] static W product(const Vec3<W>& a, const Vec3<W>& b) {
    return fma(a.x(), b.x(), fma(a.y(), b.y(), a.z() * b.z()));
  }

  /// The lines' entry, in open lanes.
  exact::Entry<W> entry(const Mask<W>& open) const {
    exact::Entry<W> entry;
    entry.miss = open & (in_lo > out_hi);
    entry.hit = open & (in_hi <= out_lo);
    entry.t = (in_lo + in_hi) * W(0.5f);
    entry.e = (in_hi - in_lo) * W(0.5f);
    return entry;
  }
};

/// Calls work(normal, offset, below) for a plane, the same in all lanes.
template <class Work>
[[gnu::always_inline]] inline void with_plane(const ScreenPlanes& planes, std::size_t i,
                                              const Work& work) {
  const float* const at = planes.row(i / screen_lanes) + i % screen_lanes;
  const auto number = [&](std::size_t k) { return W(at[k * screen_lanes]); };
  work(Vec3<W>(number(0), number(1), number(2)), number(3), number(4));
}

/// Crosses all planes with one line per lane.
[[gnu::always_inline]] inline PlanesCrossed cross_with_lines(const ScreenPlanes& planes,
                                                             const exact::Line<W>& line) {
  PlanesCrossed crossed;
  for (std::size_t i = 0; i < planes.count; ++i)
    with_plane(planes, i, [&](const Vec3<W>& normal, const W& offset, const W& below) {
      crossed.cross(normal, offset, below, line.s, line.d, line.E);
    });
  return crossed;
}

/// Crosses the planes with the lines in the set of lanes, one after the other: faster for few
/// lines.
inline PlanesCrossed cross_with_planes(const ScreenPlanes& planes, const exact::Line<W>& line,
                                       std::uint32_t lanes) {
  PlanesCrossed all;
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = __builtin_ctz(lanes);
    const auto alone = [&](const Vec3<W>& v) {
      return Vec3<W>(W(v.x().lane(lane)), W(v.y().lane(lane)), W(v.z().lane(lane)));
    };
    const Vec3<W> s = alone(line.s), d = alone(line.d);
    const W E(line.E.lane(lane));
    PlanesCrossed crossed;
    for (std::size_t first = 0; first < planes.count; first += screen_lanes) {
      const float* const row = planes.row(first / screen_lanes);
      const auto number = [&](std::size_t k) { return W::load(row + k * screen_lanes); };
      crossed.cross({number(0), number(1), number(2)}, number(3), number(4), s, d, E);
    }
    all.in_lo.set_lane(lane, greatest_lane(crossed.in_lo));
    all.in_hi.set_lane(lane, greatest_lane(crossed.in_hi));
    all.out_lo.set_lane(lane, -greatest_lane(-crossed.out_lo));
    all.out_hi.set_lane(lane, -greatest_lane(-crossed.out_hi));
  }
  return all;
}

/// Most lines that cross_with_planes handles faster than cross_with_lines.
constexpr int few_lines = 4;

/// Tests the lines in open lanes against all planes of one polytope.
[[gnu::always_inline]] inline exact::Entry<W> enter_planes_alike(const FormInLanes& form,
                                                                 const exact::Line<W>& line,
                                                                 const Mask<W>& open) {
  const std::uint32_t lanes = lane_bits(open);
  const PlanesCrossed crossed = __builtin_popcount(lanes) <= few_lines
                                    ? cross_with_planes(*form.planes, line, lanes)
                                    : cross_with_lines(*form.planes, line);
  return crossed.entry(open);
}

template <class F>
[[gnu::always_inline]] inline exact::Entry<W> enter(const FormInLanes& form,
                                                    const exact::Line<W>& line,
                                                    const Mask<W>& open) {
  if constexpr (F::lanes == exact::Lanes::planes)
    return enter_planes_alike(form, line, open);
  else
    return F::enter(form, line, open);
}

/// Same as enter, but not inlined.
template <class F>
[[gnu::noinline]] exact::Entry<W> enter_again(const FormInLanes& form, const exact::Line<W>& line,
                                              const Mask<W>& open) {
  return enter<F>(form, line, open);
}

/// Returns work.operator()<F>() for the form of this kind; no bits for forms without lanes.
template <class Work>
inline ScreenBits for_kind(FormKind kind, const Work& work) {
  return exact::with_form(kind, [&]<class F>() {
    if constexpr (F::lanes == exact::Lanes::none)
      return ScreenBits{0, 0};
    else
      return work.template operator()<F>();
  });
}

}  // namespace
}  // namespace minkray
#endif
