// SPDX-License-Identifier: MIT
#include "core/derived/core_and_radius.h"

#include <cmath>

#include "core/derived/simple_cores.h"
#include "core/math/length.h"
#include "core/support/declared.h"

namespace minkray {
namespace {

using namespace cores;
/// Makes a core of the kind `other`, around the middle of its bounding box.
CoreAndRadius of_other(const Shape& shape, const ComposedMap& map, double radius) {
  const AboutMiddle about = about_middle(shape, map);
  Vec3<double> low, high;
  for (int axis = 0; axis < 3; ++axis) {
    high[axis] = about.shape.support(Vec3<double>(Vec3<double>::Unit(axis)))[axis];
    low[axis] = about.shape.support(Vec3<double>(-Vec3<double>::Unit(axis)))[axis];
  }
  const Vec3<double> middle = low + (high - low) / 2;
  const TwoFoldVec3<double> place = about.middle + TwoFoldVec3<double>(middle);
  if (low == high) return of_point(place, radius, about.loss);
  auto about_middle = std::make_shared<Shape>(moved_by(about.shape, -middle));
  ShapeCore core;
  core.kind = CoreKind::other;
  core.radius = radius;
  core.ball = length_of((high - low) / 2) * padding;
  core.shape = about_middle.get();
  // The position of the middle of the box, relative to the shape's parts, is already rounded.
  constexpr double lost = 4 * std::numeric_limits<double>::epsilon();
  CoreAndRadius found =
      placed(core, Mat3<double>::Identity(), place, about.loss + lost * length_of(middle));
  found.storage = std::move(about_middle);
  return found;
}

/// Returns the exponent of a power of two larger than all of the numbers. If numbers are scaled
/// down by it, which is exact, their products do not overflow.
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

/// Factor by which the map scales all lengths; 0 if lengths scale differently.
double similarity_of(const Mat3<double>& linear) {
  const int exponent = exponent_of_largest(linear);
  const Affine<double> map{scaled_down(linear, exponent), Vec3<double>::Zero()};
  return std::ldexp(AffineMap(map).similarity(), exponent);
}

/// True if images of the coordinate axes are perpendicular, up to a few roundings. Boxes then stay
/// boxes, and ellipsoids keep their axes.
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

/// Multiplies all lengths of a shape without operands.
template <class S>
void scale_lengths(S& shape, double factor) {
  for_each_field<S>([&](const auto& field) {
    if (field.unit != Unit::length) return;
    auto& lengths = shape.*field.member;
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(lengths)>, double>)
      lengths *= factor;
    else
      for (double& length : lengths) length *= factor;
  });
}

CoreAndRadius find(const Shape& shape, const ComposedMap& map, double radius);

/// True if the shape is of a kind that is always around its origin.
bool is_about_origin(const Shape& shape) {
  const auto is_within = []<class... Kinds>(const Shape& one, std::variant<Kinds...>*) {
    return (std::holds_alternative<Kinds>(one.kind) || ...);
  };
  using Others = std::variant<Point, Segment, Triangle, Hull, Transform, Rounded, HullOf,
                              MinkowskiSum, MinkowskiDifference>;
  return !is_within(shape, static_cast<Others*>(nullptr));
}

/// A Minkowski sum of points and balls and at most one other operand. The points move this operand,
/// and the balls increase its radius.
class BallsAndOne {
 public:
  /// Returns false if the sum has a second such operand.
  bool add(const Shape& operand, const ComposedMap& about_origin) {
    CoreAndRadius one = find(operand, about_origin, 0);
    offset_ = offset_ + TwoFoldVec3<double>(one.middle, one.middle_low);
    radius_ += one.core.radius;
    loss_ += one.core.rounding;
    if (one.core.kind == CoreKind::point) return true;
    if (has_one_) return false;
    has_one_ = true;
    one_ = std::move(one);
    return true;
  }

  CoreAndRadius of(const ComposedMap& map, double radius) const {
    const TwoFoldVec3<double> middle = offset_ + map.translation;
    const double loss = loss_ + map.loss;
    if (!has_one_) return of_point(middle, radius_ + radius, loss);
    CoreAndRadius found = one_;
    found.middle = middle.high;
    found.middle_low = middle.low;
    found.core.radius = radius_ + radius;
    found.core.rounding = loss;
    return found;
  }

 private:
  TwoFoldVec3<double> offset_;
  double radius_ = 0, loss_ = 0;
  bool has_one_ = false;
  CoreAndRadius one_;
};

/// Finds the core of each kind of shape. Returns false for other kinds.
struct CoreFinder {
  const ComposedMap& map;
  double radius;
  double similarity;  ///< factor by which the map scales all lengths; 0 if there is none

  const Mat3<double>& linear() const { return map.linear.high; }

  CoreAndRadius scaled(ShapeCore core) const {
    core.radius = radius;
    core.size *= similarity;
    core.ball *= similarity;
    return placed(core, linear() / similarity, map.translation, map.loss);
  }

  /// Makes a core whose axes stay perpendicular under the map.
  CoreAndRadius along_columns(ShapeCore core) const {
    Mat3<double> turn;
    for (int i = 0; i < 3; ++i) {
      const double scale = similarity > 0 ? similarity : length_of(linear().col(i));
      core.size[i] *= scale;
      turn.col(i) = linear().col(i) / scale;
    }
    core.radius = radius;
    return placed(core, turn, map.translation, map.loss);
  }

  /// Makes a segment along the z axis, around the origin.
  CoreAndRadius upright_segment(double half_height, double grown_by) const {
    const Vec3<double> half(0, 0, half_height);
    return of_segment(map.image(Vec3<double>(-half)), map.image(half), grown_by, map.loss);
  }

