// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "bench/league/query.h"

namespace league {

Vec Solid::placed(const Vec& p) const {
  const Vec q = mapped(turn, p);
  return {q[0] + at[0], q[1] + at[1], q[2] + at[2]};
}

Vec Solid::support(const Vec& direction) const {
  const Vec n = {turn[0][0] * direction[0] + turn[1][0] * direction[1] + turn[2][0] * direction[2],
                 turn[0][1] * direction[0] + turn[1][1] * direction[1] + turn[2][1] * direction[2],
                 turn[0][2] * direction[0] + turn[1][2] * direction[1] + turn[2][2] * direction[2]};
  const double length = std::sqrt(dot(n, n)), side = std::hypot(n[0], n[1]);
  Vec p = {};
  const auto rim = [&](double radius) {
    if (side > 0) p[0] = radius * n[0] / side, p[1] = radius * n[1] / side;
  };
  switch (kind) {
    case Kind::hull:
      p = *std::max_element(points.begin(), points.end(),
                            [&](const Vec& u, const Vec& v) { return dot(u, n) < dot(v, n); });
      break;
    case Kind::box:
      for (std::size_t k = 0; k < 3; ++k) p[k] = std::copysign(sizes[k], n[k]);
      break;
    case Kind::sphere:
    case Kind::capsule:
      if (length > 0)
        for (std::size_t k = 0; k < 3; ++k) p[k] = sizes[0] * n[k] / length;
      if (kind == Kind::capsule) p[2] += std::copysign(sizes[1], n[2]);
      break;
    case Kind::ellipsoid: {
      const double stretched = std::hypot(sizes[0] * n[0], sizes[1] * n[1], sizes[2] * n[2]);
      if (stretched > 0)
        for (std::size_t k = 0; k < 3; ++k) p[k] = sizes[k] * sizes[k] * n[k] / stretched;
      break;
    }
    case Kind::disk:
    case Kind::cylinder:
      rim(sizes[0]);
      p[2] = kind == Kind::disk ? 0 : std::copysign(sizes[1], n[2]);
      break;
    case Kind::cone:
    case Kind::frustum: {
      const double above = kind == Kind::cone ? 0 : sizes[2];
      const bool top = above * side + sizes[1] * n[2] > sizes[0] * side - sizes[1] * n[2];
      rim(top ? above : sizes[0]);
      p[2] = top ? sizes[1] : -sizes[1];
      break;
    }
  }
  return placed(p);
}

Answer at_distance(double distance) {
  if (!std::isfinite(distance)) return failed("the distance is not a number");
  return {distance > 0 ? Answer::Status::separated : Answer::Status::overlapping, distance};
}

std::vector<std::array<int, 3>> hull_triangles(const std::vector<Vec>& points) {
  std::vector<std::array<int, 3>> triangles;
  const int count = static_cast<int>(points.size());
  const auto at = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  double size = 0;
  for (const Vec& p : points)
    size = std::max({size, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  const double flat = 1e-9 * size * size * size;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      for (int k = 0; k < count; ++k) {
        if (j <= i || k <= i || j == k) continue;
        const Vec o = at(i), p = at(j), q = at(k);
        const Vec e = {p[0] - o[0], p[1] - o[1], p[2] - o[2]},
                  f = {q[0] - o[0], q[1] - o[1], q[2] - o[2]};
        const Vec n = {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2],
                       e[0] * f[1] - e[1] * f[0]};
        if (dot(n, n) <= flat * flat / (size * size)) continue;
        const bool outside = std::any_of(points.begin(), points.end(), [&](const Vec& r) {
          return dot(n, {r[0] - o[0], r[1] - o[1], r[2] - o[2]}) > flat;
        });
        if (!outside) triangles.push_back({i, j, k});
      }
  return triangles;
}

Vec quaternion_xyz(const Rows& m, double& w) {
  const double trace = m[0][0] + m[1][1] + m[2][2];
  if (trace > 0) {
    const double s = 2 * std::sqrt(trace + 1);
    w = s / 4;
    return {(m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s};
  }
  std::size_t i = 0;
  if (m[1][1] > m[0][0]) i = 1;
  if (m[2][2] > m[i][i]) i = 2;
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  const double s = 2 * std::sqrt(1 + m[i][i] - m[j][j] - m[k][k]);
  Vec q = {};
  q[i] = s / 4;
  q[j] = (m[j][i] + m[i][j]) / s;
  q[k] = (m[k][i] + m[i][k]) / s;
  w = (m[k][j] - m[j][k]) / s;
  return q;
}

}  // namespace league
