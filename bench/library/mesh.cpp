// SPDX-License-Identifier: MIT
#include "mesh.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "hull_facets.h"

namespace bench {
namespace {

using Index = std::uint32_t;
constexpr double pi = std::numbers::pi;

/// Collects triangles of points. Equal points become one vertex, and triangles without area are
/// left out: a rounded box of extents 0 is a sphere that way.
class Builder {
 public:
  explicit Builder(const Vec& inside) : inside_(inside) {}

  void triangle(const Vec& a, const Vec& b, const Vec& c) {
    const Index i = vertex(a), j = vertex(b), k = vertex(c);
    if (i == j || j == k || k == i) return;
    const bool inwards = dot(cross(b - a, c - a), a - inside_) < 0;
    mesh_.triangles.push_back({i, inwards ? k : j, inwards ? j : k});
  }
  void quad(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  Mesh take() { return std::move(mesh_); }

 private:
  /// Points are equal that are equal as floats; + 0 makes 0 of -0.
  Index vertex(const Vec& p) {
    const std::array<float, 3> key = {static_cast<float>(p.x) + 0.0f,
                                      static_cast<float>(p.y) + 0.0f,
                                      static_cast<float>(p.z) + 0.0f};
    const auto [at, is_new] = index_.try_emplace(key, static_cast<Index>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(p);
    return at->second;
  }

  Vec inside_;
  Mesh mesh_;
  std::map<std::array<float, 3>, Index> index_;
};

/// The direction i, j, k steps (their sum is `steps`) from the axes of the first octant.
Vec octant_direction(int i, int j, int steps) {
  const auto along = [&](int n) { return n == 0 ? 0 : std::sin(pi / 2 * n / steps); };
  return normalized({along(i), along(j), along(steps - i - j)});
}

double& entry(Vec& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
double entry(const Vec& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Every second point of a convex polygon is cut off, until a triangle is left: no long fans.
void add_polygon(Builder& builder, std::vector<Vec> ring) {
  while (ring.size() > 2) {
    std::vector<Vec> next;
    for (std::size_t i = 0; i < ring.size(); i += 2) {
      next.push_back(ring[i]);
      if (i + 1 < ring.size()) builder.triangle(ring[i], ring[i + 1], ring[(i + 2) % ring.size()]);
    }
    ring = std::move(next);
  }
}

/// Measures the error; throws if the mesh is not a closed surface within the shape.
void measure(Mesh& mesh, const mk::Shape& shape) {
  std::set<std::pair<Index, Index>> edges;
  double deepest = 0, size = 0;
  mesh.error = 0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i)
      if (!edges.insert({t[i], t[(i + 1) % 3]}).second)
        throw std::runtime_error("mesh: an edge has two triangles on one side");
    const Vec a = mesh.vertices[t[0]];
    const Vec n = normalized(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
    const double gap = dot(n, Vec(shape.support(n)) - a);
    mesh.error = std::max(mesh.error, gap);
    deepest = std::min(deepest, gap);
    size = std::max(size, norm(a));
  }
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from})) throw std::runtime_error("mesh: not closed");
  // Slivers of a cylinder's end have normals that rounding turns by 1e-9.
  constexpr double rounding = 1e-8;
  if (deepest < -rounding * size) throw std::runtime_error("mesh: not within the shape");
}

}  // namespace

Mesh mesh_of_rounded_box(const Vec& half_extents, double r, int steps) {
  Builder builder({});
  for (int octant = 0; octant < 8; ++octant) {
    const Vec sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
    const auto at = [&](int i, int j) {
      return scaled(sign, half_extents + r * octant_direction(i, j, steps));
    };
    for (int i = 0; i < steps; ++i)
      for (int j = 0; i + j < steps; ++j) {
        builder.triangle(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < steps) builder.triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  // Strips along the edges, and faces.
  for (int axis = 0; axis < 3; ++axis)
    for (int quarter = 0; quarter < 4; ++quarter) {
      const auto at = [&](int step, double side) {
        Vec d = octant_direction(0, step, steps);  // has no x
        Vec turned, sign;
        entry(turned, (axis + 1) % 3) = d.y;
        entry(turned, (axis + 2) % 3) = d.z;
        entry(sign, axis) = side;
        entry(sign, (axis + 1) % 3) = quarter & 1 ? -1 : 1;
        entry(sign, (axis + 2) % 3) = quarter & 2 ? -1 : 1;
        return scaled(sign, half_extents + r * turned);
      };
      for (int step = 0; step < steps; ++step)
        builder.quad(at(step, -1), at(step + 1, -1), at(step + 1, 1), at(step, 1));
    }
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto at = [&](double u, double v) {
        Vec p;
        entry(p, axis) = side * (entry(half_extents, axis) + r);
        entry(p, (axis + 1) % 3) = u * entry(half_extents, (axis + 1) % 3);
        entry(p, (axis + 2) % 3) = v * entry(half_extents, (axis + 2) % 3);
        return p;
      };
      builder.quad(at(-1, -1), at(1, -1), at(1, 1), at(-1, 1));
    }
  return builder.take();
}

Mesh mesh_of_frustum(double r_below, double r_above, double half_height, int sides) {
  Builder builder({});
  std::vector<Vec> below, above;
  for (int i = 0; i < sides; ++i) {
    const double c = std::cos(2 * pi * i / sides), s = std::sin(2 * pi * i / sides);
    below.push_back({r_below * c, r_below * s, -half_height});
    above.push_back({r_above * c, r_above * s, half_height});
  }
  for (std::size_t i = 0, n = below.size(); i < n; ++i)
    builder.quad(below[i], below[(i + 1) % n], above[(i + 1) % n], above[i]);
  add_polygon(builder, below);
  add_polygon(builder, above);
  return builder.take();
}

Mesh mesh_of_hull(const std::vector<Vec>& points) {
  Mesh mesh;
  mesh.vertices = points;
  mesh.triangles = hull_facets(points);
  return mesh;
}

Mesh coarsest(const MeshMaker& make, const mk::Shape& shape, double error) {
  constexpr int first = 4, most = 4096;
  const auto made = [&](int steps) {
    Mesh mesh = make(steps);
    measure(mesh, shape);
    return mesh;
  };
  int steps = first;
  Mesh mesh = made(steps);
  while (mesh.error > error) {
    // The error falls with the square of the steps.
    const double finer = std::min(4.0, std::sqrt(mesh.error / error));
    steps = std::max(steps + 1, static_cast<int>(std::floor(steps * finer)));
    if (steps > most) throw std::runtime_error("mesh: does not come near the shape");
    mesh = made(steps);
  }
  while (steps > first) {
    Mesh coarser = made(steps - 1);
    if (coarser.error > error) break;
    mesh = std::move(coarser);
    --steps;
  }
  return mesh;
}

}  // namespace bench
