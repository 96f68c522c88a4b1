// SPDX-License-Identifier: MIT
// The closed forms in float lanes. Everything here has internal linkage or the type of the lanes in
// its name: see core/math/wide.h.
#include "core/cast/screen.h"
#include "core/exact/box.h"
#include "core/exact/capsule.h"
#include "core/exact/cylinder.h"
#include "core/exact/frustum.h"
#include "core/exact/rounded_box.h"
#include "core/exact/tapered_capsule.h"
#include "core/math/wide.h"
#include "core/query/tolerances.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

using W = Wide<float, screen_lanes, IsaAvx2>;

__m128 four(const float* from) {
  return _mm_loadu_ps(from);
}
__m128 four(const double* from) {
  return _mm256_cvtpd_ps(_mm256_loadu_pd(from));
}
__m256d four_in_double(const float* from) {
  return _mm256_cvtps_pd(_mm_loadu_ps(from));
}
__m256d four_in_double(const double* from) {
  return _mm256_loadu_pd(from);
}

/// Four numbers of each lane, read by four_of(lane), side by side.
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

template <class T>
[[gnu::always_inline]] inline Mat3<W> maps(const ScreenPairs<T>& pairs) {
  const auto column_by_column = [&](std::size_t lane) { return pairs.to_inner[lane]->data(); };
  const auto first = side_by_side([&](std::size_t i) { return four(column_by_column(i)); });
  const auto second = side_by_side([&](std::size_t i) { return four(column_by_column(i) + 4); });
  const auto last = [&](std::size_t i) { return static_cast<float>(column_by_column(i)[8]); };
  Mat3<W> map;
  for (int k = 0; k < 4; ++k) {
    map(k % 3, k / 3) = first[static_cast<std::size_t>(k)];
    map((k + 4) % 3, (k + 4) / 3) = second[static_cast<std::size_t>(k)];
  }
  map(2, 2) = W(W::Lanes{last(0), last(1), last(2), last(3), last(4), last(5), last(6), last(7)});
  return map;
}

/// Numbers of ScreenForm, lane by lane.
struct FormInLanes {
  std::array<W, 4> sizes;
  W slope, sine, R, least, extent, up;
  Vec3<W> scale, offset;

