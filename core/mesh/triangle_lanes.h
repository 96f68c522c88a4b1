// SPDX-License-Identifier: MIT
// Same as cast_at_triangle, with the three edges in lanes of double: the same operations in the
// same order, so results have the same bits. Difficult cases are left to cast_at_triangle. All
// functions have internal linkage.
#pragma once

#if defined(__AVX2__)

#include <immintrin.h>

#include "core/mesh/leaf_lanes.h"

namespace minkray {
namespace {

/// A ray for casts in lanes.
struct CastRay {
  const Ray<double>* ray;
  double to_t;  ///< 1 / component of the direction along `axis`, the largest component
  int axis;
};

[[gnu::always_inline]] inline CastRay cast_ray_of(const Ray<double>& ray, const LeafRay& leaf) {
  return {&ray, leaf.to_t, leaf.z};
}

[[gnu::always_inline]] inline __m256d load_three(const double* from) {
  return _mm256_maskload_pd(from, _mm256_setr_epi64x(-1, -1, -1, 0));
}

/// Moves lanes 0, 1, 2 into the order 1, 2, 0.
[[gnu::always_inline]] inline __m256d next_corner(__m256d of) {
  return _mm256_permute4x64_pd(of, 0xC9);
}

/// The three corners of a triangle.
struct CornerPlaces {
  const double *a, *b, *c;
};
[[gnu::always_inline]] inline CornerPlaces corner_places(const MeshView& view,
                                                         std::uint32_t triangle) {
  const std::uint32_t* const corners = view.corners + 3 * std::size_t{triangle};
  return {view.vertices + 3 * std::size_t{corners[0]}, view.vertices + 3 * std::size_t{corners[1]},
          view.vertices + 3 * std::size_t{corners[2]}};
}

/// Prefetches a node, or a leaf.
[[gnu::always_inline]] inline void fetch(const MeshView& view, std::uint32_t what) {
  const char* const at = what & BvhNode::leaf
                             ? reinterpret_cast<const char*>(view.leaves + (what & ~BvhNode::leaf))
                             : reinterpret_cast<const char*>(view.nodes + what);
  for (int line = 0; line < 4; ++line) __builtin_prefetch(at + 64 * line);
}
/// Prefetches the indices of a leaf's corners, while its lanes are computed.
[[gnu::always_inline]] inline void fetch_indices(const MeshView& view, const MeshLeaf& leaf) {
  for (const std::uint32_t triangle : leaf.triangles)
    __builtin_prefetch(view.corners + 3 * std::size_t{triangle});
}
[[gnu::always_inline]] inline void fetch_corners(const MeshView& view, std::uint32_t triangle) {
  const auto [a, b, c] = corner_places(view, triangle);
  __builtin_prefetch(a);
  __builtin_prefetch(b);
  __builtin_prefetch(c);
}

/// Same as cast_at_part.
[[gnu::always_inline]] inline PartHit cast_in_lanes(const MeshView& view, std::uint32_t triangle,
                                                    const CastRay& cast) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double* const o = reinterpret_cast<const double*>(cast.ray);
  const double* const d = o + 3;
  const auto [a, b, c] = corner_places(view, triangle);
  const __m256d va = load_three(a), vb = load_three(b), vc = load_three(c);
  const __m256d ab_xz = _mm256_unpacklo_pd(va, vb), ab_y = _mm256_unpackhi_pd(va, vb),
                cc_xz = _mm256_unpacklo_pd(vc, vc), cc_y = _mm256_unpackhi_pd(vc, vc);
  const __m256d x = _mm256_permute2f128_pd(ab_xz, cc_xz, 0x20),
                y = _mm256_permute2f128_pd(ab_y, cc_y, 0x20),
                z = _mm256_permute2f128_pd(ab_xz, cc_xz, 0x31);
  const __m256d from_x = _mm256_sub_pd(x, _mm256_set1_pd(o[0])),
                from_y = _mm256_sub_pd(y, _mm256_set1_pd(o[1])),
                from_z = _mm256_sub_pd(z, _mm256_set1_pd(o[2]));
  const __m256d edge_x = _mm256_sub_pd(next_corner(x), x),
                edge_y = _mm256_sub_pd(next_corner(y), y),
                edge_z = _mm256_sub_pd(next_corner(z), z);
  const __m256d dx = _mm256_set1_pd(d[0]), dy = _mm256_set1_pd(d[1]), dz = _mm256_set1_pd(d[2]);
  const __m256d x1 = _mm256_mul_pd(from_y, edge_z), x2 = _mm256_mul_pd(from_z, edge_y),
                y1 = _mm256_mul_pd(from_z, edge_x), y2 = _mm256_mul_pd(from_x, edge_z),
                z1 = _mm256_mul_pd(from_x, edge_y), z2 = _mm256_mul_pd(from_y, edge_x);
  const __m256d value = _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(dx, _mm256_sub_pd(x1, x2)),
                                                    _mm256_mul_pd(dy, _mm256_sub_pd(y1, y2))),
                                      _mm256_mul_pd(dz, _mm256_sub_pd(z1, z2)));
  const __m256d sign = _mm256_set1_pd(-0.0);
  const auto size_of = [sign](__m256d of) { return _mm256_andnot_pd(sign, of); };
  const __m256d size = _mm256_add_pd(
      _mm256_add_pd(_mm256_mul_pd(size_of(dx), _mm256_add_pd(size_of(x1), size_of(x2))),
                    _mm256_mul_pd(size_of(dy), _mm256_add_pd(size_of(y1), size_of(y2)))),
      _mm256_mul_pd(size_of(dz), _mm256_add_pd(size_of(z1), size_of(z2))));
  const __m256d error = _mm256_mul_pd(_mm256_set1_pd(6 * epsilon), size);
  const int above = _mm256_movemask_pd(_mm256_cmp_pd(value, error, _CMP_GT_OQ)) & 7;
  const int below =
      _mm256_movemask_pd(_mm256_cmp_pd(value, _mm256_xor_pd(error, sign), _CMP_LT_OQ)) & 7;
  if (above != 0 && below != 0) return {};
  if (above != 7 && below != 7) [[unlikely]]
    return cast_at_part(*view.mesh, triangle, *cast.ray);

  alignas(32) double values[4], errors[4];
  _mm256_store_pd(values, value);
  _mm256_store_pd(errors, error);
  const int axis = cast.axis;
  const double ta = (a[axis] - o[axis]) * cast.to_t, tb = (b[axis] - o[axis]) * cast.to_t,
               tc = (c[axis] - o[axis]) * cast.to_t;
  const auto lesser = [](double p, double q) { return q < p ? q : p; };
  const auto greater = [](double p, double q) { return p < q ? q : p; };
  const double first = lesser(lesser(ta, tb), tc), last = greater(greater(ta, tb), tc);
  const double most = greater(std::abs(first), std::abs(last));
  const double to_b = tb - ta, to_c = tc - ta;
  const double whole = values[0] + values[1] + values[2];
  const double beyond_a = (values[2] * to_b + values[0] * to_c) / whole;
  const double whole_error = errors[0] + errors[1] + errors[2];
  const double whole_at_least = std::abs(whole) - whole_error;
  const double range = last - first + 4 * epsilon * most;
  const double of_weights =
      errors[2] * std::abs(to_b) + errors[0] * std::abs(to_c) + whole_error * std::abs(beyond_a);
  const double t = ta + beyond_a;
  const double own = 1.001 * of_weights / whole_at_least + 14 * epsilon * most;
  PartHit hit;
  hit.error = lesser(range, own);
  hit.t = t < first ? first : last < t ? last : t;
  // Both are false if a number is NaN.
  const bool is_ordinary =
      whole_at_least > 0 && std::abs(beyond_a) < std::numeric_limits<double>::infinity();
  if (is_ordinary && hit.t < -hit.error) return {};
  if (!(is_ordinary && hit.t > hit.error)) [[unlikely]]
    return cast_at_part(*view.mesh, triangle, *cast.ray);
  hit.part = triangle;
  hit.is_back = above == 7;
  return hit;
}

}  // namespace
}  // namespace minkray
#endif
