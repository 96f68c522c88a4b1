// SPDX-License-Identifier: MIT
#include <exception>

#include "core/files/mesh_file.h"
#include "core/geometry/point_cloud.h"
#include "tests/fuzz/hull_rounding.h"
#include "tests/fuzz/target.h"
#include "tests/support/random.h"

namespace minkray::fuzz {
namespace {

std::string check_hull(const std::vector<Vec3<double>>& vertices) {
  double largest = 0;
  for (const Vec3<double>& v : vertices) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  const PointCloud hull(vertices);
  if (hull.points().size() > vertices.size()) return "a hull of more points than were given";
  testing::Random random(1);
  for (int i = 0; i < 64; ++i) {
    const Vec3<double> n = i < 3 ? Vec3<double>(Vec3<double>::Unit(i)) : random.direction();
    const Vec3<double> s = hull.support(n);
    for (const Vec3<double>& v : vertices) {
      // Halves, so that no difference overflows.
      const double beyond = n.dot(v * 0.5 - s * 0.5);
      if (!(beyond <= hull_rounding * largest)) return "a vertex lies outside of the hull";
    }
  }
  return "";
}

}  // namespace

std::string check_mesh(std::string_view bytes) {
  if (bytes.empty()) return "";
  const MeshFormat format = bytes[0] & 1 ? MeshFormat::obj : MeshFormat::stl;
  std::vector<Vec3<double>> vertices;
  try {
    vertices = mesh_vertices(bytes.substr(1), format);
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    return message.empty() || message.find('\n') != std::string::npos ? "a bad message" : "";
  }
  if (vertices.empty()) return "no vertices, and no message";
  for (const Vec3<double>& v : vertices)
    if (!v.allFinite()) return "a vertex that is not finite";
  return check_hull(vertices);
}

}  // namespace minkray::fuzz
