// SPDX-License-Identifier: MIT
// Closed meshes whose vertices are multiples of 2^-26, so that points of edges, and rays through
// them, have exact coordinates. No coordinate is above 1.5.
#pragma once

#include <minkray/minkray.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace minkray::testing {

inline Vec3 plus(const Vec3& a, const Vec3& b, double times = 1) {
  return {a.x + times * b.x, a.y + times * b.y, a.z + times * b.z};
}
inline Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) {
  return std::sqrt(dot(a, a));
}
/// Rounds to multiples of 2^-26.
inline Vec3 on_grid(const Vec3& a) {
  const auto round = [](double x) { return std::ldexp(std::nearbyint(std::ldexp(x, 26)), -26); };
  return {round(a.x), round(a.y), round(a.z)};
}

/// Random numbers with equal results everywhere.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double uniform(double least, double most) {
    return least + (most - least) * std::ldexp(static_cast<double>(engine_() >> 11u), -53);
  }
  std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(engine_() % count); }
  /// Whole numbers from -most to most.
  int whole(int most) {
    return static_cast<int>(below(2 * static_cast<std::size_t>(most) + 1)) - most;
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      const double size = length(v);
      if (size > 0.1 && size < 1) return {v.x / size, v.y / size, v.z / size};
    }
  }

 private:
  std::mt19937_64 engine_;
};

struct GridMesh {
  std::string name;
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside
  bool is_torus = false;

  Vec3 corner(std::size_t triangle, std::size_t k) const {
    return vertices[triangles[triangle][k % 3]];
  }
  Vec3 normal(std::size_t triangle) const {
    const Vec3 a = corner(triangle, 0);
    return cross(minus(corner(triangle, 1), a), minus(corner(triangle, 2), a));
  }
  /// A point of the grid within the mesh, far from the surface.
  Vec3 point_within(Dice& dice) const {
    const Vec3 from_middle = dice.direction();
    if (!is_torus) return on_grid(plus({}, from_middle, dice.uniform(0, 0.5)));
    const double u = dice.uniform(0, 2 * std::numbers::pi);
    return on_grid(plus({std::cos(u), std::sin(u), 0}, from_middle, dice.uniform(0, 0.15)));
  }
};

/// Joins rows of vertices by triangles and makes them face outwards.
inline void close_mesh(GridMesh& mesh, std::uint32_t rows, std::uint32_t in_row, bool is_ring) {
  for (std::uint32_t i = 0; i < (is_ring ? rows : rows - 1); ++i)
    for (std::uint32_t j = 0; j < in_row; ++j) {
      const std::uint32_t next = (i + 1) % rows, beside = (j + 1) % in_row;
      const std::uint32_t a = i * in_row + j, b = next * in_row + j, c = next * in_row + beside;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, i * in_row + beside});
    }
  double volume = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    volume += dot(mesh.normal(i), mesh.corner(i, 0));
  if (volume < 0)
    for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
}

/// A ring of slivers where it has many more steps around than across.
inline GridMesh grid_torus(std::uint32_t around, std::uint32_t across) {
  GridMesh mesh;
  mesh.is_torus = true;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = 1 + 0.4 * std::cos(v);
      mesh.vertices.push_back(on_grid({r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)}));
    }
  close_mesh(mesh, around, across, true);
  mesh.name = "torus of " + std::to_string(mesh.triangles.size()) + " slivers";
  return mesh;
}

/// A bumpy ball with latitudes close together in places and poles of `around` triangles.
inline GridMesh grid_ball(std::uint32_t rings, std::uint32_t around) {
  GridMesh mesh;
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      double s = (i + 1.0) / (rings + 1);
      s += 0.019 * std::sin(16 * std::numbers::pi * s);
      const double u = std::numbers::pi * s, v = 2 * std::numbers::pi * j / around;
      const double r = 1 + 0.1 * std::sin(5 * u) * std::cos(3 * v);
      mesh.vertices.push_back(
          on_grid({r * std::sin(u) * std::cos(v), r * std::sin(u) * std::sin(v), r * std::cos(u)}));
    }
  const auto north = static_cast<std::uint32_t>(mesh.vertices.size()), south = north + 1;
  mesh.vertices.push_back({0, 0, 1});
  mesh.vertices.push_back({0, 0, -1});
  for (std::uint32_t j = 0; j < around; ++j) {
    const std::uint32_t beside = (j + 1) % around, last = (rings - 1) * around;
    mesh.triangles.push_back({north, j, beside});
    mesh.triangles.push_back({south, last + beside, last + j});
  }
  close_mesh(mesh, rings, around, false);
  mesh.name = "ball of " + std::to_string(mesh.triangles.size());
  return mesh;
}

}  // namespace minkray::testing
