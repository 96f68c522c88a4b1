// SPDX-License-Identifier: MIT
#include "core/shape/core_and_radius.h"

#include <algorithm>

namespace minkray {
namespace {

/// A box's and ellipsoid's balls are rounded up, so that they hold what they should.
constexpr double padding = 1 + 16 * std::numeric_limits<double>::epsilon();

using Points = std::vector<Vec3<double>>;

CoreAndRadius placed(const ShapeCore& core, const Mat3<double>& turn, const Vec3<double>& middle) {
  return {core, turn, middle, nullptr};
}

CoreAndRadius of_point(const Vec3<double>& point, double radius) {
  ShapeCore core;
  core.radius = radius;
  return {core, Mat3<double>::Identity(), point, nullptr};
}

CoreAndRadius of_segment(const Vec3<double>& from, const Vec3<double>& to, double radius) {
  // Halves of differences, so that what is far from the origin keeps its digits.
  const Vec3<double> half = (to - from) / 2;
  const double length = half.stableNorm();
  if (!(length > 0)) return of_point(from, radius);
  ShapeCore core;
  core.kind = CoreKind::segment;
  core.size.z() = length;
  core.radius = radius;
  core.ball = length * padding;
  Mat3<double> turn;
  turn.col(2) = half / length;
  turn.col(0) = turn.col(2).unitOrthogonal();
  turn.col(1) = turn.col(2).cross(turn.col(0));
  return {core, turn, from + half, nullptr};
}

/// The points' middle is that of their box.
CoreAndRadius of_points(const Points& points, double radius) {
  if (points.size() == 1) return of_point(points[0], radius);
  if (points.size() == 2) return of_segment(points[0], points[1], radius);
  Vec3<double> low = points[0], high = points[0];
  for (const Vec3<double>& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3<double> middle = low + (high - low) / 2;
  const std::size_t count = (points.size() + 7) / 8 * 8;
  auto numbers = std::make_shared<std::vector<double>>(3 * count);
  ShapeCore core;
  core.kind = CoreKind::hull;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3<double> p = points[std::min(i, points.size() - 1)] - middle;
    core.ball = std::max(core.ball, p.norm() * padding);
    for (std::size_t k = 0; k < 3; ++k) (*numbers)[k * count + i] = p[static_cast<Eigen::Index>(k)];
  }
  core.count = static_cast<int>(count);
  core.radius = radius;
  core.x = numbers->data();
  core.y = core.x + count;
  core.z = core.y + count;
  return {core, Mat3<double>::Identity(), middle, std::move(numbers)};
}

/// Goes by the support mapping. A box of it is asked for, about whose middle it then stands.
CoreAndRadius of_other(const Shape<double>& shape, const Affine<double>& map, double radius) {
  const Shape<double> in_place =
      map == Affine<double>{} ? shape : Shape<double>(Transform<double>{shape, map});
  Vec3<double> low, high;
  for (int axis = 0; axis < 3; ++axis) {
    high[axis] = in_place.support(Vec3<double>(Vec3<double>::Unit(axis)))[axis];
    low[axis] = in_place.support(Vec3<double>(-Vec3<double>::Unit(axis)))[axis];
  }
  const Vec3<double> middle = low + (high - low) / 2;
  if (low == high) return of_point(middle, radius);
  auto about_middle = std::make_shared<Shape<double>>(
      Transform<double>{shape, Affine<double>{map.linear, map.translation - middle}});
  ShapeCore core;
  core.kind = CoreKind::other;
  core.radius = radius;
  core.ball = ((high - low) / 2).norm() * padding;
  core.shape = about_middle.get();
  return {core, Mat3<double>::Identity(), middle, std::move(about_middle)};
}

ShapeCore of_disks(double below, double above, double half_height) {
  ShapeCore core;
  core.kind = CoreKind::disks;
  core.size = {below, above, half_height};
  core.ball = std::hypot(std::max(below, above), half_height) * padding;
  return core;
}

Points mapped(const Points& points, const Affine<double>& map) {
  Points result;
  for (const Vec3<double>& p : points) result.push_back(map(p));
  return result;
}

/// Whether the map keeps the coordinate axes at right angles, but for a few roundings: boxes stay
/// boxes then, and ellipsoids keep their axes.
bool keeps_right_angles(const Mat3<double>& linear) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  for (int i = 0; i < 3; ++i) {
    const Vec3<double> a = linear.col(i), b = linear.col((i + 1) % 3);
    if (!(std::abs(a.dot(b)) <= rounding * a.norm() * b.norm())) return false;
  }
  return true;
}

CoreAndRadius find(const Shape<double>& shape, const Affine<double>& map, double radius);

/// Kinds whose core is known. Nothing for others.
struct CoreFinder {
  const Affine<double>& map;
  double radius;
  double similarity;  ///< by how much the map scales all lengths; 0 if it does not

  CoreAndRadius scaled(ShapeCore core) const {
    core.radius = radius;
    core.size *= similarity;
    core.ball *= similarity;
    return placed(core, map.linear / similarity, map.translation);
  }

