// SPDX-License-Identifier: MIT
#include "core/derived/recentred.h"

#include <vector>

#include "core/derived/shape_bounds.h"
#include "core/math/bounds.h"

namespace minkray {
namespace {

/// The largest coordinate over the radius from which on a shape is moved. Up to that, rounding is
/// little more than that of the shape itself.
template <class T>
constexpr T far_away = T(4);

/// The nearer end of a part's extent over its length from which on the part's points are moved:
/// differences of its points and its middle are exact then (Sterbenz 1974).
template <class T>
constexpr T far_part = T(0.5);

/// Rounding of the entries of a rotation's matrix that was made of a quaternion.
template <class T>
constexpr T turn_rounding = T(2) * std::numeric_limits<T>::epsilon();

template <class T>
T corner_of(const Bounds<T>& bounds) {
  return bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs()).stableNorm();
}

/// Vector by which to move a part; zero along axes along which there is nothing to gain.
template <class T, class S>
Vec3<T> way_to(const S& shape) {
  const Bounds<T> bounds = bounds_of<T>(shape);
  Vec3<T> way = Vec3<T>::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const T low = bounds.lower[axis], high = bounds.upper[axis];
    const T nearest = low > T(0) ? low : -high;
    if (nearest > far_part<T> * (high - low)) way[axis] = low * T(0.5) + high * T(0.5);
  }
  return way;
}

template <class T>
Vec3<T> moved_back(const Vec3<T>& point, const TwoFoldVec3<T>& way) {
  return (TwoFoldVec3<T>(point) - way).rounded();
}

/// A shape of this kind, `way` nearer to the origin; nothing for kinds that have no place.
template <class T>
struct MovedBack {
  const TwoFoldVec3<T>& way;

  std::optional<Shape<T>> operator()(const Hull<T>& hull) const {
    std::vector<Vec3<T>> moved;
    for (const Vec3<T>& p : hull.points.points()) moved.push_back(moved_back(p, way));
    return Hull<T>{PointCloud<T>(std::move(moved))};
  }
  std::optional<Shape<T>> operator()(const Triangle<T>& triangle) const {
    return points_of(triangle);
  }
  std::optional<Shape<T>> operator()(const Segment<T>& segment) const { return points_of(segment); }
  std::optional<Shape<T>> operator()(const CutCylinder<T>& cylinder) const {
    if (way.high.x() != T(0) || way.high.y() != T(0)) return {};
    CutCylinder<T> moved = cylinder;
    for (T& height : moved.heights) height = moved_back(Vec3<T>(T(0), T(0), height), way).z();
    return moved;
  }
  template <class S>
  std::optional<Shape<T>> operator()(const S&) const {
    return {};
  }

 private:
  template <class S>
  Shape<T> points_of(S shape) const {
    for (Vec3<T>& point : shape.points) point = moved_back(point, way);
    return shape;
  }
};

template <class T>
Recentred<T> taken_out(const Shape<T>& shape);

/// A part of a hull as it is seen from `way`; parts that are points remain points.
template <class T>
Shape<T> part_seen_from(const TwoFoldVec3<T>& way, const Shape<T>& part, T& loss) {
  if (std::optional<Shape<T>> nearer = std::visit(MovedBack<T>{way}, part.kind))
    return *std::move(nearer);
  Recentred<T> own = taken_out(part);
  loss = std::max(loss, own.loss);
  const Vec3<T> offset = (own.moved - way).rounded();
  if (offset.isZero(0)) return std::move(own.shape);
  Affine<T> map{Mat3<T>::Identity(), offset};
  if (const auto* turned = std::get_if<Transform<T>>(&own.shape.kind)) {
    map.linear = turned->map.affine().linear;
    return Transform<T>{turned->shape, map};
  }
  return Transform<T>{Nested<T>(std::move(own.shape)), map};
}

/// Takes translations out, each kind of shape in its own way.
template <class T>
struct TakenOut {
  const Shape<T>& whole;

