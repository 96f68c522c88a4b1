// SPDX-License-Identifier: MIT
// All functions have internal linkage or the lanes' type in their name (core/math/wide.h explains
// why).
#include "core/screen/form_in_lanes.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

/// A ray near a form, and the map to the instance's frame.
struct Seen {
  Vec3<W> near, d;  ///< point relative to the centre, direction; both in the world
  W k, d_squared;   ///< the parameter of `near`
  Mat3<W> map;
  Mask<W> used;  ///< lanes with a pair
};

template <class F>
[[gnu::always_inline]] inline void look(const Seen& seen, const FormInLanes& form, W& first,
                                        W& last) {
  const Vec3<W>& near = seen.near;
  const Mat3<W>& map = seen.map;
  const W &k = seen.k, &d_squared = seen.d_squared;
  Vec3<W> d;
  Vec3<W> p = times(map, near) + form.offset;
  d = times(map, seen.d);
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
  // `before` sums the squared lengths, before the map, of the point, of the step to the closest
  // point, and of the form's own size along the line. `reach` multiplies its root by the map's
  // norm.
  const W before = near.squaredNorm() + (rest * rest + form.R * form.R * line.inv) * d_squared;
  const W reach = sqrt(W(3) * map.squaredNorm() * before);
  line.E = W(tolerance::screen_rounding) * (largest_scale * reach + form.extent);
  const W share = line.E / form.R;
  line.parallel = share * share * W(0x1p-4f) * line.dd;
  const Mask<W> bounded = seen.used & (line.dd > W(tolerance::screen_shortest_squared)) &
                          (line.dd < W(tolerance::screen_longest_squared)) &
                          (line.E < W(tolerance::screen_largest_share) * min(form.least, form.R));

  const exact::Entry<W> entry = enter<F>(form, line, bounded);
  using std::abs;
  const auto slack_of = [&](const exact::Entry<W>& of) {
    return W(2) * of.e + W(tolerance::screen_digits) * (abs(k) + abs(rest) + abs(of.t));
  };
  const W t = k + (rest + entry.t), slack = slack_of(entry), lo = t - slack, hi = t + slack;
  const W infinity(std::numeric_limits<float>::infinity());
  const Mask<W> sure = entry.hit & (lo >= W(0)), behind = entry.hit & (hi < W(0));
  Mask<W> miss = entry.miss & bounded;
  // If a ray begins on a shape and leaves it, the shape's far side is behind the ray, too.
  if (any(behind)) {
    const exact::Entry<W> exit = enter_again<F>(form, line.reversed(), behind);
    miss |= exit.hit & (k + (rest - exit.t) + slack_of(exit) < W(0));
  }
  first = select(miss, infinity, select(sure, lo, W(0)));
  last = select(sure, hi, infinity);
}

template <class F>
[[gnu::always_inline]] inline ScreenBits look(const Seen& seen, const FormInLanes& form,
                                              const W& limit, Screened& answers) {
  W first, last;
  look<F>(seen, form, first, last);
  first.store(answers.first.data());
  last.store(answers.last.data());
  // Infinite bounds set no bit, even if the limit is infinite.
  return {lane_bits((first <= limit) & (first < W(std::numeric_limits<float>::infinity()))),
          lane_bits(last <= limit & (last < W(std::numeric_limits<float>::infinity())))};
}

/// Screens the polytopes of the lanes, one set of planes after the other.
[[gnu::noinline]] ScreenBits look_at_polytopes(const Seen& seen,
                                               const Screen* const (&screens)[screen_lanes],
                                               const W& limits, Screened& answers) {
  ScreenBits all{0, 0};
  FormInLanes form(screens);
  for (std::uint32_t left = lane_bits(seen.used), same = 0; left != 0; left &= ~same) {
    form.planes = screens[__builtin_ctz(left)]->planes.get();
    same = 0;
    for (std::uint32_t lane = 0; lane < screen_lanes; ++lane)
      same |= (screens[lane]->planes.get() == form.planes ? left : 0u) & 1u << lane;
    Seen theirs = seen;
    theirs.used = lanes_in(same);
    Screened found;
    const ScreenBits bits = look<exact::PolytopeForm>(theirs, form, limits, found);
    all.open |= bits.open & same;
    all.sure |= bits.sure & same;
    for (std::uint32_t lanes = same; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(lanes));
      answers.first[lane] = found.first[lane];
      answers.last[lane] = found.last[lane];
    }
  }
  return all;
}

