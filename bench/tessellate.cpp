// SPDX-License-Identifier: MIT
#include "bench/tessellate.h"

#include <numbers>

#include "core/derived/shape_bounds.h"
#include "core/geometry/convex_hull.h"
#include "core/support/surface.h"

namespace minkray::bench {
namespace {

using Index = std::uint32_t;
constexpr double pi = std::numbers::pi;

/// Points of the unit sphere and triangles between them.
struct Grid {
  std::vector<Vec3<double>> directions;
  std::vector<std::array<Index, 3>> triangles;
};

/// Rows of directions between the poles. Shapes' rims and faces have their normals on the poles
/// and the coordinate planes: rows and columns are half a step off them.
Grid latitudes(int fineness) {
  Grid grid;
  const int columns = 2 * fineness, rows = fineness;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double phi = 2 * pi * (i + 0.5) / columns, theta = pi * (j + 0.5) / rows;
      grid.directions.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                   std::cos(theta));
    }
  const auto at = [&](int i, int j) { return static_cast<Index>(j * columns + i % columns); };
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      grid.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      grid.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  for (int i = 2; i < columns; ++i) {
    grid.triangles.push_back({at(0, 0), at(i - 1, 0), at(i, 0)});
    grid.triangles.push_back({at(0, rows - 1), at(i, rows - 1), at(i - 1, rows - 1)});
  }
  return grid;
}

/// An octahedron's eight faces, each in fineness^2 triangles of about the same size.
Grid octahedron(int fineness) {
  Grid grid;
  for (int octant = 0; octant < 8; ++octant) {
    const auto first = static_cast<Index>(grid.directions.size());
    const Vec3<double> sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
    for (int i = 0; i <= fineness; ++i)
      for (int j = 0; i + j <= fineness; ++j) {
        const auto along = [&](int steps) { return std::sin(pi / 2 * steps / fineness); };
        const Vec3<double> n(along(i), along(j), along(fineness - i - j));
        grid.directions.push_back(n.normalized().cwiseProduct(sign));
      }
    const auto at = [&](int i, int j) {
      return first + static_cast<Index>(i * (fineness + 1) - i * (i - 1) / 2 + j);
    };
    for (int i = 0; i < fineness; ++i)
      for (int j = 0; i + j < fineness; ++j) {
        grid.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < fineness)
          grid.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }
  return grid;
}

/// The normal for the grid's direction: where the shape is long it is less curved across, and a
/// superellipsoid's normals crowd where it is most curved.
Vec3<double> normal_for(const Shape& shape, const Vec3<double>& half,
                        const Vec3<double>& direction) {
  Vec3<double> n = direction;
  if (const auto* super = std::get_if<Superellipsoid>(&shape.kind))
    for (double& x : n) x = std::copysign(std::pow(std::abs(x), super->exponent - 1), x);
  return n.cwiseQuotient(half);
}

std::vector<Vec3<double>> support_points(const Shape& shape, const Grid& grid) {
  const Vec3<double> half = bounds_of(shape).half_extents();
  std::vector<Vec3<double>> points;
  points.reserve(grid.directions.size());
  for (const Vec3<double>& direction : grid.directions)
    points.push_back(shape.support(normal_for(shape, half, direction)));
  return points;
}

/// Leaves out triangles that have no area, turns the others outwards, and measures the error.
TriangleMesh mesh_of(const Shape& shape, const std::vector<Vec3<double>>& points,
                     const std::vector<std::array<Index, 3>>& triangles, double wanted_error) {
  const Vec3<double> centre = bounds_of(shape).centre();
  TriangleMesh mesh;
  for (const Vec3<double>& p : points) mesh.vertices.push_back(p.cast<float>());
  for (const auto& t : triangles) {
    const Vec3<double>&p = points[t[0]], e = points[t[1]] - p, f = points[t[2]] - p;
    const Vec3<double> n = e.cross(f);
    const double longest = std::max({e.norm(), f.norm(), (f - e).norm()}), area = n.norm();
    if (!(area > 1e-10 * longest * longest)) continue;
    const bool inwards = n.dot(p - centre) < 0;
    mesh.triangles.push_back({t[0], t[inwards ? 2 : 1], t[inwards ? 1 : 2]});
    // One that is lower than the error is no more than an edge, and its plane means nothing.
    if (!(area > wanted_error * longest)) continue;
    const Vec3<double> out = (inwards ? -n : n) / area;
    mesh.error = std::max(mesh.error, out.dot(shape.support(out) - p));
  }
  return mesh;
}

TriangleMesh hull_mesh(const Shape& shape, const Grid& grid, double wanted_error) {
  const std::vector<Vec3<double>> points = support_points(shape, grid);
  const ConvexHull hull = convex_hull(points);
  std::vector<Vec3<double>> corners;
  for (const auto vertex : hull.vertices) corners.push_back(points[vertex]);
  std::vector<std::array<Index, 3>> triangles;
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const auto facet = hull.facets[f];
    for (std::size_t i = 2; i < facet.size(); ++i)
      triangles.push_back({facet[0], facet[i - 1], facet[i]});
  }
  return mesh_of(shape, corners, triangles, wanted_error);
}

/// Makes it as fine as it takes: the error falls with the square of the fineness.
template <class Make>
TriangleMesh fine_enough(const Make& make, double error, std::size_t most_triangles) {
  int fineness = 48;
  TriangleMesh mesh = make(fineness);
  for (int step = 0; step < 6 && mesh.error > error; ++step) {
    const double finer = 1.02 * std::sqrt(mesh.error / error);
    const double most =
        std::sqrt(static_cast<double>(most_triangles) / static_cast<double>(mesh.triangles.size()));
    if (!(most > 1.01)) break;
    fineness = static_cast<int>(std::ceil(fineness * std::min({finer, most, 8.0})));
    mesh = {};
    mesh = make(fineness);
  }
  return mesh;
}

}  // namespace

TriangleMesh tessellate(const Shape& shape, double error, std::size_t most_triangles) {
  constexpr int many = 128;
  if (surface_of<double>(shape) == SurfaceKind::flat)
    return hull_mesh(shape, latitudes(many), error);

  const auto by_grid = [&](Grid (*grid_of)(int)) {
    return [&shape, error, grid_of](int fineness) {
      const Grid grid = grid_of(fineness);
      return mesh_of(shape, support_points(shape, grid), grid.triangles, error);
    };
  };
  // A coarse error shows which grid suits the shape.
  const double coarse = std::max(error, 1e-3 * bounds_of(shape).half_extents().norm());
  constexpr std::size_t few_triangles = 100'000;
  const TriangleMesh rows = fine_enough(by_grid(latitudes), coarse, few_triangles),
                     octants = fine_enough(by_grid(octahedron), coarse, few_triangles);
  const bool rows_do = rows.error <= coarse, octants_do = octants.error <= coarse;
  if (!rows_do && !octants_do)
    return fine_enough([&](int fineness) { return hull_mesh(shape, octahedron(fineness), error); },
                       error, most_triangles);
  const bool take_rows =
      rows_do && (!octants_do || rows.triangles.size() < octants.triangles.size());
  return fine_enough(by_grid(take_rows ? latitudes : octahedron), error, most_triangles);
}

}  // namespace minkray::bench
