// SPDX-License-Identifier: MIT
// Shapes whose casts a filter answers, with oracles for where lines meet them.
#pragma once

#include <functional>

#include "tests/oracle/filter_truth.h"
#include "tests/oracle/rounded_hull.h"
#include "tests/support/hull_points.h"

namespace minkray::testing {

struct FilterShape {
  std::string name;
  Shape shape;
  Points points = {};    ///< corners, for rays along edges
  bool is_posed = true;  ///< false: elsewhere, numbers are further apart than it is large
};

/// Interval of a line in a prepared shape's inner frame.
using LineIn = std::function<Interval(const Vec3<Long>& at, const Vec3<Long>& along)>;

/// Shapes of one oracle.
struct FilterGroup {
  std::vector<FilterShape> shapes;
  std::function<LineIn(const PreparedShape&)> oracle;
  int rays;  ///< of each family, per shape and pose
};

/// School geometry.
inline FilterGroup closed_forms() {
  const Shape box = Box{{1, 0.7, 0.5}};
  return {{
              {"sphere", Sphere{0.3}},
              {"a minute sphere", Sphere{1e-12}, {}, false},
              {"ellipsoid", Ellipsoid{{1, 0.5, 0.25}}},
              {"box", box},
              {"cube", Box{{1, 1, 1}}},
              {"capsule", Capsule{1, 1}},
              {"long capsule", Capsule{0.2, 2}},
              {"cylinder", Cylinder{1, 1}},
              {"coin", Cylinder{2, 0.25}},
              {"cut cylinder", CutCylinder{0.7, {-0.5, 0.6}, {0.2, -0.3}, {-0.5, 0.4}}},
              {"wedge", CutCylinder{1, {0, 0.5}, {0.25, 0}, {-0.25, 0}}},
              {"cone", Cone{1, 1}},
              {"flat cone", Cone{2, 0.2}},
              {"frustum", Frustum{{1, 0.3}, 1}},
              {"upturned frustum", Frustum{{0.25, 1.5}, 0.5}},
              {"even frustum", Frustum{{0.5, 0.5}, 0.5}},
              {"tapered capsule", TaperedCapsule{{1, 0.3}, 1}},
              {"upturned tapered capsule", TaperedCapsule{{0.1, 0.7}, 0.5}},
              {"rounded box", Rounded{0.2, box}},
              {"rounded plate", Rounded{0.1, Shape(Box{{1, 1, 0}})}},
              {"rounded cylinder", Rounded{0.2, Shape(Cylinder{1, 0.7})}},
              {"hardly rounded cylinder", Rounded{1e-3, Shape(Cylinder{0.5, 1})}},
              {"much rounded cylinder", Rounded{3, Shape(Cylinder{0.5, 0.2})}},
              {"rounded disk", Rounded{0.1, Shape(Disk{1})}},
              {"rounded cone", Rounded{0.2, Shape(Cone{1, 1})}},
              {"rounded flat cone", Rounded{0.05, Shape(Cone{2, 0.2})}},
              {"rounded frustum", Rounded{0.3, Shape(Frustum{{1, 0.3}, 1})}},
              {"rounded upturned frustum", Rounded{0.1, Shape(Frustum{{0.25, 1.5}, 0.5})}},
          },
          [](const PreparedShape& prepared) -> LineIn {
            return [inner = prepared.inner_shape()](const Vec3<Long>& at, const Vec3<Long>& along) {
              return *line_in_shape(inner, at, along);
            };
          },
          300};
}

/// Planes through every three points of the inner shape, as they were rounded and moved.
inline FilterGroup polytopes() {
  FilterGroup group{{},
                    [](const PreparedShape& prepared) -> LineIn {
                      const Shape inner = prepared.inner_shape();
                      return [planes = HalfSpaces(std::get<Hull>(inner.kind).points.points())](
                                 const Vec3<Long>& at, const Vec3<Long>& along) -> Interval {
                        const HalfSpaces::Part part = planes.clip(at, along);
                        return {part.lower, part.upper};
                      };
                    },
                    400};
  for (const NamedPoints& named : hulls())
    group.shapes.push_back({named.name, Hull{PointCloud(named.points)}, named.points});
  return group;
}

/// Two points are a segment, three a triangle.
inline Shape rounded_hull(double radius, const Points& points) {
  if (points.size() == 2) return Rounded{radius, Shape(Segment{{points[0], points[1]}})};
  if (points.size() == 3)
    return Rounded{radius, Shape(Triangle{{points[0], points[1], points[2]}})};
  return Rounded{radius, Shape(Hull{PointCloud(points)})};
}

/// The facets' prisms and the edges' capsules. The oracle is slow at hulls of 64 points.
inline FilterGroup rounded_polytopes() {
  std::vector<NamedPoints> cores = hulls();
  std::erase_if(cores, [](const NamedPoints& core) { return core.points.size() > 40; });
  cores.push_back({"segment", {{-1, 0.2, 0}, {0.7, 1, -0.4}}});
  cores.push_back({"segment of no length", {{0.5, 0.25, 1}, {0.5, 0.25, 1}}});
  cores.push_back({"segment along x", {{-1, 0, 0}, {1, 0, 0}}});
  cores.push_back({"segment off centre", {{3, 2, 1}, {4, 2.5, 0}}});
  cores.push_back({"triangle", {{-1, -0.5, 0.1}, {1, -0.3, 0}, {0.2, 1, -0.4}}});
  cores.push_back({"triangle along the axes", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  cores.push_back({"slender triangle", {{0, 0, 0}, {1, 0, 0}, {0.4, 0.02, 0.01}}});
  FilterGroup group{
      {},
      [](const PreparedShape& prepared) -> LineIn {
        const Shape inner = prepared.inner_shape();
        const auto& rounded = std::get<Rounded>(inner.kind);
        Points points;
        std::visit(
            [&]<class Core>(const Core& core) {
              if constexpr (std::is_same_v<Core, Hull>)
                points.assign(core.points.points().begin(), core.points.points().end());
              else if constexpr (requires { core.points; })
                points.assign(core.points.begin(), core.points.end());
            },
            rounded.shape->kind);
        return
            [oracle = RoundedHull(points, rounded.radius)](
                const Vec3<Long>& at, const Vec3<Long>& along) { return oracle.line(at, along); };
      },
      60};
  for (const NamedPoints& core : cores)
    for (const double radius : {0.1, 0.01, 2.0})
      group.shapes.push_back({core.name, rounded_hull(radius, core.points), core.points});
  return group;
}

}  // namespace minkray::testing
