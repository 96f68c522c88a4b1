// SPDX-License-Identifier: MIT
// Lower bounds of the distances from eight triangles to another triangle, computed from the gaps
// between planes perpendicular to the faces' normals, to the line between the triangles' middles,
// and to a known good direction. Pairs that these bounds do not decide go to triangle_pair.h.
#pragma once

#include "core/parts/triangle_pair.h"

namespace minkray {

/// Eight triangles in one frame. Normals have unit length, or are 0 for slivers.
struct EightTriangles {
  static constexpr int most = 8;  ///< maximum number of triangles
  int count = 0;
  std::uint32_t parts[most];               ///< numbers of the triangles in their mesh
  alignas(32) double corners[3][3][most];  ///< by corner, axis, triangle
  alignas(32) double normals[3][most];

  /// Completes the triangles after the last set(): copies the first one to the unused lanes, and
  /// computes the normals.
  void finish();
  TriangleCorners triangle(int i) const {
    const auto corner = [&](int k) {
      return Vec3<double>(corners[k][0][i], corners[k][1][i], corners[k][2][i]);
    };
    return {corner(0), corner(1), corner(2)};
  }
  Vec3<double> normal(int i) const { return {normals[0][i], normals[1][i], normals[2][i]}; }
  void set(int i, std::uint32_t part, const TriangleCorners& triangle);
  /// Largest n . p over the points p of the triangles.
  double reach_along(const Vec3<double>& n) const;
};

/// Writes lower bounds of the distances, without a margin for rounding; they may be below 0.
/// `normal` is that of the triangle `one`. `known`, if not null, is a unit vector from `one`
/// towards the eight triangles.
void triangle_gaps(const TriangleCorners& one, const Vec3<double>& normal,
                   const EightTriangles& eight, const Vec3<double>* known, double* gaps);
/// Functions for both instruction sets return the same bits.
void triangle_gaps_avx2(const TriangleCorners& one, const Vec3<double>& normal,
                        const EightTriangles& eight, const Vec3<double>* known, double* gaps);
void triangle_gaps_sse2(const TriangleCorners& one, const Vec3<double>& normal,
                        const EightTriangles& eight, const Vec3<double>* known, double* gaps);
/// Compute the normals of all lanes.
void triangle_normals_avx2(EightTriangles& eight);
void triangle_normals_sse2(EightTriangles& eight);

}  // namespace minkray