  template <class T>
  explicit FormInLanes(const ScreenPairs<T>& pairs) {
    const auto from = [&](std::size_t place) {
      return side_by_side([&](std::size_t lane) {
        return four(reinterpret_cast<const float*>(pairs.form[lane]) + 4 * place);
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

template <FormKind kind>
[[gnu::always_inline]] inline exact::Entry<W> enter(const FormInLanes& form,
                                                    const exact::Line<W>& line,
                                                    const Mask<W>& open) {
  const auto& a = form.sizes;
  if constexpr (kind == FormKind::ball) return exact::enter_ball(a[0], line, open);
  if constexpr (kind == FormKind::box) return exact::enter_box(a, line, open);
  if constexpr (kind == FormKind::rounded_box) return exact::enter_rounded_box(a, line, open);
  if constexpr (kind == FormKind::capsule) return exact::enter_capsule(a[0], a[1], line, open);
  if constexpr (kind == FormKind::cylinder) return exact::enter_cylinder(a[0], a[1], line, open);
  if constexpr (kind == FormKind::tapered_capsule)
    return exact::enter_tapered_capsule(a[0], a[1], a[2], form.slope, form.sine, a[3], form.R, line,
                                        open);
  if constexpr (kind == FormKind::frustum)
    return exact::enter_frustum(form.slope, form.sine, a[2], a[3], form.R, line, open);
}

/// It is not copied to where it is asked.
template <FormKind kind>
[[gnu::noinline]] exact::Entry<W> enter_again(const FormInLanes& form, const exact::Line<W>& line,
                                              const Mask<W>& open) {
  return enter<kind>(form, line, open);
}

template <FormKind kind, class T>
void screen(const ScreenPairs<T>& pairs, Screened& answers) {
  __m256d from_centre[screen_lanes];
  for (std::size_t lane = 0; lane < screen_lanes; ++lane)
    from_centre[lane] = _mm256_sub_pd(four_in_double(pairs.ray[lane]->origin.data()),
                                      four_in_double(pairs.centre[lane]->data()));
  const auto vector = [](const std::array<W, 4>& v) { return Vec3<W>(v[0], v[1], v[2]); };
  const Vec3<W> outer =
      vector(side_by_side([&](std::size_t lane) { return _mm256_cvtpd_ps(from_centre[lane]); }));
  Vec3<W> d = vector(
      side_by_side([&](std::size_t lane) { return four(pairs.ray[lane]->direction.data()); }));
  // To where the ray comes near, in double: what float loses of a ray from afar is on the ray.
  const W d_squared = d.squaredNorm(), k = -outer.dot(d) / d_squared;
  alignas(32) float steps[screen_lanes];
  k.store(steps);
  const Vec3<W> near = vector(side_by_side([&](std::size_t lane) {
    const __m256d step = _mm256_set1_pd(static_cast<double>(steps[lane]));
    return _mm256_cvtpd_ps(_mm256_fmadd_pd(four_in_double(pairs.ray[lane]->direction.data()), step,
                                           from_centre[lane]));
  }));
  const Mat3<W> map = maps(pairs);
  const FormInLanes form(pairs);

  Vec3<W> p = times(map, near) + form.offset;
  d = times(map, d);
  p.z() *= form.up;
  d.z() *= form.up;
  const W largest_scale = max(max(form.scale.x(), form.scale.y()), form.scale.z());
  p = p.cwiseProduct(form.scale);
  d = d.cwiseProduct(form.scale);
  exact::Line<W> line;
  line.d = d;
  line.dd = d.squaredNorm();
  line.inv = W(1) / line.dd;
  const W rest = -p.dot(d) * line.inv;
  line.s = p + d * rest;
  // |M| times the lengths of the point, of the step to the closest one, and of the form's own size
  // along the line, before the map.
  const W before = near.squaredNorm() + (rest * rest + form.R * form.R * line.inv) * d_squared;
  const W reach = sqrt(W(3) * map.squaredNorm() * before);
  line.E = W(tolerance::screen_rounding) * (largest_scale * reach + form.extent);
  const W share = line.E / form.R;
  line.parallel = share * share * W(0x1p-4f) * line.dd;
  const Mask<W> bounded = (line.dd > W(tolerance::screen_shortest_squared)) &
                          (line.dd < W(tolerance::screen_longest_squared)) &
                          (line.E < W(tolerance::screen_largest_share) * min(form.least, form.R));

  const exact::Entry<W> entry = enter<kind>(form, line, bounded);
  using std::abs;
  const auto slack_of = [&](const exact::Entry<W>& of) {
    return W(2) * of.e + W(tolerance::screen_digits) * (abs(k) + abs(rest) + abs(of.t));
  };
  const W t = k + (rest + entry.t), slack = slack_of(entry), lo = t - slack, hi = t + slack;
  const W infinity(std::numeric_limits<float>::infinity());
  const Mask<W> sure = entry.hit & (lo >= W(0)), behind = entry.hit & (hi < W(0));
  Mask<W> miss = entry.miss & bounded;
  // Rays that begin at a shape leave it: its other side is behind them as well.
  if (any(behind)) {
    const exact::Entry<W> exit = enter_again<kind>(form, line.reversed(), behind);
    miss |= exit.hit & (k + (rest - exit.t) + slack_of(exit) < W(0));
  }
  select(miss, infinity, select(sure, lo, W(0))).store(answers.first.data());
  select(sure, hi, infinity).store(answers.last.data());
}

template <class T>
void screen_kind(FormKind kind, const ScreenPairs<T>& pairs, Screened& answers) {
  switch (kind) {
    case FormKind::ball:
      return screen<FormKind::ball>(pairs, answers);
    case FormKind::box:
      return screen<FormKind::box>(pairs, answers);
    case FormKind::rounded_box:
      return screen<FormKind::rounded_box>(pairs, answers);
    case FormKind::capsule:
      return screen<FormKind::capsule>(pairs, answers);
    case FormKind::tapered_capsule:
      return screen<FormKind::tapered_capsule>(pairs, answers);
    case FormKind::cylinder:
      return screen<FormKind::cylinder>(pairs, answers);
    case FormKind::frustum:
      return screen<FormKind::frustum>(pairs, answers);
    default:
      return;
  }
}

}  // namespace

void screen_avx2(FormKind kind, const ScreenPairs<float>& pairs, Screened& answers) {
  screen_kind(kind, pairs, answers);
}
void screen_avx2(FormKind kind, const ScreenPairs<double>& pairs, Screened& answers) {
  screen_kind(kind, pairs, answers);
}

}  // namespace minkray
#else
namespace minkray {

/// Other machines never ask.
void screen_avx2(FormKind, const ScreenPairs<float>&, Screened&) {}
void screen_avx2(FormKind, const ScreenPairs<double>&, Screened&) {}

}  // namespace minkray
#endif
