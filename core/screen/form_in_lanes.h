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

/// The members of ScreenForm in lanes.
struct FormInLanes {
  std::array<W, 4> sizes;
  W slope, sine, R, least, extent, up;
  Vec3<W> scale, offset;
  const std::vector<float>* planes = nullptr;  ///< planes of a polytope, the same for all lanes

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
  explicit FormInLanes(const ScreenForm* const (&forms)[screen_lanes]) {
    const auto from = [&](std::size_t place) {
      return side_by_side([&](std::size_t lane) {
        return four(reinterpret_cast<const float*>(forms[lane]) + 4 * place);
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

/// Tests one line per lane against all planes of one polytope. E includes the rounding of planes to
/// float: normal, offset and sums together have an error of less than 2^-21 of the size of near
/// positions.
[[gnu::always_inline]] inline exact::Entry<W> enter_planes_alike(const FormInLanes& form,
                                                                 const exact::Line<W>& line,
                                                                 const Mask<W>& open) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  W in_lo(-infinity), in_hi(-infinity), out_lo(infinity), out_hi(infinity);
  const float* at = form.planes->data();
  const float* const end = at + form.planes->size();
  for (; at != end; at += 5) {
    const W x(at[0]), y(at[1]), z(at[2]);
    const W slope = x * line.d.x() + (y * line.d.y() + z * line.d.z());
    const W room = W(at[3]) - (x * line.s.x() + (y * line.s.y() + z * line.s.z()));
    const W inv = W(1) / max(abs(slope), W(exact::least_component<W>));
    const W t = room * inv, e = line.E * inv, deep = (line.E + W(at[4])) * inv;
    const Mask<W> enters = slope < W(0);
    in_lo = max(in_lo, select(enters, -t - e, W(-infinity)));
    in_hi = max(in_hi, select(enters, deep - t, W(-infinity)));
    out_lo = min(out_lo, select(enters, W(infinity), t - deep));
    out_hi = min(out_hi, select(enters, W(infinity), t + e));
  }
  exact::Entry<W> entry;
  entry.miss = open & (in_lo > out_hi);
  entry.hit = open & (in_hi <= out_lo);
  entry.t = (in_lo + in_hi) * W(0.5f);
  entry.e = (in_hi - in_lo) * W(0.5f);
  return entry;
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
