// SPDX-License-Identifier: MIT
#include "core/derived/recentred.h"

#include "core/derived/shape_bounds.h"
#include "core/math/bounds.h"

namespace minkray {
namespace {

/// It is the nearer end of an extent over its length. Nearer than that, the rounding to be avoided
/// is little more than that of the shape itself. Above 2, differences to the middle are exact
/// (Sterbenz 1974).
template <class T>
constexpr T far_away = T(8);

/// Tells by how much to move it; zero if there is nothing to gain.
template <class T, class S>
Vec3<T> way_to(const S& shape) {
  const Bounds<T> bounds = bounds_of<T>(shape);
  Vec3<T> way = Vec3<T>::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const T low = bounds.lower[axis], high = bounds.upper[axis];
    const T nearest = low > T(0) ? low : -high;
    if (nearest > far_away<T> * (high - low)) way[axis] = low * T(0.5) + high * T(0.5);
  }
  return way;
}

template <class T, class S>
bool is_far_away(const S& shape) {
  return !way_to<T>(shape).isZero(0);
}

/// Whether the sums of `a` and `b` are not rounded (the error of Knuth's two-sum is zero).
template <class T>
bool is_exact_sum(const Vec3<T>& a, const Vec3<T>& b) {
  const Vec3<T> sum = a + b, of_b = sum - a;
  return ((a - (sum - of_b)) + (b - of_b)).isZero(0);
}

/// What is `way` nearer to the origin, if nothing of it is rounded.
template <class T>
class MovedBack {
 public:
  explicit MovedBack(Vec3<T> way) : way_(std::move(way)) {}

  std::optional<Shape<T>> operator()(const Hull<T>& hull) const {
    std::vector<Vec3<T>> moved;
    for (const Vec3<T>& p : hull.points.points()) moved.push_back(p - way_);
    return Hull<T>{PointCloud<T>(std::move(moved))};
  }

  std::optional<Shape<T>> operator()(const Triangle<T>& triangle) const {
    return points_of(triangle);
  }
  std::optional<Shape<T>> operator()(const Segment<T>& segment) const { return points_of(segment); }

  std::optional<Shape<T>> operator()(const CutCylinder<T>& cylinder) const {
    if (way_.x() != T(0) || way_.y() != T(0)) return {};
    CutCylinder<T> moved = cylinder;
    for (T& height : moved.heights) height -= way_.z();
    return moved;
  }

  std::optional<Shape<T>> operator()(const Transform<T>& shape) const {
    Affine<T> map = shape.map.affine();
    const Transform<T> turned{shape.shape, Affine<T>{map.linear, Vec3<T>::Zero()}};
    if (is_far_away<T>(turned)) return {};  // its map rounds to that
    if (!is_exact_sum<T>(map.translation, -way_)) return {};
    map.translation -= way_;
    return Transform<T>{shape.shape, map};
  }

  std::optional<Shape<T>> operator()(const HullOf<T>& hull) const {
    HullOf<T> moved;
    for (const Nested<T>& shape : hull.shapes) {
      std::optional<Shape<T>> nearer = std::visit(*this, shape->kind);
      if (!nearer) return {};
      moved.shapes.push_back(*std::move(nearer));
    }
    return moved;
  }

  template <class S>
  std::optional<Shape<T>> operator()(const S&) const {
    return {};
  }

 private:
  template <class S>
  Shape<T> points_of(S shape) const {
    for (Vec3<T>& point : shape.points) point -= way_;
    return shape;
  }

  Vec3<T> way_;
};

/// Each by its own way, where the sum of the ways is not rounded.
template <class T>
std::optional<Recentred<T>> recentred_sum(const MinkowskiSum<T>& sum) {
  if (!is_far_away<T>(sum)) return {};
  MinkowskiSum<T> nearer;
  Vec3<T> moved = Vec3<T>::Zero();
  for (const Nested<T>& shape : sum.shapes) {
    std::optional<Recentred<T>> part = recentred(*shape);
    if (part && is_exact_sum<T>(moved, part->moved)) {
      moved += part->moved;
      nearer.shapes.push_back(std::move(part->shape));
    } else {
      nearer.shapes.push_back(shape);
    }
  }
  if (is_far_away<T>(nearer)) return {};
  return Recentred<T>{std::move(nearer), moved};
}

}  // namespace

template <class T>
std::optional<Recentred<T>> recentred(const Shape<T>& shape) {
  if (const auto* sum = std::get_if<MinkowskiSum<T>>(&shape.kind)) return recentred_sum(*sum);
  if (const auto* rounded = std::get_if<Rounded<T>>(&shape.kind)) {
    auto core = recentred(*rounded->shape);
    if (!core) return {};
    return Recentred<T>{Rounded<T>{rounded->radius, Nested<T>(std::move(core->shape))},
                        core->moved};
  }
  if (std::holds_alternative<Custom<T>>(shape.kind)) return {};  // whose supports may be dear
  const Vec3<T> way = way_to<T>(shape);
  if (way.isZero(0)) return {};
  std::optional<Shape<T>> nearer = std::visit(MovedBack<T>(way), shape.kind);
  if (!nearer) return {};
  return Recentred<T>{*std::move(nearer), way};
}

template std::optional<Recentred<float>> recentred(const Shape<float>&);
template std::optional<Recentred<double>> recentred(const Shape<double>&);

}  // namespace minkray
