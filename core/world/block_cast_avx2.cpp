// SPDX-License-Identifier: MIT
// The exact casts of a block's rays, four by four, read where they lie.
#include "core/cast/filter.h"
#include "core/cast/packet_lanes.h"
#include "core/world/ray_block.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

using D = Wide<double, 4, IsaAvx2>;

[[gnu::always_inline]] inline void columns(const double* const (&from)[4], std::size_t at,
                                           D (&column)[4]) {
  const __m256d r0 = _mm256_loadu_pd(from[0] + at), r1 = _mm256_loadu_pd(from[1] + at),
                r2 = _mm256_loadu_pd(from[2] + at), r3 = _mm256_loadu_pd(from[3] + at);
  const __m256d a = _mm256_unpacklo_pd(r0, r1), b = _mm256_unpackhi_pd(r0, r1);
  const __m256d c = _mm256_unpacklo_pd(r2, r3), d = _mm256_unpackhi_pd(r2, r3);
  column[0] = D(D::Lanes(_mm256_permute2f128_pd(a, c, 0x20)));
  column[1] = D(D::Lanes(_mm256_permute2f128_pd(b, d, 0x20)));
  column[2] = D(D::Lanes(_mm256_permute2f128_pd(a, c, 0x31)));
  column[3] = D(D::Lanes(_mm256_permute2f128_pd(b, d, 0x31)));
}

/// A definition under a pose in each lane.
struct PlacedHere {
  const ShapeDefinition<double>& of;
  Vec3<D> at;
  Mat3<D> map;
  const ShapeDefinition<double>& definition() const { return of; }
  const Vec3<D>& centre() const { return at; }
  const Mat3<D>* linear_to_inner() const { return &map; }
};

}  // namespace

void cast_four_avx2(const ShapeDefinition<double>& definition, const FourPairs& pairs,
                    LaneBits lanes, CastPacket<double>& answers) {
  D c[4];
  Ray<D> ray;
  columns(pairs.ray, 0, c);
  ray.origin = {c[0], c[1], c[2]};
  columns(pairs.ray, 3, c);
  ray.direction = {c[0], c[1], c[2]};
  ray.t_max = c[3];
  PlacedHere placed{definition, {}, {}};
  columns(pairs.centre, 0, c);
  placed.at = {c[0], c[1], c[2]};
  for (std::size_t k = 0; k < 8; k += 4) {
    columns(pairs.to_inner, k, c);
    for (std::size_t i = 0; i < 4; ++i)
      placed.map(static_cast<int>((k + i) % 3), static_cast<int>((k + i) / 3)) = c[i];
  }
  placed.map(2, 2) = D(D::Lanes{pairs.to_inner[0][8], pairs.to_inner[1][8], pairs.to_inner[2][8],
                                pairs.to_inner[3][8]});
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
void cast_four_avx2(const ShapeDefinition<double>&, const FourPairs&, LaneBits,
                    CastPacket<double>&) {}
}  // namespace minkray
#endif