template <class F>
ScreenBits screen(const ScreenList& list, const std::uint32_t* rays, const std::uint32_t* instances,
                  std::size_t used, Screened& answers) {
  const InstancePlace* place[screen_lanes];
  const Screen* screens[screen_lanes];
  const double* ray[screen_lanes];
  __m256d from_centre[screen_lanes];
  std::uint32_t others = 0;
  for (std::size_t lane = 0; lane < screen_lanes; ++lane) {
    place[lane] = list.places + instances[lane];
    ray[lane] = reinterpret_cast<const double*>(list.rays + list.stride * rays[lane]);
    from_centre[lane] =
        _mm256_sub_pd(_mm256_loadu_pd(ray[lane]), _mm256_loadu_pd(place[lane]->origin));
    screens[lane] = list.screens + place[lane]->body;
    others |= screens[lane]->first_equal ^ screens[0]->first_equal;
  }
  const auto vector = [](const std::array<W, 4>& v) { return Vec3<W>(v[0], v[1], v[2]); };
  Seen seen;
  seen.used = first_lanes(used);
  const Vec3<W> outer =
      vector(side_by_side([&](std::size_t lane) { return _mm256_cvtpd_ps(from_centre[lane]); }));
  seen.d = vector(side_by_side(
      [&](std::size_t lane) { return _mm256_cvtpd_ps(_mm256_loadu_pd(ray[lane] + 3)); }));
  seen.d_squared = seen.d.squaredNorm();
  seen.k = -outer.dot(seen.d) / seen.d_squared;
  alignas(32) float steps[screen_lanes];
  seen.k.store(steps);
  seen.near = vector(side_by_side([&](std::size_t lane) {
    const __m256d step = _mm256_set1_pd(static_cast<double>(steps[lane]));
    return _mm256_cvtpd_ps(
        _mm256_fmadd_pd(_mm256_loadu_pd(ray[lane] + 3), step, from_centre[lane]));
  }));
  const auto one = side_by_side([&](std::size_t lane) { return four(place[lane]->to_inner); });
  const auto two = side_by_side([&](std::size_t lane) { return four(place[lane]->to_inner + 4); });
  for (int k = 0; k < 4; ++k) {
    seen.map(k % 3, k / 3) = one[static_cast<std::size_t>(k)];
    seen.map((k + 4) % 3, (k + 4) / 3) = two[static_cast<std::size_t>(k)];
  }
  const auto last = [&](std::size_t i) { return place[i]->to_inner[8]; };
  seen.map(2, 2) =
      W(W::Lanes{last(0), last(1), last(2), last(3), last(4), last(5), last(6), last(7)});
  const auto limit = [&](std::size_t i) { return list.limits[rays[i]]; };
  const W limits(
      W::Lanes{limit(0), limit(1), limit(2), limit(3), limit(4), limit(5), limit(6), limit(7)});
  if (others == 0) [[likely]]
    return look<F>(seen, FormInLanes(*screens[0]), limits, answers);
  if constexpr (F::lanes == exact::Lanes::planes)
    return look_at_polytopes(seen, screens, limits, answers);
  else
    return look<F>(seen, FormInLanes(screens), limits, answers);
}

}  // namespace

ScreenBits screen_avx2(FormKind kind, const ScreenList& list, const std::uint32_t* rays,
                       const std::uint32_t* instances, std::size_t used, Screened& answers) {
  return for_kind(kind, [&]<class F>() { return screen<F>(list, rays, instances, used, answers); });
}

}  // namespace minkray
#else
namespace minkray {

/// Never called on machines without AVX2.
ScreenBits screen_avx2(FormKind, const ScreenList&, const std::uint32_t*, const std::uint32_t*,
                       std::size_t, Screened&) {
  return {0, 0};
}

}  // namespace minkray
#endif
