// SPDX-License-Identifier: MIT
// Casts shapes, and finds where they touch at the time of impact.
#include "renderer/paper/shape_cast.h"

#include "core/pair_distance/signed_distance.h"
#include "renderer/paper/distance.h"

namespace minkray {
namespace {

/// Finds the contact: the closest points of the two shapes at the time of impact. The shapes then
/// touch, and a simplex around a common point is flat up to rounding. So B is moved back along the
/// normal by a rounding error, and further if the shapes still touch. For grazing contacts, the
/// distance query may end with points that are not the closest. If the points are further apart
/// than the moves of B explain, the signed distance gives the points.
void find_contact(const PreparedPair& pair, const Vec3<double>& direction,
                  ShapeCastResult& result) {
  // Adds t_base first, which brings B near A. All positions are relative to A's centre.
  CentredShape a = pair.a(), b = pair.b();
  const Vec3<double> world_a = a.centre;
  Vec3<double> offset = b.centre - world_a;
  offset = (offset + result.cast.t_base * direction).eval();
  offset += result.cast.t_offset * direction;
  a.centre.setZero();
  DistanceOptions<double, 3> options;
  options.v0 = result.cast.normal;
  const double size = std::min(a.radius + b.radius, std::numeric_limits<double>::max());
  Vec3<double> point_a = Vec3<double>::Zero(), point_b = Vec3<double>::Zero();
  for (const double step : tolerance::contact_back_off<double>) {
    const Vec3<double> backed_off = step * size * result.cast.normal;
    b.centre = offset + backed_off;
    const DistanceResult<double, 3> closest = distance_between(a, b, options);
    point_a = closest.point_a;
    point_b = closest.point_b - backed_off;
    if (result.cast.status == Status::inside || closest.status == DistanceStatus::separated) break;
  }
  const double most = tolerance::contact_back_off<double>[1] * size;
  if (result.cast.status == Status::hit && !((point_b - point_a).norm() <= most)) {
    Affine<double> of_b;
    of_b.translation = offset;
    const SignedDistance touch =
        signed_distance(ContactShape(a.about_centre), {}, ContactShape(b.about_centre), of_b);
    if ((touch.point_b - touch.point_a).norm() < double((point_b - point_a).norm())) {
      point_a = touch.point_a;
      point_b = touch.point_b;
    }
  }
  result.point_a = world_a + point_a;
  result.point_b = world_a + point_b;
}

}  // namespace

ShapeCastResult cast_shape(const PreparedPair& pair, const Vec3<double>& direction, double t_max,
                           const CastOptions& options, const CastObserver& observer) {
  const Ray<double> ray{pair.b().centre - pair.a().centre, direction, t_max};
  ShapeCastResult result;
  result.cast = cast_ray(pair.obstacle(), ray, options, observer);
  if (result.cast.found()) find_contact(pair, direction, result);
  return result;
}

ShapeCastResult cast_shapes(const PreparedPair& pair, const Vec3<double>& velocity_a,
                            const Vec3<double>& velocity_b, double duration,
                            const CastOptions& options) {
  ShapeCastResult result = cast_shape(pair, velocity_b - velocity_a, duration, options);
  if (!result.cast.found()) return result;
  const Vec3<double> moved = result.cast.t() * velocity_a;
  result.point_a += moved;
  result.point_b += moved;
  return result;
}

}  // namespace minkray
