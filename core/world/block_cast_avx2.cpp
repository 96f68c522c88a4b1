// SPDX-License-Identifier: MIT
// Exact casts of four rays at a time, which are read from their arrays. All functions have internal
// linkage or the lanes' type in their name (core/math/wide.h explains why).
#include "core/cast/filter.h"
#include "core/cast/packet_lanes.h"
#include "core/world/ray_block.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

using D = Wide<double, 4, IsaAvx2>;

/// Transposes four rows of four numbers.
[[gnu::always_inline]] inline void transpose(const __m256d (&row)[4], D (&column)[4]) {
  const __m256d a = _mm256_unpacklo_pd(row[0], row[1]), b = _mm256_unpackhi_pd(row[0], row[1]);
  const __m256d c = _mm256_unpacklo_pd(row[2], row[3]), d = _mm256_unpackhi_pd(row[2], row[3]);
  column[0] = D(D::Lanes(_mm256_permute2f128_pd(a, c, 0x20)));
  column[1] = D(D::Lanes(_mm256_permute2f128_pd(b, d, 0x20)));
  column[2] = D(D::Lanes(_mm256_permute2f128_pd(a, c, 0x31)));
  column[3] = D(D::Lanes(_mm256_permute2f128_pd(b, d, 0x31)));
}

[[gnu::always_inline]] inline Vec3<D> vectors(const double* const (&from)[4], std::size_t at,
                                              D* fourth) {
  __m256d row[4];
  for (std::size_t i = 0; i < 4; ++i) row[i] = _mm256_loadu_pd(from[i] + at);
  D column[4];
  transpose(row, column);
  if (fourth) *fourth = column[3];
  return {column[0], column[1], column[2]};
}

/// Same as `joined` of core/screen/instance_place.h, for four numbers.
[[gnu::always_inline]] inline __m256d joined(const float* leading, const std::int32_t* trailing) {
  const __m256d number = _mm256_cvtps_pd(_mm_loadu_ps(leading));
  if (!trailing) return number;
  const __m256i digits =
      _mm256_cvtepi32_epi64(_mm_loadu_si128(reinterpret_cast<const __m128i*>(trailing)));
  return _mm256_castsi256_pd(_mm256_add_epi64(_mm256_castpd_si256(number), digits));
}

/// A body at one place per lane, in the form that the filter reads.
struct Placed {
  const ShapeDefinition& of;
  Vec3<D> at;
  Mat3<D> map;
  bool is_turned;
  const ShapeDefinition& definition() const { return of; }
  const Vec3<D>& centre() const { return at; }
  const Mat3<D>* linear_to_inner() const { return is_turned ? &map : nullptr; }
};

[[gnu::always_inline]] inline void read_map(const FourPairs& pairs, Mat3<D>& map) {
  for (std::size_t k = 0; k < 8; k += 4) {
    __m256d row[4];
    for (std::size_t i = 0; i < 4; ++i)
      row[i] =
          joined(pairs.place[i]->to_inner + k, pairs.digits[i] ? pairs.digits[i]->of + k : nullptr);
    D column[4];
    transpose(row, column);
    for (std::size_t i = 0; i < 4; ++i)
      map(static_cast<int>((k + i) % 3), static_cast<int>((k + i) / 3)) = column[i];
  }
  const auto last = [&](std::size_t i) {
    return minkray::joined(pairs.place[i]->to_inner[8],
                           pairs.digits[i] ? pairs.digits[i]->of[8] : 0);
  };
  map(2, 2) = D(D::Lanes{last(0), last(1), last(2), last(3)});
}

}  // namespace

void cast_four_avx2(const InstanceBody& body, const FourPairs& pairs, LaneBits lanes,
                    CastPacket& answers) {
  Ray<D> ray;
  ray.origin = vectors(pairs.ray, 0, nullptr);
  ray.direction = vectors(pairs.ray, 3, &ray.t_max);
  Placed placed{*body.definition, {}, {}, body.is_turned};
  const double* const origins[4] = {pairs.place[0]->origin, pairs.place[1]->origin,
                                    pairs.place[2]->origin, pairs.place[3]->origin};
  placed.at = vectors(origins, 0, nullptr);
  if (body.is_turned) read_map(pairs, placed.map);
  if (!body.is_centred) {
    const Vec3<D> centre = widen<D>(body.centre);
    placed.at += body.is_turned ? times<D, D>(placed.map.transpose(), centre) : centre;
  }
  const Filtered<D> answer = filter<false>(placed, ray, mask_of<D>(lanes));
  answers.hit = lane_bits(answer.hit) & lanes;
  answers.inside = lane_bits(answer.inside) & lanes;
  answers.miss = lane_bits(answer.miss) & lanes;
  answers.supports.fill(0);
  answers.path.fill(Path::filter);
  answer.t_base.store(answers.t_base.data());
  answer.t_offset.store(answers.t_offset.data());
  answer.offset_lo.store(answers.offset_lo.data());
  answer.offset_hi.store(answers.offset_hi.data());
  for (int axis = 0; axis < 3; ++axis)
    answer.normal[axis].store(answers.normal[static_cast<std::size_t>(axis)].data());
}

}  // namespace minkray
#else
namespace minkray {
/// Never called on machines without AVX2.
void cast_four_avx2(const InstanceBody&, const FourPairs&, LaneBits, CastPacket&) {}
}  // namespace minkray
#endif
