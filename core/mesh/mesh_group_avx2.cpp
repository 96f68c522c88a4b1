// SPDX-License-Identifier: MIT
// Casts up to 32 rays from one point with similar directions, such as a camera's, at a mesh
// together. Edge functions of a leaf are computed once, linear in the difference of a ray's
// direction from that of the first. Everything here has internal linkage.
#include "core/mesh/mesh_walk.h"

#if defined(__AVX2__)
#include "core/bvh/ray_group.h"
#include "core/mesh/triangle_lanes.h"

namespace minkray {
namespace {

/// Leaves with fewer rays are faster one by one.
constexpr std::size_t least_rays_of_leaf = 2;

/// Edge functions of a leaf's triangles for the first ray, and how they change with shears.
struct LeafEdges {
  __m256 at_first[3], by_x[3], by_y[3];
  __m256 nearest;    ///< least z of each triangle's corners, along the rays
  __m128 middle;     ///< middle of the cube's image for the first ray, x and y
  float far_middle;  ///< z of the cube's middle, from the rays' origin
  float error;       ///< the part that does not depend on the ray
  double oz, scale, margin;
};

class Group {
 public:
  Group(const MeshView& view, const PartRay* rays, std::size_t count, PartHit* hits,
        PartCounts& counts)
      : view_(view), rays_(rays), hits_(hits), counts_(counts), count_(count) {}

  /// False if the directions are too different; then no ray is cast. Takes four rays at a time.
  bool prepare() {
    const double* const first = numbers_of(0);
    first_ = leaf_ray(first, first + 3, first[6]);
    SlabRay slabs;
    make_slabs_avx2(reinterpret_cast<const char*>(first), 0, 1, &slabs);
    slabs_.begin(slabs.numbers);
    const __m256d no_sign = _mm256_set1_pd(-0.0), one = _mm256_set1_pd(1);
    const __m256d shear_x = _mm256_set1_pd(first_.shear[0]),
                  shear_y = _mm256_set1_pd(first_.shear[1]);
    __m256d widest = _mm256_setzero_pd();
    const __m256d origin = _mm256_loadu_pd(first);
    int is_other = 0;
    for (std::size_t i = 0; i < count_; i += 4) {
      __m256d d[3], t_max;
      {
        const double* const r0 = numbers_of(i);
        const double* const r1 = numbers_of(i + 1 < count_ ? i + 1 : i);
        const double* const r2 = numbers_of(i + 2 < count_ ? i + 2 : i);
        const double* const r3 = numbers_of(i + 3 < count_ ? i + 3 : i);
        constexpr int of_origin = 7;
        for (const double* const r : {r0, r1, r2, r3})
          is_other |= of_origin &
                      ~_mm256_movemask_pd(_mm256_cmp_pd(_mm256_loadu_pd(r), origin, _CMP_EQ_OQ));
        const __m256d a = _mm256_loadu_pd(r0 + 3), b = _mm256_loadu_pd(r1 + 3),
                      c = _mm256_loadu_pd(r2 + 3), e = _mm256_loadu_pd(r3 + 3);
        const __m256d ab_xz = _mm256_unpacklo_pd(a, b), ab_yt = _mm256_unpackhi_pd(a, b),
                      ce_xz = _mm256_unpacklo_pd(c, e), ce_yt = _mm256_unpackhi_pd(c, e);
        d[0] = _mm256_permute2f128_pd(ab_xz, ce_xz, 0x20);
        d[1] = _mm256_permute2f128_pd(ab_yt, ce_yt, 0x20);
        d[2] = _mm256_permute2f128_pd(ab_xz, ce_xz, 0x31);
        t_max = _mm256_permute2f128_pd(ab_yt, ce_yt, 0x31);
      }
      __m256d size[3];
      for (int k = 0; k < 3; ++k) size[k] = _mm256_andnot_pd(no_sign, d[k]);
      // The axis must be the one that leaf_ray chooses for each ray.
      const __m256d length = size[first_.z];
      for (int k = 0; k < 3; ++k)
        if (k != first_.z)
          is_other |=
              _mm256_movemask_pd(k < first_.z ? _mm256_cmp_pd(length, size[k], _CMP_NGT_UQ)
                                              : _mm256_cmp_pd(length, size[k], _CMP_NGE_UQ));
      is_other |= slabs_.set_four(i, d, length, t_max, steps_ + i);
      const __m256d to_t = _mm256_div_pd(one, d[first_.z]);
      const __m256d x = _mm256_sub_pd(_mm256_mul_pd(d[first_.x], to_t), shear_x),
                    y = _mm256_sub_pd(_mm256_mul_pd(d[first_.y], to_t), shear_y);
      widest = _mm256_max_pd(
          widest, _mm256_max_pd(_mm256_andnot_pd(no_sign, x), _mm256_andnot_pd(no_sign, y)));
      _mm256_store_pd(to_t_ + i, to_t);
      _mm256_store_pd(length_ + i, length);
      _mm256_store_pd(reach_ + i, _mm256_mul_pd(t_max, length));
      const __m128 x_float = _mm256_cvtpd_ps(x), y_float = _mm256_cvtpd_ps(y);
      _mm_store_ps(apart_[i], _mm_unpacklo_ps(x_float, y_float));
      _mm_store_ps(apart_[i + 2], _mm_unpackhi_ps(x_float, y_float));
    }
    slabs_.end(count_);
    if (is_other != 0) return false;
    alignas(32) double of_lanes[4];
    _mm256_store_pd(of_lanes, widest);
    constexpr double of_rounding = 0x1p-30, most_apart = 0.25;
    const double most =
        std::max(std::max(of_lanes[0], of_lanes[1]), std::max(of_lanes[2], of_lanes[3]));
    widest_ = most + of_rounding;
    return most < most_apart;
  }

