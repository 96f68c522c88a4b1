// SPDX-License-Identifier: MIT
#include "renderer/surfaces/mesh_point.h"

#include <algorithm>

namespace minkray {
namespace {

using Numbers = MeshAttributes::Numbers;

/// Weights of the corners at a point, and how the second and third change along x, y and z.
struct Weights {
  std::array<double, 3> at = {1.0 / 3, 1.0 / 3, 1.0 / 3};
  std::array<Vec3<double>, 2> slopes = {Vec3<double>::Zero(), Vec3<double>::Zero()};
};

Weights weights_of(const TriangleMesh& mesh, std::uint32_t triangle, const Vec3<double>& point) {
  Weights weights;
  const Vec3<double>& corner = mesh.corner(triangle, 0);
  const Vec3<double> a = mesh.corner(triangle, 1) - corner, b = mesh.corner(triangle, 2) - corner;
  // Along units of the longest side, no product leaves the range of double.
  const double size = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  if (!(size > 0)) return weights;
  const Vec3<double> p = a / size, q = b / size, r = (point - corner) / size;
  const double pp = p.squaredNorm(), pq = p.dot(q), qq = q.squaredNorm();
  const double determinant = pp * qq - pq * pq;
  if (!(determinant > 0)) return weights;
  const Vec3<double> along_p = (qq * p - pq * q) / determinant,
                     along_q = (pp * q - pq * p) / determinant;
  double second = std::clamp(along_p.dot(r), 0.0, 1.0);
  double third = std::clamp(along_q.dot(r), 0.0, 1.0);
  if (const double sum = second + third; sum > 1) {
    second /= sum;
    third /= sum;
  }
  weights.at = {1 - second - third, second, third};
  weights.slopes = {along_p / size, along_q / size};
  return weights;
}

const Numbers* numbers_of(const std::vector<Numbers>& of, std::uint32_t triangle) {
  if (triangle >= of.size() || of[triangle][0] == MeshAttributes::none) return nullptr;
  return &of[triangle];
}

}  // namespace

MeshPoint mesh_point(const TriangleMesh& mesh, const MeshAttributes& attributes,
                     std::uint32_t triangle, const Vec3<double>& point) {
  MeshPoint found;
  const Numbers* normals = numbers_of(attributes.normal_of, triangle);
  const Numbers* uvs = numbers_of(attributes.uv_of, triangle);
  if (!normals && !uvs) return found;
  const Weights weights = weights_of(mesh, triangle, point);
  if (normals) {
    Vec3<double> sum = Vec3<double>::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      sum += weights.at[k] * attributes.normals[(*normals)[k]].cast<double>();
    // Opposite normals leave none.
    constexpr double least_length = 1e-6;
    if (sum.norm() > least_length) found.normal = unit<double>(sum);
  }
  if (uvs) {
    std::array<Vec3<double>, 3> at;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<float, 2>& uv = attributes.uvs[(*uvs)[k]];
      at[k] = {double{uv[0]}, double{uv[1]}, 0};
      found.uv += weights.at[k] * at[k];
    }
    for (int i = 0; i < 2; ++i)
      found.uv_slopes[static_cast<std::size_t>(i)] =
          (at[1][i] - at[0][i]) * weights.slopes[0] + (at[2][i] - at[0][i]) * weights.slopes[1];
    found.has_uv = true;
  }
  return found;
}

Vec3<double> way_to_smooth(const TriangleMesh& mesh, const MeshAttributes& attributes,
                           std::uint32_t triangle, const Vec3<double>& point,
                           const Mat3<double>& to_mesh, bool is_back) {
  Vec3<double> way = Vec3<double>::Zero();
  const Numbers* normals = numbers_of(attributes.normal_of, triangle);
  if (!normals) return way;
  const Weights weights = weights_of(mesh, triangle, point);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3<double> n = (is_back ? -1 : 1) * attributes.normals[(*normals)[k]].cast<double>();
    const double gap = n.dot(mesh.corner(triangle, k) - point);
    // The plane's normal in the other frame, times the factor by which gaps are larger here.
    const Vec3<double> outer = to_mesh.transpose() * n;
    if (gap > 0) way += weights.at[k] * gap / outer.squaredNorm() * outer;
  }
  return way;
}

Vec3<double> seen_normal(const Vec3<double>& normal, const Vec3<double>& direction, bool leaves) {
  const Vec3<double> towards = leaves ? direction : Vec3<double>(-direction);
  const double cosine = normal.dot(towards);
  if (cosine >= least_seen_cosine) return normal;
  return unit<double>(normal + (least_seen_cosine - cosine) * towards);
}

}  // namespace minkray
