// SPDX-License-Identifier: MIT
// Vertex normals from triangles, weighted by angle (Thuermer and Wuethrich, "Computing Vertex
// Normals from Polygonal Facets", 1998).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/files/mesh_attributes.h"

namespace minkray {
namespace {

/// A triangle at a vertex, with its normal and its angle at the vertex.
struct Wedge {
  std::uint32_t triangle, corner;
  Vec3<double> normal;  ///< of unit length, or zero
  double angle;
};

/// Vertices with more triangles have one normal for all: comparing all pairs would take too long.
constexpr std::size_t most_compared = 1000;

double angle_between(const Vec3<double>& a, const Vec3<double>& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

MeshAttributes smooth_normals(std::span<const Vec3<double>> vertices,
                              std::span<const std::array<std::uint32_t, 3>> triangles,
                              double crease) {
  // Groups the wedges by vertex.
  std::vector<std::uint32_t> begin(vertices.size() + 1);
  for (const auto& corners : triangles)
    for (const std::uint32_t vertex : corners) ++begin[vertex + 1];
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<Wedge> wedges(3 * triangles.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    std::array<Vec3<double>, 3> sides;
    for (std::size_t k = 0; k < 3; ++k)
      sides[k] = unit<double>(vertices[triangles[t][(k + 1) % 3]] - vertices[triangles[t][k]]);
    const Vec3<double> across = sides[0].cross(sides[1]);
    const Vec3<double> normal = across.isZero(0) ? across : unit<double>(across);
    for (std::uint32_t k = 0; k < 3; ++k)
      wedges[next[triangles[t][k]]++] = {t, k, normal,
                                         angle_between(sides[k], -sides[(k + 2) % 3])};
  }
  MeshAttributes smooth;
  smooth.normal_of.assign(triangles.size(), MeshAttributes::no_numbers);
  const double least = std::cos(crease);
  for (std::size_t vertex = 0; vertex < vertices.size(); ++vertex) {
    const auto around = std::span(wedges).subspan(begin[vertex], begin[vertex + 1] - begin[vertex]);
    const bool share_one = crease >= std::numbers::pi || around.size() > most_compared;
    Vec3<double> sum = Vec3<double>::Zero();
    for (const Wedge& other : around) sum += other.angle * other.normal;
    for (const Wedge& wedge : around) {
      if (!share_one) {
        sum.setZero();
        for (const Wedge& other : around)
          if (other.normal.dot(wedge.normal) >= least) sum += other.angle * other.normal;
      }
      const Vec3<float> normal = attribute_normal(sum);
      // Reuses the previous normal of the vertex, which is usually the same.
      if (smooth.normals.empty() || &wedge == around.data() || smooth.normals.back() != normal)
        smooth.normals.push_back(normal);
      smooth.normal_of[wedge.triangle][wedge.corner] =
          static_cast<std::uint32_t>(smooth.normals.size() - 1);
    }
  }
  settle(smooth);
  // Opposite triangles give no normal, but this is not an error of the file.
  smooth.bad_normals = 0;
  return smooth;
}

}  // namespace minkray