  /// Returns the number of rays tested in each leaf.
  std::size_t walk() {
    std::size_t leaves = 0, looks = 0;
    const auto on_leaf = [&](std::uint32_t leaf, std::uint32_t in) {
      ++leaves;
      looks += static_cast<std::size_t>(__builtin_popcount(in));
      return look_at(view_.leaves[leaf], in);
    };
    counts_.nodes +=
        slabs_.walk(view_.nodes, on_leaf, [&](std::uint32_t what) { fetch(view_, what); });
    return leaves == 0 ? rays_of_group : looks / leaves;
  }

 private:
  const double* numbers_of(std::size_t i) const {
    return reinterpret_cast<const double*>(&rays_[i].ray);
  }

  /// Same as lanes_that_may_be_met, with these bounds. For a ray whose shears are dx and dy more,
  /// an edge function is at_first - dx by_x - dy by_y, without any rest. P is the largest sheared
  /// coordinate of the first ray, Z that of z, g the widest shear, u = 2^-24:
  /// - Quantised corners are as far off for each ray as in lanes_that_may_be_met.
  /// - x and y of the first ray round by 4 u P + 0.01 + far, z by 2 u Z. So at_first is off by
  ///   21 u P^2 + (0.04 + 4 far) P, and by_x and by_y by 16 u Z P + (0.02 + 2 far) Z.
  /// - dx and dy, two products with them and the sums round by 4 u P^2 + 12 u g Z P.
  /// In total: less than 64 u P (P + g Z) + (0.05 + 4 far) (P + g Z).
  [[gnu::always_inline]] LeafEdges edges_of(const MeshLeaf& leaf) const {
    constexpr double half_cube = 32767.5, cube = 65535;
    const LeafRay& ray = first_;
    LeafEdges edges;
    const double scale = static_cast<double>(leaf.scale());
    const double oz = static_cast<double>(leaf.origin[ray.z]) - ray.origin[ray.z];
    const double ox = static_cast<double>(leaf.origin[ray.x]) - ray.origin[ray.x];
    const double oy = static_cast<double>(leaf.origin[ray.y]) - ray.origin[ray.y];
    const double cx = (ox - ray.shear[0] * oz) * scale, cy = (oy - ray.shear[1] * oz) * scale;
    const double cz = oz * scale;
    const double middle_x = cx + half_cube * (1 - ray.shear[0]),
                 middle_y = cy + half_cube * (1 - ray.shear[1]);
    const auto greater = [](double a, double b) { return a < b ? b : a; };
    const double away = std::abs(oz);
    const double most = greater(std::abs(middle_x), std::abs(middle_y)) + cube;
    const double most_z = std::abs(cz) + cube;
    const double far = 0x1p-51 * scale * (greater(std::abs(ox), std::abs(oy)) + 2 * away);
    const double spread = most + widest_ * most_z;
    edges.error = static_cast<float>(0x1p-18 * most * spread + (0.05 + 4 * far) * spread);
    edges.middle = _mm_setr_ps(static_cast<float>(middle_x), static_cast<float>(middle_y), 0, 0);
    edges.far_middle = static_cast<float>(cz + half_cube);
    edges.oz = oz;
    edges.scale = scale;
    edges.margin = 1.01 + 0x1p-50 * scale * away;

    const __m256 from_x = _mm256_set1_ps(static_cast<float>(cx)),
                 from_y = _mm256_set1_ps(static_cast<float>(cy)),
                 from_z = _mm256_set1_ps(static_cast<float>(cz)),
                 shear_x = _mm256_set1_ps(static_cast<float>(ray.shear[0])),
                 shear_y = _mm256_set1_ps(static_cast<float>(ray.shear[1])),
                 sign = _mm256_set1_ps(ray.sign);
    __m256 x[3], y[3], z[3], along[3];
    for (int k = 0; k < 3; ++k) {
      const __m256 own = corner_row(leaf.corners[k][ray.z]);
      x[k] =
          _mm256_fnmadd_ps(shear_x, own, _mm256_add_ps(corner_row(leaf.corners[k][ray.x]), from_x));
      y[k] =
          _mm256_fnmadd_ps(shear_y, own, _mm256_add_ps(corner_row(leaf.corners[k][ray.y]), from_y));
      z[k] = _mm256_add_ps(own, from_z);
      along[k] = _mm256_mul_ps(own, sign);
    }
    edges.nearest = _mm256_min_ps(along[0], _mm256_min_ps(along[1], along[2]));
    for (int k = 0; k < 3; ++k) {
      const int c = (k + 1) % 3, b = k;
      edges.at_first[k] = _mm256_fmsub_ps(x[c], y[b], _mm256_mul_ps(y[c], x[b]));
      edges.by_x[k] = _mm256_fmsub_ps(z[c], y[b], _mm256_mul_ps(y[c], z[b]));
      edges.by_y[k] = _mm256_fmsub_ps(x[c], z[b], _mm256_mul_ps(z[c], x[b]));
    }
    return edges;
  }

