// SPDX-License-Identifier: MIT
#include "core/shape/core_and_radius.h"

#include <cmath>

#include "core/math/length.h"
#include "core/shape/simple_cores.h"

namespace minkray {
namespace {

using namespace cores;
using Points = std::vector<Vec3<double>>;

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
  core.ball = length_of((high - low) / 2) * padding;
  core.shape = about_middle.get();
  // What is far from the origin of its frame has lost those digits before it comes to its middle.
  constexpr double lost = 4 * std::numeric_limits<double>::epsilon();
  core.rounding = lost * (middle.norm() + map.translation.norm());
  return {core, Mat3<double>::Identity(), middle, std::move(about_middle)};
}

Points mapped(const Points& points, const Affine<double>& map) {
  Points result;
  for (const Vec3<double>& p : points) result.push_back(map(p));
  return result;
}

/// The exponent of a power of two that is larger than all of the numbers: products of what is
/// scaled down by it are numbers, and no digit is lost.
template <class Numbers>
int exponent_of_largest(const Numbers& numbers) {
  int exponent = 0;
  std::frexp(numbers.cwiseAbs().maxCoeff(), &exponent);
  return exponent;
}

template <class Numbers>
Numbers scaled_down(const Numbers& numbers, int exponent) {
  return numbers.unaryExpr([exponent](double x) { return std::ldexp(x, -exponent); });
}

/// By how much the map scales all lengths; 0 if it does not.
double similarity_of(const Mat3<double>& linear) {
  const int exponent = exponent_of_largest(linear);
  const Affine<double> map{scaled_down(linear, exponent), Vec3<double>::Zero()};
  return std::ldexp(AffineMap<double>(map).similarity(), exponent);
}

/// Whether the map keeps the coordinate axes at right angles, but for a few roundings: boxes stay
/// boxes then, and ellipsoids keep their axes.
bool keeps_right_angles(const Mat3<double>& linear) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const auto column = [&](int i) {
    const Vec3<double> v = linear.col(i);
    return scaled_down(v, exponent_of_largest(v));
  };
  for (int i = 0; i < 3; ++i) {
    const Vec3<double> a = column(i), b = column((i + 1) % 3);
    if (!(std::abs(a.dot(b)) <= rounding * a.norm() * b.norm())) return false;
  }
  return true;
}

CoreAndRadius find(const Shape<double>& shape, const Affine<double>& map, double radius);

/// A Minkowski sum of which all operands but one at most are points and balls: those move that one
/// and make it rounder.
class BallsAndOne {
 public:
  /// Whether it still is one.
  bool add(const Shape<double>& operand, const Mat3<double>& linear) {
    CoreAndRadius one = find(operand, {linear, Vec3<double>::Zero()}, 0);
    offset_ += one.middle;
    radius_ += one.core.radius;
    if (one.core.kind == CoreKind::point) return true;
    if (has_one_) return false;
    has_one_ = true;
    one_ = std::move(one);
    return true;
  }

  CoreAndRadius of(const Vec3<double>& translation, double radius) const {
    if (!has_one_) return of_point(offset_ + translation, radius_ + radius);
    CoreAndRadius found = one_;
    found.middle = offset_ + translation;
    found.core.radius = radius_ + radius;
    return found;
  }

 private:
  Vec3<double> offset_ = Vec3<double>::Zero();
  double radius_ = 0;
  bool has_one_ = false;
  CoreAndRadius one_;
};

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
      const double scale = similarity > 0 ? similarity : length_of(map.linear.col(i));
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
    found.core.ball = length_of<double>(found.core.size) * padding;
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
  bool find(const HullOf<double>& shape, CoreAndRadius& found) const {
    if (shape.shapes.size() > 1) return false;
    found = minkray::find(*shape.shapes.front(), map, radius);
    return true;
  }
  bool find(const MinkowskiSum<double>& shape, CoreAndRadius& found) const {
    BallsAndOne sum;
    for (const Nested<double>& operand : shape.shapes)
      if (!sum.add(*operand, map.linear)) return false;
    found = sum.of(map.translation, radius);
    return true;
  }
  bool find(const MinkowskiDifference<double>& shape, CoreAndRadius& found) const {
    BallsAndOne sum;
    if (!sum.add(*shape.a, map.linear) || !sum.add(*shape.b, -map.linear)) return false;
    found = sum.of(map.translation, radius);
    return true;
  }
  bool find(const Transform<double>& shape, CoreAndRadius& found) const {
    found = minkray::find(*shape.shape, map * shape.map.affine(), radius);
    return true;
  }
};

CoreAndRadius find(const Shape<double>& shape, const Affine<double>& map, double radius) {
  const double similarity = similarity_of(map.linear);
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
