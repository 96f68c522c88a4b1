// SPDX-License-Identifier: MIT
// Closed meshes of triangles, with slivers and corners of many triangles.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace minkray::testing {

struct Surface {
  std::vector<Vec3<double>> vertices;
  std::vector<Corners> triangles;

  TriangleMesh mesh() const { return {vertices, triangles}; }
  std::shared_ptr<const TriangleMesh> shared() const {
    return std::make_shared<const TriangleMesh>(vertices, triangles);
  }
};

/// Squares of rows of vertices, each cut in two, counter-clockwise where rows go along x and their
/// vertices along y.
inline void add_squares(Surface& to, std::uint32_t rows, std::uint32_t in_row, bool is_ring) {
  const std::uint32_t last = is_ring ? rows : rows - 1;
  for (std::uint32_t i = 0; i < last; ++i)
    for (std::uint32_t j = 0; j < in_row; ++j) {
      const std::uint32_t next = (i + 1) % rows, beside = (j + 1) % in_row;
      const std::uint32_t a = i * in_row + j, b = next * in_row + j, c = next * in_row + beside,
                          d = i * in_row + beside;
      to.triangles.push_back({a, b, c});
      to.triangles.push_back({a, c, d});
    }
}

inline Surface torus(std::uint32_t around, std::uint32_t across) {
  Surface torus;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = 1 + 0.4 * std::cos(v);
      torus.vertices.emplace_back(r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v));
    }
  add_squares(torus, around, across, true);
  return torus;
}

/// Latitudes are close together in places, longitudes meet at the poles.
inline Surface bumpy_ball(std::uint32_t rings, std::uint32_t around) {
  Surface ball;
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      double s = (i + 1.0) / (rings + 1);
      s += 0.02 * std::sin(16 * std::numbers::pi * s);
      const double u = std::numbers::pi * s, v = 2 * std::numbers::pi * j / around;
      const double r = 1 + 0.1 * std::sin(5 * u) * std::cos(3 * v);
      ball.vertices.emplace_back(r * std::sin(u) * std::cos(v), r * std::sin(u) * std::sin(v),
                                 r * std::cos(u));
    }
  add_squares(ball, rings, around, false);
  const auto north = static_cast<std::uint32_t>(ball.vertices.size()), south = north + 1;
  ball.vertices.emplace_back(0, 0, 1.1);
  ball.vertices.emplace_back(0, 0, -1.1);
  for (std::uint32_t j = 0; j < around; ++j) {
    const std::uint32_t beside = (j + 1) % around, last = (rings - 1) * around;
    ball.triangles.push_back({north, j, beside});
    ball.triangles.push_back({south, last + beside, last + j});
  }
  return ball;
}

inline Surface block(const Vec3<double>& half) {
  Surface block;
  for (std::uint32_t i = 0; i < 8; ++i)
    block.vertices.emplace_back(i & 1u ? half.x() : -half.x(), i & 2u ? half.y() : -half.y(),
                                i & 4u ? half.z() : -half.z());
  block.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return block;
}

}  // namespace minkray::testing
