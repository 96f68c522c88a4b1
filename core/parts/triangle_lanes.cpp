// SPDX-License-Identifier: MIT
#include "core/parts/triangle_lanes.h"

#include "core/math/instruction_set.h"

namespace minkray {

void EightTriangles::set(int i, std::uint32_t part, const TriangleCorners& triangle) {
  parts[i] = part;
  for (int k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis)
      corners[k][axis][i] = triangle[static_cast<std::size_t>(k)][axis];
}

double EightTriangles::reach_along(const Vec3<double>& n) const {
  double furthest = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < EightTriangles::most; ++i)
      furthest = std::max(
          furthest, n[0] * corners[k][0][i] + n[1] * corners[k][1][i] + n[2] * corners[k][2][i]);
  return furthest;
}

void EightTriangles::finish() {
  const TriangleCorners first = triangle(0);
  for (int i = count; i < most; ++i) set(i, parts[0], first);
  (has_avx2() ? triangle_normals_avx2 : triangle_normals_sse2)(*this);
}

void triangle_gaps(const TriangleCorners& one, const Vec3<double>& normal,
                   const EightTriangles& eight, const Vec3<double>* known, double* gaps) {
  (has_avx2() ? triangle_gaps_avx2 : triangle_gaps_sse2)(one, normal, eight, known, gaps);
}

}  // namespace minkray
