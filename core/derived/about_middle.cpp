// SPDX-License-Identifier: MIT
#include "core/derived/about_middle.h"

#include "core/math/bounds.h"

namespace minkray {
namespace {

Shape<double> under(const Mat3<double>& linear, const Shape<double>& shape) {
  if (linear == Mat3<double>::Identity()) return shape;
  return Transform<double>{shape, Affine<double>{linear, Vec3<double>::Zero()}};
}

/// Nearer to its frame's origin than this, in its own size, a shape stays where it is.
constexpr double far = 4;

bool is_far(const Bounds<double>& bounds) {
  return length_of(bounds.centre()) > far * length_of(bounds.half_extents());
}

double similarity_of(const ComposedMap& map) {
  return AffineMap<double>({map.linear.high, Vec3<double>::Zero()}).similarity();
}

/// Rebuilds each kind of shape.
struct Rebuilder {
  const ComposedMap& map;

  /// Already about its origin.
  template <class S>
  AboutMiddle operator()(const S& shape) const {
    return {under(map.linear.high, shape), map.translation,
            map.loss + loss_of_turns(shape, map, similarity_of(map))};
  }

  AboutMiddle operator()(const Point<double>& point) const {
    return {Point<double>{Vec3<double>::Zero()}, map.image(point.position),
            map.loss_of_image(point.position)};
  }
  AboutMiddle operator()(const Segment<double>& segment) const { return of_corners(segment); }
  AboutMiddle operator()(const Triangle<double>& triangle) const { return of_corners(triangle); }
  AboutMiddle operator()(const Hull<double>& hull) const {
    Bounds<double> bounds;
    for (const Vec3<double>& p : hull.points.points()) bounds.extend(p);
    if (map.linear.is_identity() && !is_far(bounds)) return {hull, map.translation, map.loss};
    PointsAboutMiddle moved = points_about_middle(hull.points.points(), map);
    return {Hull<double>{PointCloud<double>(std::move(moved.points))}, moved.middle, moved.loss};
  }

  AboutMiddle operator()(const CutCylinder<double>& cylinder) const {
    CutCylinder<double> moved = cylinder;
    const Vec3<double> middle(0, 0, cylinder.heights[0] / 2 + cylinder.heights[1] / 2);
    for (double& height : moved.heights) height -= middle.z();
    return {under(map.linear.high, moved), map.image(middle),
            map.loss_of_image(middle) + loss_of_turns(moved, map, similarity_of(map))};
  }

  /// Finds the box by its own support points.
  AboutMiddle operator()(const Custom<double>& custom) const {
    Bounds<double> bounds;
    for (int axis = 0; axis < 3; ++axis) {
      bounds.upper[axis] = custom.support(Vec3<double>(Vec3<double>::Unit(axis)))[axis];
      bounds.lower[axis] = custom.support(Vec3<double>(-Vec3<double>::Unit(axis)))[axis];
    }
    const Vec3<double> middle = bounds.centre();
    const double turns = map.turn_error * length_of(bounds.half_extents());
    if (!is_far(bounds))
      return {under(map.linear.high, custom), map.translation, map.loss_of_image(middle) + turns};
    constexpr double lost = 4 * std::numeric_limits<double>::epsilon();
    return {Transform<double>{Shape<double>(custom),
                              Affine<double>{map.linear.high, -(map.linear.high * middle)}},
            map.image(middle),
            map.loss_of_image(middle) + turns + lost * map.stretch() * length_of(middle)};
  }

  AboutMiddle operator()(const Rounded<double>& rounded) const {
    AboutMiddle core = about_middle(*rounded.shape, map);
    const double similarity = similarity_of(map);
    if (similarity > 0)
      core.shape = Rounded<double>{rounded.radius * similarity, Nested<double>(core.shape)};
    else
      core.shape = MinkowskiSum<double>{
          {Nested<double>(core.shape),
           Nested<double>(under(map.linear.high, Sphere<double>{rounded.radius}))}};
    core.loss += loss_of_turns(Sphere<double>{rounded.radius}, map, similarity);
    return core;
  }

  AboutMiddle operator()(const MinkowskiSum<double>& sum) const {
    MinkowskiSum<double> moved;
    AboutMiddle found{Point<double>{}, map.translation, map.loss};
    for (const Nested<double>& operand : sum.shapes)
      moved.shapes.push_back(
          Nested<double>(add(about_middle(*operand, map.about_origin()), found)));
    found.shape = std::move(moved);
    return found;
  }
  AboutMiddle operator()(const MinkowskiDifference<double>& difference) const {
    AboutMiddle found{Point<double>{}, map.translation, map.loss};
    AboutMiddle b = about_middle(*difference.b, map.about_origin());
    b.middle = -b.middle;
    const Nested<double> of_a(add(about_middle(*difference.a, map.about_origin()), found)),
        of_b(add(b, found));
    found.shape = MinkowskiDifference<double>{of_a, of_b};
    return found;
  }

