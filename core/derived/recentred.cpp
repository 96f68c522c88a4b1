// SPDX-License-Identifier: MIT
#include "core/derived/recentred.h"

#include <array>
#include <span>

#include "core/derived/shape_bounds.h"
#include "core/math/bounds.h"

namespace minkray {
namespace {

/// It is the nearer end of an extent over its length. Nearer than that, the rounding to be avoided
/// is little more than that of the shape itself. Above 2, differences to the middle are exact
/// (Sterbenz 1974).
template <class T>
constexpr T far_away = T(8);

/// Tells by how much to move them; zero if there is nothing to gain.
template <class T>
Vec3<T> way_to(std::span<const Vec3<T>> points) {
  Bounds<T> bounds;
  for (const Vec3<T>& p : points) bounds.extend(p);
  Vec3<T> way = Vec3<T>::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const T low = bounds.lower[axis], high = bounds.upper[axis];
    const T nearest = low > T(0) ? low : -high;
    if (nearest > far_away<T> * (high - low)) way[axis] = low * T(0.5) + high * T(0.5);
  }
  return way;
}

template <class T>
std::vector<Vec3<T>> moved_back(std::span<const Vec3<T>> points, const Vec3<T>& way) {
  std::vector<Vec3<T>> moved;
  for (const Vec3<T>& p : points) moved.push_back(p - way);
  return moved;
}

}  // namespace

template <class T>
std::optional<Recentred<T>> recentred(const Shape<T>& shape) {
  return std::visit(
      [&]<class S>(const S& kind) -> std::optional<Recentred<T>> {
        if constexpr (std::is_same_v<S, Hull<T>>) {
          const Vec3<T> way = way_to<T>(kind.points.points());
          if (way.isZero(0)) return {};
          return Recentred<T>{Hull<T>{PointCloud<T>(moved_back<T>(kind.points.points(), way))},
                              way};
        } else if constexpr (std::is_same_v<S, Triangle<T>> || std::is_same_v<S, Segment<T>>) {
          const Vec3<T> way = way_to<T>(kind.points);
          if (way.isZero(0)) return {};
          S moved = kind;
          for (Vec3<T>& point : moved.points) point -= way;
          return Recentred<T>{moved, way};
        } else if constexpr (std::is_same_v<S, Rounded<T>>) {
          auto core = recentred(*kind.shape);
          if (!core) return {};
          return Recentred<T>{Rounded<T>{kind.radius, Nested<T>(std::move(core->shape))},
                              core->moved};
        } else if constexpr (std::is_same_v<S, CutCylinder<T>>) {
          const Bounds<T> bounds = bounds_of<T>(kind);
          const Vec3<T> way = way_to<T>(std::array{bounds.lower, bounds.upper});
          if (way.isZero(0)) return {};
          S moved = kind;
          for (T& height : moved.heights) height -= way.z();
          return Recentred<T>{moved, way};
        } else {
          return {};
        }
      },
      shape.kind);
}

template std::optional<Recentred<float>> recentred(const Shape<float>&);
template std::optional<Recentred<double>> recentred(const Shape<double>&);

}  // namespace minkray
