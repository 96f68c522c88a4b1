// SPDX-License-Identifier: MIT
// The line of a ray and a triangle in quadruple precision (113 bits). Signs are exact if all
// coordinates are multiples of 2^-32 below 8: the volumes below have at most 110 bits.
#pragma once

#include "tests/proof/grid_meshes.h"

namespace minkray::testing {

__extension__ using Quad = __float128;

struct QuadVec {
  Quad x, y, z;
};

inline QuadVec quad_minus(const Vec3& a, const Vec3& b) {
  return {Quad(a.x) - b.x, Quad(a.y) - b.y, Quad(a.z) - b.z};
}
inline QuadVec quad_cross(const QuadVec& a, const QuadVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Quad quad_dot(const QuadVec& a, const QuadVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline int sign(Quad x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// Relation of a line to a triangle: a hit goes through it, its edges and corners included.
struct ExactHit {
  bool is_hit = false, is_at_edge = false;
  int facing = 0;  ///< 1: the triangle is seen from its front, -1: from behind, 0: edge-on
  Quad t = 0;
};

inline ExactHit exact_hit(const Vec3& a, const Vec3& b, const Vec3& c, const Ray& ray) {
  const QuadVec d = quad_minus(ray.direction, {});
  const QuadVec from_a = quad_minus(a, ray.origin), from_b = quad_minus(b, ray.origin),
                from_c = quad_minus(c, ray.origin);
  const auto side = [&](const QuadVec& from, const QuadVec& to) {
    return sign(quad_dot(d, quad_cross(from, to)));
  };
  const int ab = side(from_a, from_b), bc = side(from_b, from_c), ca = side(from_c, from_a);
  const QuadVec n = quad_cross(quad_minus(b, a), quad_minus(c, a));
  const Quad fall = quad_dot(d, n);
  ExactHit hit;
  hit.facing = -sign(fall);
  if (hit.facing == 0) return hit;
  hit.is_hit = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  hit.is_at_edge = hit.is_hit && (ab == 0 || bc == 0 || ca == 0);
  hit.t = quad_dot(n, from_a) / fall;
  return hit;
}

inline ExactHit exact_hit(const GridMesh& mesh, std::size_t triangle, const Ray& ray) {
  return exact_hit(mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2),
                   ray);
}

/// The exact hits with 0 <= t of all triangles, in the order of their numbers. Triangles whose
/// bounding balls are further from the line than any rounding are skipped.
inline std::vector<ExactHit> all_exact_hits(const GridMesh& mesh, const Ray& ray) {
  std::vector<ExactHit> hits;
  const double size2 = dot(ray.direction, ray.direction);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vec3 a = mesh.corner(i, 0), from_origin = minus(a, ray.origin);
    const Vec3 b = minus(mesh.corner(i, 1), a), c = minus(mesh.corner(i, 2), a);
    const Vec3 off = cross(from_origin, ray.direction);
    const double reach2 = std::max(dot(b, b), dot(c, c));
    // 1e-12 is 1000 times the rounding of coordinates below 8.
    if (dot(off, off) > (1.001 * reach2 + 1e-12) * size2) continue;
    const ExactHit hit = exact_hit(mesh, i, ray);
    if (hit.is_hit && hit.t >= 0) hits.push_back(hit);
  }
  return hits;
}

}  // namespace minkray::testing