  AboutMiddle operator()(const HullOf<double>& hull) const {
    HullOf<double> moved;
    AboutMiddle found{Point<double>{}, {}, 0};
    for (const Nested<double>& operand : hull.shapes) {
      const AboutMiddle one = about_middle(*operand, map);
      if (moved.shapes.empty()) found.middle = one.middle;
      found.loss = std::max(found.loss, one.loss);
      moved.shapes.push_back(
          Nested<double>(moved_by(one.shape, (one.middle - found.middle).rounded())));
    }
    found.shape = std::move(moved);
    return found;
  }

  AboutMiddle operator()(const Transform<double>& shape) const {
    return about_middle(*shape.shape, map * ComposedMap(shape.map.affine()));
  }

 private:
  static const Shape<double>& add(const AboutMiddle& operand, AboutMiddle& sum) {
    sum.middle = sum.middle + operand.middle;
    sum.loss += operand.loss;
    return operand.shape;
  }

  template <class S>
  AboutMiddle of_corners(const S& shape) const {
    const PointsAboutMiddle moved =
        points_about_middle({shape.points.begin(), shape.points.end()}, map);
    S about = shape;
    std::copy(moved.points.begin(), moved.points.end(), about.points.begin());
    return {about, moved.middle, moved.loss};
  }
};

/// Moves what can be moved without another map.
struct Mover {
  const Vec3<double>& way;

  template <class S>
  Shape<double> operator()(const S& shape) const {
    return Transform<double>{Shape<double>(shape), Affine<double>{Mat3<double>::Identity(), way}};
  }
  Shape<double> operator()(const Point<double>& point) const {
    return Point<double>{Vec3<double>(point.position + way)};
  }
  Shape<double> operator()(const Transform<double>& shape) const {
    Affine<double> map = shape.map.affine();
    map.translation += way;
    return Transform<double>{shape.shape, map};
  }
  Shape<double> operator()(const Rounded<double>& rounded) const {
    return Rounded<double>{rounded.radius, Nested<double>(moved_by(*rounded.shape, way))};
  }
  Shape<double> operator()(const MinkowskiSum<double>& sum) const {
    MinkowskiSum<double> moved = sum;
    moved.shapes.front() = Nested<double>(moved_by(*sum.shapes.front(), way));
    return moved;
  }
  Shape<double> operator()(const MinkowskiDifference<double>& difference) const {
    return MinkowskiDifference<double>{Nested<double>(moved_by(*difference.a, way)), difference.b};
  }
  Shape<double> operator()(const HullOf<double>& hull) const {
    HullOf<double> moved;
    for (const Nested<double>& shape : hull.shapes)
      moved.shapes.push_back(Nested<double>(moved_by(*shape, way)));
    return moved;
  }
};

}  // namespace

AboutMiddle about_middle(const Shape<double>& shape, const ComposedMap& map) {
  return std::visit(Rebuilder{map}, shape.kind);
}

double loss_of_turns(const Shape<double>& shape, const ComposedMap& map, double similarity) {
  const double error =
      similarity > 0 ? map.turn_error - rounding_of_turns * map.stretch() : map.turn_error;
  if (!(error > 0)) return 0;
  Vec3<double> reach;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3<double> d = Vec3<double>::Unit(axis);
    reach[axis] = std::max(shape.support(d)[axis], -shape.support(Vec3<double>(-d))[axis]);
  }
  return error * length_of(reach);
}

Shape<double> moved_by(const Shape<double>& shape, const Vec3<double>& way) {
  if (way.isZero(0)) return shape;
  return std::visit(Mover{way}, shape.kind);
}

PointsAboutMiddle points_about_middle(const std::vector<Vec3<double>>& points,
                                      const ComposedMap& map) {
  PointsAboutMiddle found;
  std::vector<TwoFoldVec3<double>> images;
  images.reserve(points.size());
  Bounds<double> bounds;
  for (const Vec3<double>& p : points) {
    images.push_back(map.image(p));
    bounds.extend(images.back().high);
    found.loss = std::max(found.loss, map.loss_of_image(p));
  }
  found.middle = bounds.lower + (bounds.upper - bounds.lower) / 2;
  for (const TwoFoldVec3<double>& image : images)
    found.points.push_back((image - TwoFoldVec3<double>(found.middle)).rounded());
  return found;
}

}  // namespace minkray
