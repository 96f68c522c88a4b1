// SPDX-License-Identifier: MIT
// Rays through exact points of a closed mesh of the grid: its vertices, edges and planes.
#pragma once

#include <optional>

#include "tests/proof/grid_meshes.h"

namespace minkray::testing {

/// From within the mesh towards its surface, which is met at t = 1 or before.
struct InnerRay {
  Ray ray;
  bool is_exact = true;  ///< the ray passes exactly through the surface at t = 1
};

/// A line through a point of the surface: from one end, from the other, and both ways from a point
/// between.
struct Line {
  std::array<Ray, 4> rays;
  double t_at_point = 0;  ///< along the first two rays, exact
};

class RaysAtMesh {
 public:
  RaysAtMesh(const GridMesh& mesh, std::uint64_t seed) : mesh_(mesh), dice_(seed) {}

  /// At vertices, along axes too, at points of edges, and past both by a few steps of the grid.
  InnerRay inner() {
    const std::uint32_t kind = dice_.below(5), triangle = random_triangle();
    Vec3 to = kind % 2 == 0 ? mesh_.corner(triangle, 0) : point_of_edge(triangle);
    if (kind == 4)
      if (const auto from = axis_within(to)) return {{*from, minus(to, *from)}};
    const bool is_past = kind == 2 || kind == 3;
    if (is_past) to = plus(to, {step(), step(), step()});
    const Vec3 from = mesh_.point_within(dice_);
    return {{from, minus(to, from)}, !is_past};
  }

  /// Any direction, along axes, along edges, in planes of triangles, at silhouettes.
  Line line() {
    const std::uint32_t kind = dice_.below(6), triangle = random_triangle();
    const Vec3 a = mesh_.corner(triangle, 0), ab = minus(mesh_.corner(triangle, 1), a),
               ac = minus(mesh_.corner(triangle, 2), a);
    Vec3 at = dice_.below(2) == 0 ? a : point_of_edge(triangle), d;
    if (kind == 0) {
      const double axis[3] = {0, 0, dice_.below(2) == 0 ? 1.0 : -1.0};
      const std::uint32_t shift = dice_.below(3);
      at = a;
      d = {axis[shift], axis[(shift + 1) % 3], axis[(shift + 2) % 3]};
    } else if (kind == 1) {
      d = ab;
    } else if (kind == 2) {
      const double u = dice_.below(9), v = dice_.below(9);
      at = plus(plus(a, ab, u / 32), ac, v / 32);
      d = plus(plus({}, ab, dice_.whole(8)), ac, dice_.whole(8));
    } else if (kind == 3) {
      const Vec3 along = cross(mesh_.normal(triangle), dice_.direction());
      const double size = length(along);
      if (size > 0) d = on_grid({along.x / size, along.y / size, along.z / size});
    }
    if (length(d) == 0) d = on_grid(dice_.direction());
    // The ends are outside of the mesh: 4 from a point at most 1.5 from the middle.
    const double steps = std::ceil(4 / length(d));
    const double between = std::ceil(steps * (1 + dice_.uniform(-0.5, 0.5)) * 8) / 8;
    Line line;
    line.t_at_point = steps;
    const Vec3 first = plus(at, d, -steps), back = minus({}, d);
    const Vec3 middle = plus(at, d, between - steps);
    line.rays = {Ray{first, d}, Ray{plus(at, d, steps), back}, Ray{middle, d}, Ray{middle, back}};
    return line;
  }

 private:
  std::uint32_t random_triangle() { return dice_.below(mesh_.triangles.size()); }
  double step() { return std::ldexp(dice_.whole(3), -26); }

  Vec3 point_of_edge(std::uint32_t triangle) {
    const std::uint32_t k = dice_.below(3);
    const Vec3 a = mesh_.corner(triangle, k);
    return plus(a, minus(mesh_.corner(triangle, k + 1), a), dice_.below(65) / 64.0);
  }

  /// A point within the mesh in line with a vertex along an axis.
  std::optional<Vec3> axis_within(const Vec3& vertex) const {
    if (mesh_.is_torus) {
      if (vertex.z == 0) return std::nullopt;
      return Vec3{vertex.x, vertex.y, 0};
    }
    const double x = std::abs(vertex.x), y = std::abs(vertex.y), z = std::abs(vertex.z);
    Vec3 from = vertex;
    (x >= y && x >= z ? from.x : y >= z ? from.y : from.z) = 0;
    if (length(from) > 0.8) return std::nullopt;
    return from;
  }

  const GridMesh& mesh_;
  Dice dice_;
};

}  // namespace minkray::testing