  /// The lanes of triangles that the ray may meet.
  [[gnu::always_inline]] std::uint32_t lanes_of(const LeafEdges& edges, std::size_t i) const {
    const __m256 dx = _mm256_broadcast_ss(&apart_[i][0]), dy = _mm256_broadcast_ss(&apart_[i][1]);
    __m256 edge[3];
    for (int k = 0; k < 3; ++k)
      edge[k] = _mm256_fnmadd_ps(dx, edges.by_x[k],
                                 _mm256_fnmadd_ps(dy, edges.by_y[k], edges.at_first[k]));
    const __m256 least = _mm256_min_ps(edge[0], _mm256_min_ps(edge[1], edge[2])),
                 greatest = _mm256_max_ps(edge[0], _mm256_max_ps(edge[1], edge[2]));
    // Distance of the cube's middle from this ray; half its image is no wider than the cube.
    const __m128 apart = _mm_castpd_ps(_mm_load_sd(reinterpret_cast<const double*>(apart_[i])));
    const __m128 middle = _mm_andnot_ps(
        _mm_set1_ps(-0.0f), _mm_fnmadd_ps(apart, _mm_set1_ps(edges.far_middle), edges.middle));
    const float most = _mm_cvtss_f32(_mm_max_ss(middle, _mm_movehdup_ps(middle))) + 65535.0f;
    // 4 most (1 + the roundings in most), and 2 for the product of two errors.
    constexpr float four_halves = 4.04f;
    const __m256 bound = _mm256_set1_ps(four_halves * most + edges.error);
    const __m256 is_beside =
        _mm256_and_ps(_mm256_cmp_ps(least, _mm256_xor_ps(bound, _mm256_set1_ps(-0.0f)), _CMP_LT_OQ),
                      _mm256_cmp_ps(greatest, bound, _CMP_GT_OQ));
    const double last = (reach_[i] - static_cast<double>(first_.sign) * edges.oz) * edges.scale +
                        edges.margin + 0x1p-50 * edges.scale * reach_[i];
    const __m256 is_behind = _mm256_cmp_ps(
        edges.nearest, _mm256_set1_ps(static_cast<float>(last + 0x1p-22 * std::abs(last))),
        _CMP_GT_OQ);
    return ~static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_or_ps(is_beside, is_behind)));
  }

