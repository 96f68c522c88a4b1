// SPDX-License-Identifier: MIT
#include "core/derived/recentred.h"

#include <vector>

#include "core/derived/shape_bounds.h"
#include "core/math/bounds.h"
#include "core/support/declared.h"

namespace minkray {
namespace {

/// Least ratio of the largest coordinate to the radius for which a shape is moved. For smaller
/// ratios, rounding is little more than that of the shape itself.
constexpr double far_away = 4.0;

/// Least ratio of a part's distance from the origin to its length, per axis, for which its points
/// are moved. Differences of its points and its middle are then exact (Sterbenz 1974).
constexpr double far_part = 0.5;

/// Rounding of the entries of a rotation matrix that was computed from a quaternion.
constexpr double turn_rounding = 2.0 * std::numeric_limits<double>::epsilon();

double corner_of(const Bounds<double>& bounds) {
  return bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs()).stableNorm();
}

/// Vector by which to move a part. Zero along axes for which a move has no benefit.
template <class S>
Vec3<double> way_to(const S& shape) {
  const Bounds<double> bounds = bounds_of(shape);
  Vec3<double> way = Vec3<double>::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const double low = bounds.lower[axis], high = bounds.upper[axis];
    const double nearest = low > 0.0 ? low : -high;
    if (nearest > far_part * (high - low)) way[axis] = low * 0.5 + high * 0.5;
  }
  return way;
}

Vec3<double> moved_back(const Vec3<double>& point, const TwoFoldVec3<double>& way) {
  return (TwoFoldVec3<double>(point) - way).rounded();
}

/// Returns the shape moved by -`way`; nothing for kinds without coordinates that can be moved.
struct MovedBack {
  const TwoFoldVec3<double>& way;

  std::optional<Shape> operator()(const Hull& hull) const {
    std::vector<Vec3<double>> moved;
    for (const Vec3<double>& p : hull.points.points()) moved.push_back(moved_back(p, way));
    return Hull{PointCloud(std::move(moved))};
  }
  std::optional<Shape> operator()(const Triangle& triangle) const { return points_of(triangle); }
  std::optional<Shape> operator()(const Segment& segment) const { return points_of(segment); }
  template <class S>
  requires(declared_by<S>.heights) std::optional<Shape>
  operator()(const S& shape) const {
    if (way.high.x() != 0.0 || way.high.y() != 0.0) return {};
    S moved = shape;
    for (double& height : moved.heights)
      height = moved_back(Vec3<double>(0.0, 0.0, height), way).z();
    return moved;
  }
  template <class S>
  std::optional<Shape> operator()(const S&) const {
    return {};
  }

 private:
  template <class S>
  Shape points_of(S shape) const {
    for (Vec3<double>& point : shape.points) point = moved_back(point, way);
    return shape;
  }
};

Recentred taken_out(const Shape& shape);

/// Returns a part of a hull, relative to `way`. Shapes given by points remain such shapes.
Shape part_seen_from(const TwoFoldVec3<double>& way, const Shape& part, double& loss) {
  if (std::optional<Shape> nearer = std::visit(MovedBack{way}, part.kind))
    return *std::move(nearer);
  Recentred own = taken_out(part);
  loss = std::max(loss, own.loss);
  const Vec3<double> offset = (own.moved - way).rounded();
  if (offset.isZero(0)) return std::move(own.shape);
  Affine<double> map{Mat3<double>::Identity(), offset};
  if (const auto* turned = std::get_if<Transform>(&own.shape.kind)) {
    map.linear = turned->map.affine().linear;
    return Transform{turned->shape, map};
  }
  return Transform{Nested(std::move(own.shape)), map};
}

/// Removes the translations from each kind of shape.
struct TakenOut {
  const Shape& whole;

