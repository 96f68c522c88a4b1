// SPDX-License-Identifier: MIT
#include "core/derived/sandwich.h"

#include <numbers>
#include <stdexcept>

namespace minkray {
namespace {

using Points = std::vector<Vec3<double>>;

/// A support point in the frame: m.q = n.(x - origin) for the direction n = axes (m / extents).
struct Support {
  Vec3<double> m;  ///< of unit length
  Vec3<double> q;  ///< the support point
};

Support support_in(const RoundFrame& frame, const Shape& shape, const Vec3<double>& m) {
  const Vec3<double> relative = frame.extents / frame.extents.minCoeff();
  const Vec3<double> n = frame.axes * m.cwiseQuotient(relative);
  return {m, frame.to_frame(shape.support(n))};
}

/// Returns evenly spread directions in the space, plane or line of this rank, and the directions of
/// the axes.
Points first_directions(int rank, int n) {
  Points directions;
  if (rank == 3) directions = even_directions(n);
  if (rank == 2)
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / n;
      directions.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
  for (int axis = 0; axis < rank; ++axis)
    for (const double sign : {1.0, -1.0}) directions.push_back(sign * Vec3<double>::Unit(axis));
  return directions;
}

/// Returns the frame of the shape's support points. Directions must be evenly spread in the shape's
/// own frame to find the true extents of a thin shape, so the frame is computed repeatedly, each
/// time from directions in the previous one.
RoundFrame frame_of(const Shape& shape, double flatness) {
  constexpr int directions = 200, rounds = 3;
  RoundFrame frame;
  frame.extents = Vec3<double>::Ones();
  for (int round = 0; round < rounds; ++round) {
    Points points;
    for (const Vec3<double>& m : first_directions(3, directions))
      points.push_back(frame.from_frame(support_in(frame, shape, m).q));
    frame = round_frame(points, flatness);
    if (frame.rank < 2) break;
  }
  return frame;
}

Vec3<double> corner(const ConvexHull& hull, const Points& points, std::uint32_t index) {
  return points[hull.vertices[index]];
}

/// Returns the normals of the facets or, for a polygon, of its edges.
Points facet_normals(const ConvexHull& hull, const Points& points) {
  Points normals;
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const auto corners = hull.facets[f];
    const auto p = [&](std::size_t i) { return corner(hull, points, corners[i % corners.size()]); };
    if (hull.rank() == 2)
      for (std::size_t i = 0; i < corners.size(); ++i)
        normals.push_back((p(i + 1) - p(i)).cross(Vec3<double>::UnitZ()));
    Vec3<double> normal = Vec3<double>::Zero();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      normal += (p(i) - p(0)).cross(p(i + 1) - p(0));
    if (hull.rank() == 3) normals.push_back(normal);
  }
  std::erase_if(normals, [](const Vec3<double>& n) { return !(n.norm() > 0); });
  for (Vec3<double>& n : normals) n.normalize();
  return normals;
}

Mesh mesh_of(const Points& points) {
  const ConvexHull hull = convex_hull(points);
  Mesh mesh;
  for (const std::uint32_t v : hull.vertices) mesh.vertices.push_back(points[v]);
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const auto corners = hull.facets[f];
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      mesh.triangles.push_back({corners[0], corners[i], corners[i + 1]});
  }
  return mesh;
}

Mesh box_mesh(const Vec3<double>& lower, const Vec3<double>& upper) {
  Points corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(),
                         (i & 4 ? upper : lower).z());
  return mesh_of(corners);
}

/// Returns the vertices of an intersection of half-planes. Each vertex is dual to an edge of the
/// dual polygon.
Points polygon_vertices(const std::vector<HalfSpace>& half_planes, const Vec3<double>& interior) {
  Points dual;
  for (const HalfSpace& half_plane : half_planes)
    dual.push_back(half_plane.normal / (half_plane.offset - half_plane.normal.dot(interior)));
  const ConvexHull hull = convex_hull(dual);
  if (hull.rank() != 2) throw std::runtime_error("half-planes: not a bounded polygon");
  Points vertices;
  const auto corners = hull.facets[0];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3<double> a = corner(hull, dual, corners[i]);
    const Vec3<double> b = corner(hull, dual, corners[(i + 1) % corners.size()]);
    const Vec3<double> edge = b - a;
    const Vec3<double> normal(edge.y(), -edge.x(), 0);
    vertices.push_back(interior + normal / normal.dot(a));
  }
  return vertices;
}

}  // namespace

std::vector<Vec3<double>> even_directions(int n) {
  Points directions;
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z);
    directions.emplace_back(r * std::cos(turn * i), r * std::sin(turn * i), z);
  }
  return directions;
}

Sandwich sandwich_of(const Shape& shape, const SandwichOptions& options) {
  Sandwich sandwich;
  RoundFrame& frame = sandwich.frame;
  frame = frame_of(shape, options.flatness);
  const int rank = frame.rank;
  const double margin = options.margin;

  std::vector<Support> supports;
  Points points;
  Vec3<double> sum = Vec3<double>::Zero();
  const auto ask = [&](const Points& directions) {
    for (const Vec3<double>& m : directions) {
      supports.push_back(support_in(frame, shape, m));
      points.push_back(supports.back().q);
      if (rank < 3) points.back().tail(3 - rank).setZero();
    }
  };
  ask(first_directions(rank, options.directions));
  if (rank == 0) points.push_back(Vec3<double>::Zero());
  // The centre is the mean support point. Over all directions this is the Steiner point, which is
  // inside.
  for (const Vec3<double>& q : points) sum += q;
  const Vec3<double> centre = sandwich.centre = sum / static_cast<double>(points.size());

  if (rank < 2) {
    Vec3<double> lower = centre, upper = centre;
    for (const Vec3<double>& q : points) lower = lower.cwiseMin(q), upper = upper.cwiseMax(q);
    const Vec3<double> width = Vec3<double>::Constant(margin);
    sandwich.outer = box_mesh(lower - width, upper + width);
    return sandwich;
  }

  const ConvexHull first = convex_hull(points);
  ask(facet_normals(first, points));

  // Shrinks the inner mesh by `margin`. If a ball of radius rho around the centre is inside the
  // shape, moving a point towards the centre by the fraction margin / rho leaves a ball of radius
  // `margin` around the point inside the shape.
  const Points& inner_points = points;
  const ConvexHull hull = convex_hull(inner_points);
  double rho = std::numeric_limits<double>::infinity();
  for (const Vec3<double>& normal : facet_normals(hull, inner_points)) {
    double furthest = -rho;
    for (const Vec3<double>& q : inner_points)
      furthest = std::max(furthest, normal.dot(q - centre));
    rho = std::min(rho, furthest);
  }
  Points shrunk;
  for (const std::uint32_t v : hull.vertices)
    shrunk.push_back(centre + (1 - margin / rho) * (inner_points[v] - centre));
  sandwich.inner = mesh_of(shrunk);

  std::vector<HalfSpace> half_spaces;
  for (const Support& support : supports) {
    Vec3<double> m = support.m;
    half_spaces.push_back({m, m.dot(support.q) + margin});
  }
  sandwich.outer = mesh_of(rank == 3 ? intersection_vertices(half_spaces, centre)
                                     : polygon_vertices(half_spaces, centre));
  return sandwich;
}

}  // namespace minkray
