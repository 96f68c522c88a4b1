// SPDX-License-Identifier: MIT
#include "renderer/inspect/body_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "renderer/inspect/shape_mesh.h"
#include "renderer/json/number_json.h"

namespace minkray {
namespace {

using Cell = std::array<std::int64_t, 3>;

/// Cells from the middle to the mesh's furthest side, at first and at last.
constexpr double first_cells = 64, fewer = 0.75, least_cells = 2;

struct ShownMesh {
  std::vector<Vec3<double>> vertices;  ///< from the middle: means of cells
  std::vector<Corners> triangles;
};

Cell cell_of(const Vec3<double>& from_middle, double side) {
  const auto along = [&](int axis) {
    return static_cast<std::int64_t>(std::llround(from_middle[axis] / side));
  };
  return {along(0), along(1), along(2)};
}

/// Triangles with corners in three cells, each once.
ShownMesh shown_mesh_of(const TriangleMesh& mesh, const Vec3<double>& middle, double side) {
  ShownMesh shown;
  std::vector<double> counts;
  std::map<Cell, std::uint32_t> numbers;
  std::vector<std::uint32_t> number_of(mesh.vertices().size());
  for (std::size_t i = 0; i < number_of.size(); ++i) {
    const Vec3<double> vertex = mesh.vertices()[i] - middle;
    const auto next = static_cast<std::uint32_t>(counts.size());
    const auto [at, is_new] = numbers.try_emplace(cell_of(vertex, side), next);
    if (is_new) {
      shown.vertices.push_back(Vec3<double>::Zero());
      counts.push_back(0);
    }
    number_of[i] = at->second;
    shown.vertices[at->second] += vertex;
    ++counts[at->second];
  }
  for (std::size_t i = 0; i < counts.size(); ++i) shown.vertices[i] /= counts[i];
  std::set<Corners> known;
  for (const Corners& corners : mesh.triangles()) {
    Corners of_cells = {number_of[corners[0]], number_of[corners[1]], number_of[corners[2]]};
    Corners sorted = of_cells;
    std::ranges::sort(sorted);
    if (sorted[0] == sorted[1] || sorted[1] == sorted[2] || !known.insert(sorted).second) continue;
    shown.triangles.push_back(of_cells);
  }
  return shown;
}

}  // namespace

Json body_json(const TriangleMesh& mesh, std::size_t most_triangles) {
  const Vec3<double> middle = mesh.bounds().centre();
  const double reach = mesh.bounds().reach_of_centre().maxCoeff();
  const bool is_coarse = mesh.size() > most_triangles;
  double cells = is_coarse ? first_cells : mesh_steps;
  ShownMesh shown = shown_mesh_of(mesh, middle, reach / cells);
  while (shown.triangles.size() > most_triangles && cells > least_cells) {
    cells *= fewer;
    shown = shown_mesh_of(mesh, middle, reach / cells);
  }
  const double scale = reach / mesh_steps;
  Json vertices = Json::array(), triangles = Json::array();
  for (const Vec3<double>& vertex : shown.vertices)
    for (const std::int64_t x : cell_of(vertex, scale)) vertices.push_back(x);
  for (const Corners& corners : shown.triangles)
    for (const std::uint32_t corner : corners) triangles.push_back(corner);
  return {{"v", std::move(vertices)},
          {"t", std::move(triangles)},
          {"scale", number_json(scale)},
          {"middle", point_json(middle)},
          {"coarse", is_coarse}};
}

Json triangle_json(const TriangleMesh& mesh, std::uint32_t triangle, const Vec3<double>& middle,
                   double radius) {
  const double scale = (radius > 0 ? radius : 1) / mesh_steps;
  Json vertices = Json::array();
  for (std::size_t k = 0; k < 3; ++k)
    for (const std::int64_t x : cell_of(mesh.corner(triangle, k) - middle, scale))
      vertices.push_back(x);
  const Json flat = {{"v", std::move(vertices)}, {"t", Json::array({0, 1, 2})}};
  return {{"rank", 2}, {"scale", number_json(scale)}, {"inner", flat}, {"outer", flat}};
}

}  // namespace minkray
