// SPDX-License-Identifier: MIT
// The closed forms in float lanes. Everything here has internal linkage or the type of the lanes in
#include "core/cast/form_in_lanes.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

/// A ray near a form, in the frame of its instance.
struct Seen {
  Vec3<W> near, d;  ///< from the centre, in the world
  W k, d_squared;   ///< the parameter of `near`
  Mat3<W> map;
};

template <FormKind kind>
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
  first = select(miss, infinity, select(sure, lo, W(0)));
  last = select(sure, hi, infinity);
}

template <FormKind kind>
[[gnu::always_inline]] inline ScreenBits look(const Seen& seen, const FormInLanes& form,
                                              const W& limit, Screened& answers) {
  W first, last;
  look<kind>(seen, form, first, last);
  first.store(answers.first.data());
  last.store(answers.last.data());
  // Infinity is not below infinity.
  return {lane_bits((first <= limit) & (first < W(std::numeric_limits<float>::infinity()))),
          lane_bits(last <= limit & (last < W(std::numeric_limits<float>::infinity())))};
}

template <class T>
struct PlaceOf {
  T centre[3];
  float to_inner[9];
  std::uint32_t definition;
};

template <FormKind kind, class T>
ScreenBits screen_list(const ScreenList<T>& list, const std::uint32_t* rays,
                       const std::uint32_t* instances, Screened& answers) {
  const PlaceOf<T>* place[screen_lanes];
  const Ray<T>* ray[screen_lanes];
  __m256d from_centre[screen_lanes];
  std::uint32_t others = 0;
  for (std::size_t lane = 0; lane < screen_lanes; ++lane) {
    place[lane] =
        reinterpret_cast<const PlaceOf<T>*>(list.places + std::size_t{64} * instances[lane]);
    ray[lane] = reinterpret_cast<const Ray<T>*>(list.rays + list.stride * rays[lane]);
    from_centre[lane] = _mm256_sub_pd(four_in_double(ray[lane]->origin.data()),
                                      four_in_double(place[lane]->centre));
    others |= place[lane]->definition ^ place[0]->definition;
  }
  const auto vector = [](const std::array<W, 4>& v) { return Vec3<W>(v[0], v[1], v[2]); };
  Seen seen;
  const Vec3<W> outer =
      vector(side_by_side([&](std::size_t lane) { return _mm256_cvtpd_ps(from_centre[lane]); }));
  seen.d =
      vector(side_by_side([&](std::size_t lane) { return four(ray[lane]->direction.data()); }));
  seen.d_squared = seen.d.squaredNorm();
  seen.k = -outer.dot(seen.d) / seen.d_squared;
  alignas(32) float steps[screen_lanes];
  seen.k.store(steps);
  seen.near = vector(side_by_side([&](std::size_t lane) {
    const __m256d step = _mm256_set1_pd(static_cast<double>(steps[lane]));
    return _mm256_cvtpd_ps(
        _mm256_fmadd_pd(four_in_double(ray[lane]->direction.data()), step, from_centre[lane]));
  }));
  const auto one = side_by_side([&](std::size_t lane) { return four(place[lane]->to_inner); });
  const auto two = side_by_side([&](std::size_t lane) { return four(place[lane]->to_inner + 4); });
  for (int k = 0; k < 4; ++k) {
    seen.map(k % 3, k / 3) = one[static_cast<std::size_t>(k)];
    seen.map((k + 4) % 3, (k + 4) / 3) = two[static_cast<std::size_t>(k)];
  }
  const auto last = [&](std::size_t i) { return place[i]->to_inner[8]; };
  seen.map(2, 2) = W(W::Lanes{last(0), last(1), last(2), last(3), last(4), last(5), last(6), last(7)});
  const auto limit = [&](std::size_t i) { return list.limits[rays[i]]; };
  const W limits(W::Lanes{limit(0), limit(1), limit(2), limit(3), limit(4), limit(5), limit(6), limit(7)});
  if (others == 0) [[likely]]
    return look<kind>(seen, FormInLanes(list.screens[place[0]->definition]), limits, answers);
  if constexpr (kind == FormKind::polytope) {
    // One definition after the other.
    ScreenBits all{0, 0};
    Screened theirs;
    for (std::uint32_t left = 0xffu; left != 0;) {
      const std::uint32_t definition = place[__builtin_ctz(left)]->definition;
      std::uint32_t these = 0;
      for (std::uint32_t lane = 0; lane < screen_lanes; ++lane)
        these |= (place[lane]->definition == definition ? 1u : 0u) << lane;
      const ScreenBits bits =
          look<kind>(seen, FormInLanes(list.screens[definition]), limits, theirs);
      all.open |= bits.open & these;
      all.sure |= bits.sure & these;
      for (std::size_t lane = 0; lane < screen_lanes; ++lane)
        if (these >> lane & 1u) {
          answers.first[lane] = theirs.first[lane];
          answers.last[lane] = theirs.last[lane];
        }
      left &= ~these;
    }
    return all;
  }
  ScreenPairs<T> forms;
  for (std::size_t lane = 0; lane < screen_lanes; ++lane)
    forms.form[lane] = &list.screens[place[lane]->definition].form;
  return look<kind>(seen, FormInLanes(forms), limits, answers);
}