  template <class S>
  bool find(const S& shape, CoreAndRadius& found) const {
    if constexpr (declared_by<S>.revolved) return find_revolved(shape, found);
    return false;
  }
  bool find(const Point& shape, CoreAndRadius& found) const {
    found = of_point(map.image(shape.position), radius, map.loss_of_image(shape.position));
    return true;
  }
  bool find(const Segment& shape, CoreAndRadius& found) const {
    found = of_points({shape.points.begin(), shape.points.end()}, map, radius);
    return true;
  }
  bool find(const Triangle& shape, CoreAndRadius& found) const {
    found = of_points({shape.points.begin(), shape.points.end()}, map, radius);
    return true;
  }
  bool find(const Hull& shape, CoreAndRadius& found) const {
    found = of_points(shape.points.points(), map, radius);
    return true;
  }
  bool find(const Box& shape, CoreAndRadius& found) const {
    ShapeCore core;
    core.kind = CoreKind::box;
    core.size = shape.half_extents;
    if (!keeps_right_angles(linear())) return false;
    found = along_columns(core);
    found.core.ball = length_of<double>(found.core.size) * padding;
    return true;
  }
  bool find(const Sphere& shape, CoreAndRadius& found) const {
    if (!(similarity > 0)) return find(Ellipsoid{Vec3<double>::Constant(shape.radius)}, found);
    found = of_point(map.translation, radius + shape.radius * similarity, map.loss);
    return true;
  }
  bool find(const Ellipsoid& shape, CoreAndRadius& found) const {
    ShapeCore core;
    core.kind = CoreKind::ellipsoid;
    core.size = shape.radii;
    if (!keeps_right_angles(linear())) return false;
    found = along_columns(core);
    const Vec3<double> radii = found.core.size;
    if (radii.minCoeff() == radii.maxCoeff())
      found = of_point(map.translation, radius + radii.x(), map.loss);
    else
      found.core.ball = radii.maxCoeff() * padding;
    return true;
  }
  bool find(const Capsule& shape, CoreAndRadius& found) const {
    if (!(similarity > 0)) return false;
    found = upright_segment(shape.half_height, radius + shape.radius * similarity);
    return true;
  }
  bool disks(double below, double above, double half_height, CoreAndRadius& found) const {
    if (!(similarity > 0)) return false;
    if (!(below > 0) && !(above > 0)) {
      found = upright_segment(half_height, radius);
      return true;
    }
    found = scaled(of_disks(below, above, half_height));
    return true;
  }
  bool find(const Disk& shape, CoreAndRadius& found) const {
    return disks(shape.radius, shape.radius, 0, found);
  }
  bool find(const Cylinder& shape, CoreAndRadius& found) const {
    return disks(shape.radius, shape.radius, shape.half_height, found);
  }
  bool find(const Cone& shape, CoreAndRadius& found) const {
    return disks(shape.radius, 0, shape.half_height, found);
  }
  bool find(const Frustum& shape, CoreAndRadius& found) const {
    return disks(shape.radii[0], shape.radii[1], shape.half_height, found);
  }
  /// The core keeps the shape's axis as its own.
  template <class S>
  bool find_revolved(S shape, CoreAndRadius& found) const {
    if (!(similarity > 0)) return false;
    scale_lengths(shape, similarity);
    found = of_other(Shape(std::move(shape)), {}, radius);
    found.core.is_round = true;
    found.turn = linear() / similarity;
    const TwoFoldVec3<double> middle =
        map.translation + TwoFoldVec3<double>(found.turn * found.middle);
    found.middle = middle.high;
    found.middle_low = middle.low;
    found.core.rounding += map.loss;
    return true;
  }
  bool find(const Rounded& shape, CoreAndRadius& found) const {
    if (!(similarity > 0)) return false;
    found = minkray::find(*shape.shape, map, radius + shape.radius * similarity);
    return true;
  }
  bool find(const HullOf& shape, CoreAndRadius& found) const {
    if (shape.shapes.size() > 1) return false;
    found = minkray::find(*shape.shapes.front(), map, radius);
    return true;
  }
  bool find(const MinkowskiSum& shape, CoreAndRadius& found) const {
    BallsAndOne sum;
    for (const Nested& operand : shape.shapes)
      if (!sum.add(*operand, map.about_origin())) return false;
    found = sum.of(map, radius);
    return true;
  }
  bool find(const MinkowskiDifference& shape, CoreAndRadius& found) const {
    BallsAndOne sum;
    const ComposedMap about_origin = map.about_origin();
    if (!sum.add(*shape.a, about_origin) || !sum.add(*shape.b, about_origin.mirrored()))
      return false;
    found = sum.of(map, radius);
    return true;
  }
  bool find(const Transform& shape, CoreAndRadius& found) const {
    found = minkray::find(*shape.shape, map * ComposedMap(shape.map.affine()), radius);
    return true;
  }
};

CoreAndRadius find(const Shape& shape, const ComposedMap& map, double radius) {
  const double similarity = similarity_of(map.linear.high);
  const CoreFinder finder{map, radius, similarity};
  CoreAndRadius found;
  const bool is_known =
      std::visit([&](const auto& kind) { return finder.find(kind, found); }, shape.kind);
  if (!is_known) return of_other(shape, map, radius);
  if (is_about_origin(shape)) found.core.rounding += loss_of_turns(shape, map, similarity);
  return found;
}

}  // namespace

CoreAndRadius core_and_radius(const Shape& shape, const ComposedMap& map) {
  return find(shape, map, 0);
}

CoreAndRadius core_and_radius(const Shape& shape, const Affine<double>& map) {
  return core_and_radius(shape, ComposedMap(map));
}

}  // namespace minkray
