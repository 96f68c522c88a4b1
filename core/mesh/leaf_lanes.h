// SPDX-License-Identifier: MIT
// Finds the triangles of a leaf (at most eight) that a ray may meet. Computes edge functions in
// float lanes, in coordinates that are sheared along the ray (Woop, Benthin and Wald, "Watertight
// Ray/Triangle Intersection", 2013), with an error bound. All functions have internal linkage.
#pragma once

#if defined(__AVX2__)

#include <immintrin.h>

#include "core/bvh/slab_ray.h"
#include "core/mesh/mesh_walk.h"

namespace minkray {
namespace {

/// A ray, prepared for tests of leaves.
struct LeafRay {
  double origin[3];      ///< by x, y, z
  double shear[4];       ///< change of the ray's x and y while z increases by 1
  double to_t;           ///< 1 / direction along z
  double reach, length;  ///< distances along z at t_max and at t = 1; not negative
  int x, y, z;           ///< axes; z is that of the direction's largest component
  float sign;            ///< sign of the direction along z
};

[[gnu::always_inline]] inline LeafRay leaf_ray(const double* origin, const double* direction,
                                               double t_max) {
  LeafRay leaf;
  double size[3];
  for (int k = 0; k < 3; ++k) {
    leaf.origin[k] = origin[k];
    size[k] = std::abs(direction[k]);
  }
  leaf.z = size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : (size[1] >= size[2] ? 1 : 2);
  leaf.x = leaf.z == 2 ? 0 : leaf.z + 1;
  leaf.y = leaf.z == 0 ? 2 : leaf.z - 1;
  leaf.to_t = 1 / direction[leaf.z];
  leaf.shear[0] = direction[leaf.x] * leaf.to_t;
  leaf.shear[1] = direction[leaf.y] * leaf.to_t;
  leaf.length = size[leaf.z];
  leaf.reach = t_max * leaf.length;
  leaf.sign = direction[leaf.z] < 0 ? -1.0f : 1.0f;
  return leaf;
}

/// Eight numbers of corners, as floats.
[[gnu::always_inline]] inline __m256 corner_row(const std::uint16_t* row) {
  return _mm256_cvtepi32_ps(
      _mm256_cvtepu16_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(row))));
}

