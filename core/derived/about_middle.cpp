// SPDX-License-Identifier: MIT
#include "core/derived/about_middle.h"

#include "core/math/bounds.h"
#include "core/support/declared.h"

namespace minkray {
namespace {

Shape under(const Mat3<double>& linear, const Shape& shape) {
  if (linear == Mat3<double>::Identity()) return shape;
  return Transform{shape, Affine<double>{linear, Vec3<double>::Zero()}};
}

/// Largest distance of a shape from its frame's origin, in its own size, up to which it is not
/// moved.
constexpr double far = 4;

bool is_far(const Bounds<double>& bounds) {
  return length_of(bounds.centre()) > far * length_of(bounds.half_extents());
}

double similarity_of(const ComposedMap& map) {
  return AffineMap({map.linear.high, Vec3<double>::Zero()}).similarity();
}

/// Rebuilds each kind of shape.
struct Rebuilder {
  const ComposedMap& map;

  /// For shapes that are around the origin of their frame.
  template <class S>
  AboutMiddle operator()(const S& shape) const {
    return {under(map.linear.high, shape), map.translation,
            map.loss + loss_of_turns(shape, map, similarity_of(map))};
  }
  template <class S>
  requires(declared_by<S>.heights) AboutMiddle operator()(const S& shape) const {
    S moved = shape;
    const Vec3<double> middle(0, 0, shape.heights[0] / 2 + shape.heights[1] / 2);
    for (double& height : moved.heights) height -= middle.z();
    return {under(map.linear.high, moved), map.image(middle),
            map.loss_of_image(middle) + loss_of_turns(moved, map, similarity_of(map))};
  }

  AboutMiddle operator()(const Point& point) const {
    return {Point{Vec3<double>::Zero()}, map.image(point.position),
            map.loss_of_image(point.position)};
  }
  AboutMiddle operator()(const Segment& segment) const { return of_corners(segment); }
  AboutMiddle operator()(const Triangle& triangle) const { return of_corners(triangle); }
  AboutMiddle operator()(const Hull& hull) const {
    Bounds<double> bounds;
    for (const Vec3<double>& p : hull.points.points()) bounds.extend(p);
    if (map.linear.is_identity() && !is_far(bounds)) return {hull, map.translation, map.loss};
    PointsAboutMiddle moved = points_about_middle(hull.points.points(), map);
    return {Hull{PointCloud(std::move(moved.points))}, moved.middle, moved.loss};
  }

  /// Finds the middle by support points.
  AboutMiddle operator()(const Custom& custom) const {
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
    return {Transform{Shape(custom), Affine<double>{map.linear.high, -(map.linear.high * middle)}},
            map.image(middle),
            map.loss_of_image(middle) + turns + lost * map.stretch() * length_of(middle)};
  }

  AboutMiddle operator()(const Rounded& rounded) const {
    AboutMiddle core = about_middle(*rounded.shape, map);
    const double similarity = similarity_of(map);
    if (similarity > 0)
      core.shape = Rounded{rounded.radius * similarity, Nested(core.shape)};
    else
      core.shape = MinkowskiSum{
          {Nested(core.shape), Nested(under(map.linear.high, Sphere{rounded.radius}))}};
    core.loss += loss_of_turns(Sphere{rounded.radius}, map, similarity);
    return core;
  }

  AboutMiddle operator()(const MinkowskiSum& sum) const {
    MinkowskiSum moved;
    AboutMiddle found{Point{}, map.translation, map.loss};
    for (const Nested& operand : sum.shapes)
      moved.shapes.push_back(Nested(add(about_middle(*operand, map.about_origin()), found)));
    found.shape = std::move(moved);
    return found;
  }
  AboutMiddle operator()(const MinkowskiDifference& difference) const {
    AboutMiddle found{Point{}, map.translation, map.loss};
    AboutMiddle b = about_middle(*difference.b, map.about_origin());
    b.middle = -b.middle;
    const Nested of_a(add(about_middle(*difference.a, map.about_origin()), found)),
        of_b(add(b, found));
    found.shape = MinkowskiDifference{of_a, of_b};
    return found;
  }

  AboutMiddle operator()(const HullOf& hull) const {
    HullOf moved;
    AboutMiddle found{Point{}, {}, 0};
    for (const Nested& operand : hull.shapes) {
      const AboutMiddle one = about_middle(*operand, map);
      if (moved.shapes.empty()) found.middle = one.middle;
      found.loss = std::max(found.loss, one.loss);
      moved.shapes.push_back(Nested(moved_by(one.shape, (one.middle - found.middle).rounded())));
    }
    found.shape = std::move(moved);
    return found;
  }

  AboutMiddle operator()(const Transform& shape) const {
    return about_middle(*shape.shape, map * ComposedMap(shape.map.affine()));
  }

 private:
  static const Shape& add(const AboutMiddle& operand, AboutMiddle& sum) {
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

/// Moves each kind of shape. Adds a map only if necessary.
struct Mover {
  const Vec3<double>& way;

  template <class S>
  Shape operator()(const S& shape) const {
    return Transform{Shape(shape), Affine<double>{Mat3<double>::Identity(), way}};
  }
  Shape operator()(const Point& point) const { return Point{Vec3<double>(point.position + way)}; }
  Shape operator()(const Transform& shape) const {
    Affine<double> map = shape.map.affine();
    map.translation += way;
    return Transform{shape.shape, map};
  }
  Shape operator()(const Rounded& rounded) const {
    return Rounded{rounded.radius, Nested(moved_by(*rounded.shape, way))};
  }
  Shape operator()(const MinkowskiSum& sum) const {
    MinkowskiSum moved = sum;
    moved.shapes.front() = Nested(moved_by(*sum.shapes.front(), way));
    return moved;
  }
  Shape operator()(const MinkowskiDifference& difference) const {
    return MinkowskiDifference{Nested(moved_by(*difference.a, way)), difference.b};
  }
  Shape operator()(const HullOf& hull) const {
    HullOf moved;
    for (const Nested& shape : hull.shapes) moved.shapes.push_back(Nested(moved_by(*shape, way)));
    return moved;
  }
};

}  // namespace

AboutMiddle about_middle(const Shape& shape, const ComposedMap& map) {
  return std::visit(Rebuilder{map}, shape.kind);
}

double loss_of_turns(const Shape& shape, const ComposedMap& map, double similarity) {
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

Shape moved_by(const Shape& shape, const Vec3<double>& way) {
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