  Recentred<T> operator()(const Transform<T>& shape) const {
    const Affine<T>& map = shape.map.affine();
    Recentred<T> inner = taken_out(*shape.shape);
    const TwoFoldVec3<T> moved = image_of(map, inner.moved);
    if (map.linear == Mat3<T>::Identity()) return {std::move(inner.shape), moved, inner.loss};
    const T loss = stretch_of(map.linear) * inner.loss +
                   loss_of_turning(map.linear, inner.moved.high.stableNorm());
    const Affine<T> turn{map.linear, Vec3<T>::Zero()};
    return {Transform<T>{Nested<T>(std::move(inner.shape)), turn}, moved, loss};
  }
  Recentred<T> operator()(const Rounded<T>& shape) const {
    Recentred<T> core = taken_out(*shape.shape);
    return {Rounded<T>{shape.radius, Nested<T>(std::move(core.shape))}, core.moved, core.loss};
  }
  Recentred<T> operator()(const MinkowskiSum<T>& sum) const {
    MinkowskiSum<T> nearer;
    TwoFoldVec3<T> moved;
    T loss = T(0);
    for (const Nested<T>& shape : sum.shapes) {
      Recentred<T> part = taken_out(*shape);
      moved = moved + part.moved;
      loss += part.loss;
      nearer.shapes.push_back(std::move(part.shape));
    }
    return {std::move(nearer), moved, loss};
  }
  Recentred<T> operator()(const MinkowskiDifference<T>& difference) const {
    Recentred<T> a = taken_out(*difference.a), b = taken_out(*difference.b);
    return {MinkowskiDifference<T>{Nested<T>(std::move(a.shape)), Nested<T>(std::move(b.shape))},
            a.moved - b.moved, a.loss + b.loss};
  }
  Recentred<T> operator()(const HullOf<T>& hull) const {
    const TwoFoldVec3<T> way(way_to<T>(hull));
    HullOf<T> nearer;
    T loss = T(0);
    for (const Nested<T>& shape : hull.shapes)
      nearer.shapes.push_back(part_seen_from(way, *shape, loss));
    return {std::move(nearer), way, loss};
  }
  Recentred<T> operator()(const Custom<T>&) const { return {whole, {}, T(0)}; }
  /// Those that have no parts.
  template <class S>
  Recentred<T> operator()(const S& shape) const {
    const TwoFoldVec3<T> way(way_to<T>(shape));
    if (way.is_zero()) return {whole, {}, T(0)};
    if (std::optional<Shape<T>> nearer = MovedBack<T>{way}(shape))
      return {*std::move(nearer), way, T(0)};
    return {whole, {}, T(0)};
  }
};

template <class T>
Recentred<T> taken_out(const Shape<T>& shape) {
  return std::visit(TakenOut<T>{shape}, shape.kind);
}

/// Handles each kind of shape.
template <class T>
struct LargestCoordinate {
  T operator()(const Transform<T>& shape) const {
    const Affine<T>& map = shape.map.affine();
    return stretch_of(map.linear) * largest_coordinate(*shape.shape) + map.translation.stableNorm();
  }
  T operator()(const Rounded<T>& shape) const {
    return shape.radius + largest_coordinate(*shape.shape);
  }
  T operator()(const MinkowskiSum<T>& sum) const {
    T all = T(0);
    for (const Nested<T>& shape : sum.shapes) all += largest_coordinate(*shape);
    return all;
  }
  T operator()(const MinkowskiDifference<T>& difference) const {
    return largest_coordinate(*difference.a) + largest_coordinate(*difference.b);
  }
  T operator()(const HullOf<T>& hull) const {
    T largest = T(0);
    for (const Nested<T>& shape : hull.shapes)
      largest = std::max(largest, largest_coordinate(*shape));
    return largest;
  }
  template <class S>
  T operator()(const S& shape) const {
    return corner_of(bounds_of<T>(shape));
  }
};

}  // namespace

template <class T>
T stretch_of(const Mat3<T>& linear) {
  const T size = linear.cwiseAbs().maxCoeff();
  const Mat3<T> scaled = linear / size;
  return size * std::sqrt((scaled * scaled.transpose()).cwiseAbs().rowwise().sum().maxCoeff());
}

template <class T>
T loss_of_turning(const Mat3<T>& linear, T distance) {
  const bool is_as_given =
      ((linear.array() != T(0)).template cast<int>().rowwise().sum() == 1).all();
  return is_as_given ? T(0) : turn_rounding<T> * stretch_of(linear) * distance;
}

template <class T>
T largest_coordinate(const Shape<T>& shape) {
  return std::visit(LargestCoordinate<T>(), shape.kind);
}

template <class T>
std::optional<Recentred<T>> recentred(const Shape<T>& shape) {
  if (std::holds_alternative<Custom<T>>(shape.kind)) return {};  // supports may be expensive
  const T radius = bounds_of<T>(shape).half_extents().stableNorm();
  const T largest = largest_coordinate(shape);
  if (!(largest > far_away<T> * radius)) return {};
  Recentred<T> nearer = taken_out(shape);
  if (nearer.moved.is_zero() && !(largest_coordinate(nearer.shape) < largest)) return {};
  return nearer;
}

template std::optional<Recentred<float>> recentred(const Shape<float>&);
template std::optional<Recentred<double>> recentred(const Shape<double>&);
template double stretch_of(const Mat3<double>&);
template float stretch_of(const Mat3<float>&);
template double loss_of_turning(const Mat3<double>&, double);
template float loss_of_turning(const Mat3<float>&, float);
template float largest_coordinate(const Shape<float>&);
template double largest_coordinate(const Shape<double>&);

}  // namespace minkray