/// Returns the lanes of triangles that the ray may meet at 0 <= z <= reach. In units of the leaf,
/// with u = 2^-24:
/// - A sheared coordinate of a true corner is at most `most`, since all corners are in the leaf's
///   cube. The sheared cube has its middle at `middle` and half the width 32767.5 (1 + |shear|).
/// - The error of a coordinate is at most `off`, the sum of: half a unit each for x and z (1); the
///   rounding of cx, of the shear and of two sums (u (3 most + 2 * 65535); the bound allows
///   4 u most + 0.01); the rounding, in double, of the vector from the ray's origin (`far`, counted
///   twice).
/// - The error of a product of two coordinates is 2 most off + off^2, plus the product's rounding;
///   the difference of two products is rounded, too.
[[gnu::always_inline]] inline std::uint32_t lanes_that_may_be_met(const MeshLeaf& leaf,
                                                                  const LeafRay& ray) {
  constexpr double half_cube = 32767.5, off_of_units = 1.01, four_u = 0x1p-22;
  const double scale = static_cast<double>(leaf.scale());
  const double oz = static_cast<double>(leaf.origin[ray.z]) - ray.origin[ray.z];
  const __m128d shear = _mm_loadu_pd(ray.shear), no_sign = _mm_set1_pd(-0.0);
  const __m128d oxy = _mm_sub_pd(
      _mm_setr_pd(static_cast<double>(leaf.origin[ray.x]), static_cast<double>(leaf.origin[ray.y])),
      _mm_setr_pd(ray.origin[ray.x], ray.origin[ray.y]));
  const __m128d c =
      _mm_mul_pd(_mm_sub_pd(oxy, _mm_mul_pd(shear, _mm_set1_pd(oz))), _mm_set1_pd(scale));
  const __m128d middle =
      _mm_add_pd(c, _mm_mul_pd(_mm_set1_pd(half_cube), _mm_sub_pd(_mm_set1_pd(1), shear)));
  const __m128d wide =
      _mm_mul_pd(_mm_set1_pd(half_cube), _mm_add_pd(_mm_set1_pd(1), _mm_andnot_pd(no_sign, shear)));
  const __m128d most_xy = _mm_add_pd(_mm_andnot_pd(no_sign, middle), wide);
  const __m128d far_xy = _mm_andnot_pd(no_sign, oxy);
  const double most = _mm_cvtsd_f64(_mm_max_sd(most_xy, _mm_unpackhi_pd(most_xy, most_xy)));
  const double far = _mm_cvtsd_f64(_mm_max_sd(far_xy, _mm_unpackhi_pd(far_xy, far_xy)));
  const double away = std::abs(oz);
  const double off = off_of_units + four_u * most + 0x1p-51 * scale * (far + 2 * away);
  const double error = 4 * most * off + 2 * off * off + four_u * (most + off) * (most + off);

  const __m128 c_float = _mm_cvtpd_ps(c), shear_float = _mm_cvtpd_ps(shear);
  const __m256 cx = _mm256_broadcastss_ps(c_float),
               cy = _mm256_broadcastss_ps(_mm_movehdup_ps(c_float)),
               sx = _mm256_broadcastss_ps(shear_float),
               sy = _mm256_broadcastss_ps(_mm_movehdup_ps(shear_float));
  const __m256 za = corner_row(leaf.corners[0][ray.z]), zb = corner_row(leaf.corners[1][ray.z]),
               zc = corner_row(leaf.corners[2][ray.z]);
  const auto sheared = [](const std::uint16_t* row, __m256 from, __m256 by, __m256 z) {
    return _mm256_fnmadd_ps(by, z, _mm256_add_ps(corner_row(row), from));
  };
  const __m256 ax = sheared(leaf.corners[0][ray.x], cx, sx, za),
               bx = sheared(leaf.corners[1][ray.x], cx, sx, zb),
               c_x = sheared(leaf.corners[2][ray.x], cx, sx, zc),
               ay = sheared(leaf.corners[0][ray.y], cy, sy, za),
               by = sheared(leaf.corners[1][ray.y], cy, sy, zb),
               c_y = sheared(leaf.corners[2][ray.y], cy, sy, zc);
  const __m256 bc = _mm256_fmsub_ps(c_x, by, _mm256_mul_ps(c_y, bx)),
               ca = _mm256_fmsub_ps(ax, c_y, _mm256_mul_ps(ay, c_x)),
               ab = _mm256_fmsub_ps(bx, ay, _mm256_mul_ps(by, ax));
  const __m256 least = _mm256_min_ps(bc, _mm256_min_ps(ca, ab)),
               greatest = _mm256_max_ps(bc, _mm256_max_ps(ca, ab));
  // The conversion to float rounds once more. With NaN or infinity no triangle is discarded.
  const __m256 bound = _mm256_set1_ps(static_cast<float>(error * (1 + 0x1p-20)));
  const __m256 is_beside =
      _mm256_and_ps(_mm256_cmp_ps(least, _mm256_xor_ps(bound, _mm256_set1_ps(-0.0f)), _CMP_LT_OQ),
                    _mm256_cmp_ps(greatest, bound, _CMP_GT_OQ));
  // The error of corners is half a unit. The error of t in cast_at_triangle is 2^-51 of the sum of
  // the summands' sizes.
  const double last = (ray.reach - static_cast<double>(ray.sign) * oz) * scale + off_of_units +
                      0x1p-50 * scale * (ray.reach + away);
  const __m256 sign = _mm256_set1_ps(ray.sign);
  const __m256 nearest = _mm256_min_ps(
      _mm256_mul_ps(za, sign), _mm256_min_ps(_mm256_mul_ps(zb, sign), _mm256_mul_ps(zc, sign)));
  const __m256 is_behind = _mm256_cmp_ps(
      nearest, _mm256_set1_ps(static_cast<float>(last + 0x1p-22 * std::abs(last))), _CMP_GT_OQ);
  const int out = _mm256_movemask_ps(_mm256_or_ps(is_beside, is_behind));
  return ~static_cast<std::uint32_t>(out) & ((2u << (leaf.packed_scale & 7u)) - 1);
}

}  // namespace
}  // namespace minkray
#endif