  /// True if any ray's t_max is lower now.
  bool look_at(const MeshLeaf& leaf, std::uint32_t in) {
    const std::uint32_t full = (2u << (leaf.packed_scale & 7u)) - 1;
    fetch_indices(view_, leaf);
    const LeafEdges edges = edges_of(leaf);
    std::uint32_t all = 0;
    std::uint8_t of_ray[rays_of_group];
    for (std::uint32_t left = in; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(__builtin_ctz(left));
      const std::uint32_t lanes = lanes_of(edges, i) & full;
      of_ray[i] = static_cast<std::uint8_t>(lanes);
      all |= lanes;
    }
    for (; all != 0; all &= all - 1) fetch_corners(view_, leaf.triangles[__builtin_ctz(all)]);
    bool is_lower = false;
    for (; in != 0; in &= in - 1) {
      const auto i = static_cast<std::size_t>(__builtin_ctz(in));
      for (std::uint32_t lanes = of_ray[i]; lanes != 0; lanes &= lanes - 1)
        is_lower |= cast(i, leaf.triangles[__builtin_ctz(lanes)]);
    }
    return is_lower;
  }

  bool cast(std::size_t i, std::uint32_t triangle) {
    ++counts_.triangles;
    const PartRay& ray = rays_[i];
    const PartHit hit = cast_in_lanes(view_, triangle, {&ray.ray, to_t_[i], first_.z});
    if (!hit.found() || !(hit.t >= ray.t_min) || !(hit.t <= ray.ray.t_max) ||
        !takes_place(*view_.mesh, ray.ray, hits_[i], hit))
      return false;
    hits_[i] = hit;
    reach_[i] = (hit.t + hit.error) * length_[i];
    SlabRay limits;
    limits.steps = steps_[i];
    return slabs_.lower(i, limits.limit(hit.t + hit.error));
  }

  const MeshView& view_;
  const PartRay* rays_;
  PartHit* hits_;
  PartCounts& counts_;
  std::size_t count_;
  double widest_;  ///< shear from the first ray's
  RayGroup slabs_;
  LeafRay first_;
  alignas(32) double steps_[rays_of_group], to_t_[rays_of_group], reach_[rays_of_group],
      length_[rays_of_group];                  ///< as in LeafRay
  alignas(16) float apart_[rays_of_group][2];  ///< shears, without the first ray's
};

}  // namespace

GroupResult closest_parts_of_group_avx2(const MeshView& view, const PartRay* rays,
                                        std::size_t count, PartHit* hits, PartCounts& counts) {
  Group group(view, rays, count, hits, counts);
  if (!group.prepare()) return GroupResult::none;
  for (std::size_t i = 0; i < count; ++i) hits[i] = {};
  return group.walk() >= least_rays_of_leaf ? GroupResult::alike : GroupResult::scattered;
}

}  // namespace minkray
#else
namespace minkray {

/// Never called on other machines.
GroupResult closest_parts_of_group_avx2(const MeshView&, const PartRay*, std::size_t, PartHit*,
                                        PartCounts&) {
  return GroupResult::none;
}

}  // namespace minkray
#endif
