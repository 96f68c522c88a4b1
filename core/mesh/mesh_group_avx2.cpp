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

  /// False if the directions are too different; then no ray is cast.
  bool prepare() {
    const double* const first = reinterpret_cast<const double*>(&rays_[0].ray);
    SlabRay slabs[rays_of_group];
    make_slabs_avx2(reinterpret_cast<const char*>(&rays_[0].ray), sizeof(PartRay), count_, slabs);
    bool is_alike = slabs_.take(slabs, count_);
    for (std::size_t i = 0; i < count_; ++i) {
      const double* const ray = reinterpret_cast<const double*>(&rays_[i].ray);
      leaf_[i] = leaf_ray(ray, ray + 3, ray[6]);
      steps_[i] = slabs[i].steps;
      is_alike &= leaf_[i].z == leaf_[0].z && leaf_[i].sign == leaf_[0].sign;
      for (std::size_t k = 0; k < 3; ++k) is_alike &= ray[k] == first[k];
    }
    if (!is_alike) return false;
    double widest = 0;
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        const double apart = leaf_[i].shear[k] - leaf_[0].shear[k];
        apart_[i][k] = static_cast<float>(apart);
        widest = widest < std::abs(apart) ? std::abs(apart) : widest;
      }
    constexpr double of_rounding = 0x1p-30;
    widest_ = widest + of_rounding;
    constexpr double most_apart = 0.25;
    return widest < most_apart;
  }

  /// Returns the number of rays tested in each leaf.
  std::size_t walk() {
    std::size_t leaves = 0, looks = 0;
    counts_.nodes += slabs_.walk(view_.nodes, [&](std::uint32_t leaf, std::uint32_t in) {
      ++leaves;
      looks += static_cast<std::size_t>(__builtin_popcount(in));
      return look_at(view_.leaves[leaf], in);
    });
    return leaves == 0 ? rays_of_group : looks / leaves;
  }

 private:
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
    const LeafRay& ray = leaf_[0];
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
    const LeafRay& ray = leaf_[i];
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
    const double last = (ray.reach - static_cast<double>(ray.sign) * edges.oz) * edges.scale +
                        edges.margin + 0x1p-50 * edges.scale * ray.reach;
    const __m256 is_behind = _mm256_cmp_ps(
        edges.nearest, _mm256_set1_ps(static_cast<float>(last + 0x1p-22 * std::abs(last))),
        _CMP_GT_OQ);
    return ~static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_or_ps(is_beside, is_behind)));
  }

  /// True if any ray's t_max is lower now.
  bool look_at(const MeshLeaf& leaf, std::uint32_t in) {
    const LeafEdges edges = edges_of(leaf);
    const std::uint32_t full = (2u << (leaf.packed_scale & 7u)) - 1;
    bool is_lower = false;
    for (; in != 0; in &= in - 1) {
      const auto i = static_cast<std::size_t>(__builtin_ctz(in));
      for (std::uint32_t lanes = lanes_of(edges, i) & full; lanes != 0; lanes &= lanes - 1)
        is_lower |= cast(i, leaf.triangles[__builtin_ctz(lanes)]);
    }
    return is_lower;
  }

  bool cast(std::size_t i, std::uint32_t triangle) {
    ++counts_.triangles;
    const PartRay& ray = rays_[i];
    const PartHit hit = cast_in_lanes(view_, triangle, cast_ray_of(ray.ray, leaf_[i]));
    if (!hit.found() || !(hit.t >= ray.t_min) || !(hit.t <= ray.ray.t_max) ||
        !takes_place(*view_.mesh, ray.ray, hits_[i], hit))
      return false;
    hits_[i] = hit;
    leaf_[i].reach = (hit.t + hit.error) * leaf_[i].length;
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
  LeafRay leaf_[rays_of_group];
  double steps_[rays_of_group];
  float apart_[rays_of_group][2];  ///< shears, without the first ray's
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