/// Eight numbers in double, in float.
[[gnu::always_inline]] inline W in_float(const __m256d& low, const __m256d& high) {
  return W(W::Lanes(_mm256_set_m128(_mm256_cvtpd_ps(high), _mm256_cvtpd_ps(low))));
}

template <FormKind kind, class T>
ScreenBits screen_block(const ScreenBlock& block, int first, const char* where,
                        const Screen* screens, Screened& answers) {
  const PlaceOf<T>& place = *reinterpret_cast<const PlaceOf<T>*>(where);
  __m256d low[3], high[3];
  Seen seen;
  Vec3<W> outer;
  for (int axis = 0; axis < 3; ++axis) {
    const __m256d centre = _mm256_set1_pd(static_cast<double>(place.centre[axis]));
    low[axis] = _mm256_sub_pd(_mm256_load_pd(block.origin[axis] + first), centre);
    high[axis] = _mm256_sub_pd(_mm256_load_pd(block.origin[axis] + first + 4), centre);
    outer[axis] = in_float(low[axis], high[axis]);
    seen.d[axis] = in_float(_mm256_load_pd(block.direction[axis] + first),
                            _mm256_load_pd(block.direction[axis] + first + 4));
  }
  seen.d_squared = seen.d.squaredNorm();
  seen.k = -outer.dot(seen.d) / seen.d_squared;
  const __m256d k_low = _mm256_cvtps_pd(_mm256_castps256_ps128(__m256(seen.k.lanes))),
                k_high = _mm256_cvtps_pd(_mm256_extractf128_ps(__m256(seen.k.lanes), 1));
  for (int axis = 0; axis < 3; ++axis)
    seen.near[axis] =
        in_float(_mm256_fmadd_pd(_mm256_load_pd(block.direction[axis] + first), k_low, low[axis]),
                 _mm256_fmadd_pd(_mm256_load_pd(block.direction[axis] + first + 4), k_high, high[axis]));
  for (int k = 0; k < 9; ++k) seen.map(k % 3, k / 3) = W(place.to_inner[k]);
  return look<kind>(seen, FormInLanes(screens[place.definition]), W::load(block.t + first),
                    answers);
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
  const Vec3<W> d = vector(
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
  const FormInLanes form(pairs);
  W first, last;
  look<kind>(Seen{near, d, k, d_squared, maps(pairs)}, form, first, last);
  first.store(answers.first.data());
  last.store(answers.last.data());
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

template <class T>
ScreenBits screen_list_avx2(FormKind kind, const ScreenList<T>& list, const std::uint32_t* rays,
                            const std::uint32_t* instances, Screened& answers) {
  return for_kind(kind, [&]<FormKind of>() {
    return screen_list<of, T>(list, rays, instances, answers);
  });
}
template <class T>
ScreenBits screen_block_avx2(FormKind kind, const ScreenBlock& block, int first, const char* place,
                             const Screen* screens, Screened& answers) {
  return for_kind(kind, [&]<FormKind of>() {
    return screen_block<of, T>(block, first, place, screens, answers);
  });
}
template ScreenBits screen_list_avx2(FormKind, const ScreenList<float>&, const std::uint32_t*,
                                     const std::uint32_t*, Screened&);
template ScreenBits screen_list_avx2(FormKind, const ScreenList<double>&, const std::uint32_t*,
                                     const std::uint32_t*, Screened&);
template ScreenBits screen_block_avx2<float>(FormKind, const ScreenBlock&, int, const char*,
                                             const Screen*, Screened&);
template ScreenBits screen_block_avx2<double>(FormKind, const ScreenBlock&, int, const char*,
                                              const Screen*, Screened&);

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
template <class T>
ScreenBits screen_list_avx2(FormKind, const ScreenList<T>&, const std::uint32_t*,
                            const std::uint32_t*, Screened&) { return {0, 0}; }
template <class T>
ScreenBits screen_block_avx2(FormKind, const ScreenBlock&, int, const char*, const Screen*,
                             Screened&) { return {0, 0}; }
void screen_avx2(FormKind, const ScreenPairs<float>&, Screened&) {}
void screen_avx2(FormKind, const ScreenPairs<double>&, Screened&) {}

}  // namespace minkray
#endif
