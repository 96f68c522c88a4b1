// SPDX-License-Identifier: MIT
// The shape cast, and where the two shapes touch at its end.
#include "core/shape_cast/shape_cast.h"

#include "core/pair_distance/signed_distance.h"
#include "core/shape_cast/distance.h"

namespace minkray {
namespace {

/// Finds the contact: the closest points of the two at the time of impact. At that time they
/// touch, and a simplex around a common point on the boundary is as flat as rounding makes it; so
/// B is taken back along the normal by a rounding error, and by more where that leaves them
/// touching still. Where they graze each other, the distance query may end with points that are
/// not the closest: points that are further apart than its steps explain are computed by the
/// signed distance.
template <class T>
void find_contact(const PreparedPair<T>& pair, const Vec3<T>& direction,
                  ShapeCastResult<T>& result) {
  // Relative to A's centre, where t_base alone would take B far off: first back, then on.
  CentredShape<T> a = pair.a(), b = pair.b();
  const Vec3<T> world_a = a.centre;
  Vec3<T> offset = b.centre - world_a;
  offset = (offset + result.cast.t_base * direction).eval();
  offset += result.cast.t_offset * direction;
  a.centre.setZero();
  DistanceOptions<T, 3> options;
  options.v0 = result.cast.normal;
  const T size = std::min(a.radius + b.radius, std::numeric_limits<T>::max());
  Vec3<T> point_a = Vec3<T>::Zero(), point_b = Vec3<T>::Zero();
  for (const T step : tolerance::contact_back_off<T>) {
    const Vec3<T> backed_off = step * size * result.cast.normal;
    b.centre = offset + backed_off;
    const DistanceResult<T, 3> closest = distance_between(a, b, options);
    point_a = closest.point_a;
    point_b = closest.point_b - backed_off;
    if (result.cast.status == Status::inside || closest.status == DistanceStatus::separated) break;
  }
  const T most = tolerance::contact_back_off<T>[1] * size;
  if (result.cast.status == Status::hit && !((point_b - point_a).norm() <= most)) {
    Affine<double> of_b;
    of_b.translation = offset.template cast<double>();
    const SignedDistance touch =
        signed_distance(ContactShape(a.about_centre), {}, ContactShape(b.about_centre), of_b);
    if ((touch.point_b - touch.point_a).norm() < double((point_b - point_a).norm())) {
      point_a = touch.point_a.template cast<T>();
      point_b = touch.point_b.template cast<T>();
    }
  }
  result.point_a = world_a + point_a;
  result.point_b = world_a + point_b;
}

}  // namespace

template <class T>
ShapeCastResult<T> cast_shape(const PreparedPair<T>& pair, const Vec3<T>& direction, T t_max,
                              const CastOptions<T>& options, const CastObserver<T>& observer) {
  const Ray<T> ray{pair.b().centre - pair.a().centre, direction, t_max};
  ShapeCastResult<T> result;
  result.cast = cast_ray(pair.obstacle(), ray, options, observer);
  if (result.cast.found()) find_contact(pair, direction, result);
  return result;
}

template <class T>
ShapeCastResult<T> cast_shapes(const PreparedPair<T>& pair, const Vec3<T>& velocity_a,
                               const Vec3<T>& velocity_b, T duration,
                               const CastOptions<T>& options) {
  ShapeCastResult<T> result = cast_shape<T>(pair, velocity_b - velocity_a, duration, options);
  if (!result.cast.found()) return result;
  const Vec3<T> moved = result.cast.t() * velocity_a;
  result.point_a += moved;
  result.point_b += moved;
  return result;
}

#define MINKRAY_INSTANTIATE(T)                                                                    \
  template ShapeCastResult<T> cast_shape(const PreparedPair<T>&, const Vec3<T>&, T,               \
                                         const CastOptions<T>&, const CastObserver<T>&);          \
  template ShapeCastResult<T> cast_shapes(const PreparedPair<T>&, const Vec3<T>&, const Vec3<T>&, \
                                          T, const CastOptions<T>&);
MINKRAY_INSTANTIATE(float)
MINKRAY_INSTANTIATE(double)
#undef MINKRAY_INSTANTIATE

}  // namespace minkray