  Recentred operator()(const Transform& shape) const {
    const Affine<double>& map = shape.map.affine();
    Recentred inner = taken_out(*shape.shape);
    const TwoFoldVec3<double> moved = image_of(map, inner.moved);
    if (map.linear == Mat3<double>::Identity()) return {std::move(inner.shape), moved, inner.loss};
    const double loss = stretch_of(map.linear) * inner.loss +
                        loss_of_turning(map.linear, inner.moved.high.stableNorm());
    const Affine<double> turn{map.linear, Vec3<double>::Zero()};
    return {Transform{Nested(std::move(inner.shape)), turn}, moved, loss};
  }
  Recentred operator()(const Rounded& shape) const {
    Recentred core = taken_out(*shape.shape);
    return {Rounded{shape.radius, Nested(std::move(core.shape))}, core.moved, core.loss};
  }
  Recentred operator()(const MinkowskiSum& sum) const {
    MinkowskiSum nearer;
    TwoFoldVec3<double> moved;
    double loss = 0.0;
    for (const Nested& shape : sum.shapes) {
      Recentred part = taken_out(*shape);
      moved = moved + part.moved;
      loss += part.loss;
      nearer.shapes.push_back(std::move(part.shape));
    }
    return {std::move(nearer), moved, loss};
  }
  Recentred operator()(const MinkowskiDifference& difference) const {
    Recentred a = taken_out(*difference.a), b = taken_out(*difference.b);
    return {MinkowskiDifference{Nested(std::move(a.shape)), Nested(std::move(b.shape))},
            a.moved - b.moved, a.loss + b.loss};
  }
  Recentred operator()(const HullOf& hull) const {
    const TwoFoldVec3<double> way(way_to(hull));
    HullOf nearer;
    double loss = 0.0;
    for (const Nested& shape : hull.shapes)
      nearer.shapes.push_back(part_seen_from(way, *shape, loss));
    return {std::move(nearer), way, loss};
  }
  Recentred operator()(const Custom&) const { return {whole, {}, 0.0}; }
  /// For shapes without operands.
  template <class S>
  Recentred operator()(const S& shape) const {
    const TwoFoldVec3<double> way(way_to(shape));
    if (way.is_zero()) return {whole, {}, 0.0};
    if (std::optional<Shape> nearer = MovedBack{way}(shape)) return {*std::move(nearer), way, 0.0};
    return {whole, {}, 0.0};
  }
};

Recentred taken_out(const Shape& shape) {
  return std::visit(TakenOut{shape}, shape.kind);
}

/// Handles each kind of shape.
struct LargestCoordinate {
  double operator()(const Transform& shape) const {
    const Affine<double>& map = shape.map.affine();
    return stretch_of(map.linear) * largest_coordinate(*shape.shape) + map.translation.stableNorm();
  }
  double operator()(const Rounded& shape) const {
    return shape.radius + largest_coordinate(*shape.shape);
  }
  double operator()(const MinkowskiSum& sum) const {
    double all = 0.0;
    for (const Nested& shape : sum.shapes) all += largest_coordinate(*shape);
    return all;
  }
  double operator()(const MinkowskiDifference& difference) const {
    return largest_coordinate(*difference.a) + largest_coordinate(*difference.b);
  }
  double operator()(const HullOf& hull) const {
    double largest = 0.0;
    for (const Nested& shape : hull.shapes) largest = std::max(largest, largest_coordinate(*shape));
    return largest;
  }
  template <class S>
  double operator()(const S& shape) const {
    return corner_of(bounds_of(shape));
  }
};

}  // namespace

double stretch_of(const Mat3<double>& linear) {
  const double size = linear.cwiseAbs().maxCoeff();
  const Mat3<double> scaled = linear / size;
  return size * std::sqrt((scaled * scaled.transpose()).cwiseAbs().rowwise().sum().maxCoeff());
}

double loss_of_turning(const Mat3<double>& linear, double distance) {
  const bool is_as_given = ((linear.array() != 0.0).cast<int>().rowwise().sum() == 1).all();
  return is_as_given ? 0.0 : turn_rounding * stretch_of(linear) * distance;
}

double largest_coordinate(const Shape& shape) {
  return std::visit(LargestCoordinate(), shape.kind);
}

std::optional<Recentred> recentred(const Shape& shape) {
  if (std::holds_alternative<Custom>(shape.kind)) return {};  // support calls may be expensive
  const double radius = bounds_of(shape).half_extents().stableNorm();
  const double largest = largest_coordinate(shape);
  if (!(largest > far_away * radius)) return {};
  Recentred nearer = taken_out(shape);
  if (nearer.moved.is_zero() && !(largest_coordinate(nearer.shape) < largest)) return {};
  return nearer;
}

}  // namespace minkray
