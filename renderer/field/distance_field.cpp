// SPDX-License-Identifier: MIT
#include "renderer/field/distance_field.h"

#include <atomic>
#include <cmath>

#include "core/mesh/mapped.h"
#include "core/pair/closed_answer.h"
#include "core/pair_distance/half_space_distance.h"
#include "core/parallel/parallel.h"
#include "core/parts/parts_distance.h"
#include "renderer/base/errors.h"

namespace minkray {
namespace {

struct Body {
  ContactShape shape;
  Affine<double> pose;  ///< that does not turn
  std::optional<PlacedPlane> plane;
  std::shared_ptr<const TriangleMesh> mesh = {};

  PartsBody parts() const { return mesh ? PartsBody(*mesh) : PartsBody(shape); }
};

/// The gap of the balls around two shapes, or a little less for rounding.
double gap_of_balls(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                    const Affine<double>& pose_b) {
  const Between between = between_middles(a, pose_a, b, pose_b);
  const double distance = length_of(between.x), size = a.ball_radius() + b.ball_radius();
  return distance - size - core_rounding * (distance + size) - between.loss;
}

}  // namespace

FieldPlane plane_facing(const Vec3<double>& middle, const Vec3<double>& normal, double extent,
                        int width, int height) {
  constexpr double nearly_along_z = 0.99;
  const Vec3<double> n = unit<double>(normal);
  const Vec3<double> up_wish =
      std::abs(n.z()) > nearly_along_z ? Vec3<double>::UnitY() : Vec3<double>::UnitZ();
  const Vec3<double> right = unit<double>(up_wish.cross(n)), up = n.cross(right);
  const double pixel = extent / width;
  FieldPlane plane{width, height, {}, pixel * right, -pixel * up};
  plane.corner = middle - (width / 2.0) * plane.right - (height / 2.0) * plane.down;
  return plane;
}

DistanceField measure_field(const Scene& scene, const Shape& probe, const FieldPlane& plane,
                            const FieldOptions& options) {
  if (!scene.particles.empty()) throw BadInput("distances from particles are not measured");
  std::vector<Body> bodies;
  for (const Object& object : scene.objects) {
    if (object.mesh) {
      bodies.push_back({ContactShape(Shape(Point())),
                        {Mat3<double>::Identity(), object.pose.translation},
                        {},
                        mapped(*object.mesh, {object.pose.linear, Vec3<double>::Zero()})});
      continue;
    }
    const Affine<double> about_origin{object.pose.linear, Vec3<double>::Zero()};
    bodies.push_back({ContactShape(object.shape, about_origin),
                      {Mat3<double>::Identity(), object.pose.translation},
                      {}});
    if (object.half_space)
      bodies.back().plane =
          PlacedPlane::of(object.half_space->normal, object.half_space->offset, object.pose);
  }
  const ContactShape moving(probe);
  const auto width = static_cast<std::size_t>(plane.width),
             height = static_cast<std::size_t>(plane.height);
  DistanceField field;
  field.plane = plane;
  const double none = std::numeric_limits<double>::infinity();
  field.value.assign(width * height, none);
  field.lower = field.upper = field.value;
  field.object.assign(width * height, -1);
  std::atomic<std::size_t> supports{0};
  parallel_for(height, 1, [&](std::size_t begin, std::size_t end) {
    std::size_t asked = 0;
    for (std::size_t y = begin; y < end; ++y) {
      if (options.go_on && !options.go_on()) return;
      for (std::size_t x = 0; x < width; ++x) {
        const std::size_t pixel = y * width + x;
        const Affine<double> pose{Mat3<double>::Identity(),
                                  plane.at(static_cast<int>(x), static_cast<int>(y))};
        double& value = field.value[pixel];
        double unknown_from = none;  // objects of unknown distance may be as near as this
        for (std::size_t i = 0; i < bodies.size(); ++i) {
          const Body& body = bodies[i];
          SignedDistance found;
          if (body.plane) {
            found = distance_to_half_space(*body.plane, moving, pose.linear,
                                           placed_middle(moving, pose));
          } else {
            const double apart =
                body.mesh ? -none : gap_of_balls(moving, pose, body.shape, body.pose);
            if (apart > value) continue;
            SignedDistanceOptions how;
            how.tolerance = options.tolerance;
            how.at_most = value;
            found = signed_distance(body.parts(), body.pose, moving, pose, how);
            if (found.is_unknown()) found.lower = std::max(found.lower, apart);
          }
          asked += static_cast<std::size_t>(found.supports);
          field.lower[pixel] = std::min(field.lower[pixel], found.lower);
          field.upper[pixel] = std::min(field.upper[pixel], found.upper);
          if (found.is_unknown()) unknown_from = std::min(unknown_from, found.lower);
          if (found.is_unknown() || !(found.value < value)) continue;
          value = found.value;
          field.object[pixel] = static_cast<int>(i);
        }
        if (unknown_from < value) field.object[pixel] = -1;
      }
    }
    supports += asked;
  });
  field.supports = supports;
  return field;
}

}  // namespace minkray
