// SPDX-License-Identifier: MIT
#include "bench/image/rounded_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/geometry/convex_hull.h"

namespace minkray::bench {
namespace {

using Index = std::uint32_t;
using V = Vec3<double>;

/// Points on the arc between two unit vectors.
V on_arc(const V& a, const V& b, double fraction) {
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  if (!(angle > 1e-9)) return (a + fraction * (b - a)).normalized();
  return (std::sin((1 - fraction) * angle) * a + std::sin(fraction * angle) * b) / std::sin(angle);
}

double angle_between(const V& a, const V& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Distance of the triangle of three unit vectors from the origin.
double least_distance(const V& a, const V& b, const V& c) {
  const V n = (b - a).cross(c - a).normalized();
  const V foot = n.dot(a) * n;
  const auto within = [&](const V& p, const V& q) { return n.dot((q - p).cross(foot - p)) >= 0; };
  if (within(a, b) && within(b, c) && within(c, a)) return n.dot(a);
  // Otherwise an edge is nearest, at its middle.
  return std::min({(a + b).norm(), (b + c).norm(), (c + a).norm()}) / 2;
}

/// The polytope that is rounded.
struct Core {
  std::vector<V> corners;
  std::vector<std::vector<Index>> facets;  ///< counter-clockwise from outside
  std::vector<V> normals;                  ///< of the facets
};

std::optional<Core> core_of(const Shape& shape) {
  Core core;
  if (const auto* box = std::get_if<Box>(&shape.kind)) {
    for (int i = 0; i < 8; ++i)
      core.corners.push_back(
          box->half_extents.cwiseProduct(V(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  } else if (const auto* hull = std::get_if<Hull>(&shape.kind)) {
    core.corners = hull->points.points();
  } else {
    return std::nullopt;
  }
  const ConvexHull hull = convex_hull(core.corners);
  if (hull.rank() != 3) return std::nullopt;
  std::vector<V> corners;
  for (const Index vertex : hull.vertices) corners.push_back(core.corners[vertex]);
  core.corners = std::move(corners);
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const auto facet = hull.facets[f];
    core.facets.emplace_back(facet.begin(), facet.end());
    V area = V::Zero();
    for (std::size_t i = 0; i < facet.size(); ++i)
      area += core.corners[facet[i]].cross(core.corners[facet[(i + 1) % facet.size()]]);
    core.normals.push_back(area.normalized());
  }
  return core;
}

/// Builds the mesh with arcs of at most `step` radians.
class Builder {
 public:
  Builder(const Core& core, double radius, double step)
      : core_(core), radius_(radius), step_(step) {}

  TriangleMesh build() {
    for (Index f = 0; f < core_.facets.size(); ++f) facet(f);
    for (Index f = 0; f < core_.facets.size(); ++f) strips(f);
    for (Index v = 0; v < core_.corners.size(); ++v) patch(v);
    return std::move(mesh_);
  }

 private:
  int segments(double angle, double step) const {
    return std::max(1, static_cast<int>(std::ceil(angle / step)));
  }

  Index add(Index corner, const V& direction) {
    mesh_.vertices.push_back((core_.corners[corner] + radius_ * direction).cast<float>());
    directions_.push_back(direction);
    return static_cast<Index>(mesh_.vertices.size() - 1);
  }
  /// The triangle is of a facet or a strip, or, `on_sphere`, of a corner's patch. The deepest point
  /// of either is what the error is.
  void triangle(Index a, Index b, Index c, bool on_sphere = false) {
    mesh_.triangles.push_back({a, b, c});
    if (!on_sphere) return;
    const double nearest = least_distance(directions_[a], directions_[b], directions_[c]);
    mesh_.error = std::max(mesh_.error, radius_ * (1 - nearest));
  }

  void facet(Index f) {
    const auto& loop = core_.facets[f];
    std::vector<Index> moved;
    for (const Index corner : loop) {
      moved.push_back(add(corner, core_.normals[f]));
      at_facet_[{f, corner}] = moved.back();
    }
    for (std::size_t i = 2; i < moved.size(); ++i) triangle(moved[0], moved[i - 1], moved[i]);
    for (std::size_t i = 0; i < loop.size(); ++i)
      facet_of_edge_[{loop[i], loop[(i + 1) % loop.size()]}] = f;
  }

  /// The points over `corner` from facet f's normal to facet g's, both ends with them; the same
  /// ones from g to f.
  std::vector<Index> arc(Index corner, Index f, Index g) {
    if (f > g) {
      std::vector<Index> points = arc(corner, g, f);
      std::reverse(points.begin(), points.end());
      return points;
    }
    auto& between = arcs_[{corner, f, g}];
    if (between.empty()) {
      const V &a = core_.normals[f], &b = core_.normals[g];
      const int count = segments(angle_between(a, b), step_);
      between.push_back(at_facet_.at({f, corner}));
      for (int i = 1; i < count; ++i)
        between.push_back(add(corner, on_arc(a, b, static_cast<double>(i) / count)));
      between.push_back(at_facet_.at({g, corner}));
    }
    return between;
  }

  void strips(Index f) {
    const auto& loop = core_.facets[f];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Index a = loop[i], b = loop[(i + 1) % loop.size()];
      const Index g = facet_of_edge_.at({b, a});
      if (g < f) continue;
      const std::vector<Index> at_a = arc(a, f, g), at_b = arc(b, f, g);
      for (std::size_t j = 1; j < at_a.size(); ++j) {
        const V across = directions_[at_a[j - 1]] + directions_[at_a[j]];
        mesh_.error = std::max(mesh_.error, radius_ * (1 - across.norm() / 2));
        triangle(at_a[j - 1], at_b[j], at_b[j - 1]);
        triangle(at_a[j - 1], at_a[j], at_b[j]);
      }
    }
  }

  /// The facets around a corner, counter-clockwise from outside.
  std::vector<Index> facets_around(Index corner) const {
    std::vector<Index> around;
    Index first = 0;
    while (std::find(core_.facets[first].begin(), core_.facets[first].end(), corner) ==
           core_.facets[first].end())
      ++first;
    Index f = first;
    do {
      around.push_back(f);
      const auto& loop = core_.facets[f];
      const auto at = std::find(loop.begin(), loop.end(), corner);
      const Index before = at == loop.begin() ? loop.back() : *(at - 1);
      // The edge that enters the corner in f leaves it in the next one.
      f = facet_of_edge_.at({corner, before});
    } while (f != first);
    return around;
  }

  /// Rings around the middle of the normals, out to the arcs of the edges.
  void patch(Index corner) {
    const std::vector<Index> around = facets_around(corner);
    V middle = V::Zero();
    for (const Index f : around) middle += core_.normals[f];
    middle.normalize();
    double reach = 0;
    for (const Index f : around) reach = std::max(reach, angle_between(middle, core_.normals[f]));
    const int rings = segments(reach, step_);
    const Index centre = add(corner, middle);
    // Points of the spokes, ring by ring; the outermost are the facets'.
    std::vector<std::vector<Index>> spokes;
    for (const Index f : around) {
      std::vector<Index> spoke = {centre};
      for (int ring = 1; ring < rings; ++ring)
        spoke.push_back(
            add(corner, on_arc(middle, core_.normals[f], static_cast<double>(ring) / rings)));
      spoke.push_back(at_facet_.at({f, corner}));
      spokes.push_back(std::move(spoke));
    }
    for (std::size_t i = 0; i < around.size(); ++i) {
      const std::size_t next = (i + 1) % around.size();
      const V &a = core_.normals[around[i]], &b = core_.normals[around[next]];
      std::vector<Index> inner = {centre};
      for (int ring = 1; ring <= rings; ++ring) {
        std::vector<Index> outer;
        if (ring == rings) {
          outer = arc(corner, around[i], around[next]);
        } else {
          const double out = static_cast<double>(ring) / rings;
          const V from = on_arc(middle, a, out), to = on_arc(middle, b, out);
          const int count = segments(angle_between(from, to), step_);
          outer.push_back(spokes[i][static_cast<std::size_t>(ring)]);
          for (int j = 1; j < count; ++j)
            outer.push_back(add(corner, on_arc(from, to, static_cast<double>(j) / count)));
          outer.push_back(spokes[next][static_cast<std::size_t>(ring)]);
        }
        zip(inner, outer);
        inner = std::move(outer);
      }
    }
  }

  /// Triangles between two rows of points, the outer one further from the middle.
  void zip(const std::vector<Index>& inner, const std::vector<Index>& outer) {
    std::size_t i = 0, o = 0;
    while (i + 1 < inner.size() || o + 1 < outer.size()) {
      // Advances the row that has come less far.
      const bool along_outer =
          i + 1 == inner.size() ||
          (o + 1 < outer.size() && (o + 1) * (inner.size() - 1) <= (i + 1) * (outer.size() - 1));
      if (along_outer) {
        triangle(inner[i], outer[o], outer[o + 1], true);
        ++o;
      } else {
        triangle(inner[i], outer[o], inner[i + 1], true);
        ++i;
      }
    }
  }

  const Core& core_;
  double radius_, step_;
  TriangleMesh mesh_;
  std::vector<V> directions_;                               ///< by vertex: from its corner
  std::map<std::pair<Index, Index>, Index> at_facet_;       ///< point by facet and corner
  std::map<std::pair<Index, Index>, Index> facet_of_edge_;  ///< by its ends, in the facet's order
  std::map<std::array<Index, 3>, std::vector<Index>> arcs_;
};

}  // namespace

std::optional<TriangleMesh> rounded_mesh(const Shape& shape, double error) {
  const auto* rounded = std::get_if<Rounded>(&shape.kind);
  if (!rounded || !(rounded->radius > 0)) return std::nullopt;
  const std::optional<Core> core = core_of(*rounded->shape);
  if (!core) return std::nullopt;
  // A chord of an arc of `step` is that far from it; triangles reach a little deeper.
  double step = std::min(2 * std::sqrt(2 * error / rounded->radius), std::numbers::pi / 4);
  for (;;) {
    TriangleMesh mesh = Builder(*core, rounded->radius, step).build();
    if (mesh.error <= error) return mesh;
    step *= std::clamp(0.99 * std::sqrt(error / mesh.error), 0.5, 0.98);
  }
}

}  // namespace minkray::bench