  /// A core along axes that stay at right angles.
  CoreAndRadius along_columns(ShapeCore core) const {
    Mat3<double> turn;
    for (int i = 0; i < 3; ++i) {
      const double scale = similarity > 0 ? similarity : map.linear.col(i).norm();
      core.size[i] *= scale;
      turn.col(i) = map.linear.col(i) / scale;
    }
    core.radius = radius;
    return placed(core, turn, map.translation);
  }

  template <class S>
  bool find(const S&, CoreAndRadius&) const {
    return false;
  }
  bool find(const Point<double>& shape, CoreAndRadius& found) const {
    found = of_point(map(shape.position), radius);
    return true;
  }
  bool find(const Segment<double>& shape, CoreAndRadius& found) const {
    found = of_segment(map(shape.points[0]), map(shape.points[1]), radius);
    return true;
  }
  bool find(const Triangle<double>& shape, CoreAndRadius& found) const {
    found = of_points(mapped({shape.points.begin(), shape.points.end()}, map), radius);
    return true;
  }
  bool find(const Hull<double>& shape, CoreAndRadius& found) const {
    found = of_points(mapped(shape.points.points(), map), radius);
    return true;
  }
  bool find(const Box<double>& shape, CoreAndRadius& found) const {
    ShapeCore core;
    core.kind = CoreKind::box;
    core.size = shape.half_extents;
    if (!keeps_right_angles(map.linear)) return false;
    found = along_columns(core);
    found.core.ball = found.core.size.norm() * padding;
    return true;
  }
  bool find(const Sphere<double>& shape, CoreAndRadius& found) const {
    if (!(similarity > 0))
      return find(Ellipsoid<double>{Vec3<double>::Constant(shape.radius)}, found);
    found = of_point(map.translation, radius + shape.radius * similarity);
    return true;
  }
  bool find(const Ellipsoid<double>& shape, CoreAndRadius& found) const {
    ShapeCore core;
    core.kind = CoreKind::ellipsoid;
    core.size = shape.radii;
    if (!keeps_right_angles(map.linear)) return false;
    found = along_columns(core);
    const Vec3<double> radii = found.core.size;
    if (radii.minCoeff() == radii.maxCoeff())
      found = of_point(map.translation, radius + radii.x());
    else
      found.core.ball = radii.maxCoeff() * padding;
    return true;
  }
  bool find(const Capsule<double>& shape, CoreAndRadius& found) const {
    if (!(similarity > 0)) return false;
    const Vec3<double> half(0, 0, shape.half_height);
    found = of_segment(map(Vec3<double>(-half)), map(half), radius + shape.radius * similarity);
    return true;
  }
  bool disks(double below, double above, double half_height, CoreAndRadius& found) const {
    if (!(similarity > 0)) return false;
    if (!(below > 0) && !(above > 0)) {
      const Vec3<double> half(0, 0, half_height);
      found = of_segment(map(Vec3<double>(-half)), map(half), radius);
      return true;
    }
    found = scaled(of_disks(below, above, half_height));
    return true;
  }
  bool find(const Disk<double>& shape, CoreAndRadius& found) const {
    return disks(shape.radius, shape.radius, 0, found);
  }
  bool find(const Cylinder<double>& shape, CoreAndRadius& found) const {
    return disks(shape.radius, shape.radius, shape.half_height, found);
  }
  bool find(const Cone<double>& shape, CoreAndRadius& found) const {
    return disks(shape.radius, 0, shape.half_height, found);
  }
  bool find(const Frustum<double>& shape, CoreAndRadius& found) const {
    return disks(shape.radii[0], shape.radii[1], shape.half_height, found);
  }
  bool find(const TaperedCapsule<double>& shape, CoreAndRadius& found) const {
    if (!(similarity > 0)) return false;
    const TaperedCapsule<double> upright{{shape.radii[0] * similarity, shape.radii[1] * similarity},
                                         shape.half_height * similarity};
    found = of_other(Shape<double>(upright), {}, radius);
    found.core.is_round = true;
    const Affine<double> turned{map.linear / similarity, map.translation};
    found.turn = turned.linear;
    found.middle = turned(found.middle);
    return true;
  }
  bool find(const Rounded<double>& shape, CoreAndRadius& found) const {
    if (!(similarity > 0)) return false;
    found = minkray::find(*shape.shape, map, radius + shape.radius * similarity);
    return true;
  }
  bool find(const Transform<double>& shape, CoreAndRadius& found) const {
    found = minkray::find(*shape.shape, map * shape.map.affine(), radius);
    return true;
  }
};

CoreAndRadius find(const Shape<double>& shape, const Affine<double>& map, double radius) {
  const double similarity = AffineMap<double>(map).similarity();
  const CoreFinder finder{map, radius, similarity};
  CoreAndRadius found;
  const bool is_known =
      std::visit([&](const auto& kind) { return finder.find(kind, found); }, shape.kind);
  return is_known ? found : of_other(shape, map, radius);
}

}  // namespace

CoreAndRadius core_and_radius(const Shape<double>& shape, const Affine<double>& map) {
  return find(shape, map, 0);
}

}  // namespace minkray
