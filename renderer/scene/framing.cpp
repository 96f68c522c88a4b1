// SPDX-License-Identifier: MIT
#include "renderer/scene/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/parts/compound.h"
#include "core/world/half_space.h"
#include "renderer/scene/summary.h"

namespace minkray {
namespace {

constexpr double default_fov_y_degrees = 36;
/// Wider lenses, and those of fisheyes, are framed as this one.
constexpr double widest_framed_degrees = 90;
/// A camera that a scene does not place leaves more free around, as pictures of things do.
constexpr double part_of_lens = 0.8;

/// Largest turn of a body between two moments at which it is framed, in radians: keys are
/// subdivided so that the body's motion in between is far less than the margin.
constexpr double most_turn = 0.1;
/// However many keys and bodies there are: so that the camera is found in seconds.
constexpr std::size_t most_placings = 300'000;
/// The search for where the bodies are in the middle of the picture ends at a thousandth of a
/// pixel.
constexpr int halvings = 24;
/// A fraction of half the longest side. A segment in the line of sight would touch the camera else.
constexpr double skin_of_size = 0.01;

/// A body at its pose of one moment, or a box.
struct PlacedBody {
  const Object* object;  ///< null: a box
  Affine<double> pose;
  Bounds<double> box = {};

  /// The largest n . x of its points x.
  double support_value(const Vec3<double>& n) const {
    if (!object) return n.cwiseProduct(box.lower).cwiseMax(n.cwiseProduct(box.upper)).sum();
    const Vec3<double> inner = pose.linear.transpose() * n;
    if (object->has_shape()) return n.dot(pose(object->shape.support(inner)));
    double most = -std::numeric_limits<double>::infinity();
    if (const Compound* const compound = object->compound.get()) {
      for (std::size_t i = 0; i < compound->size(); ++i) {
        const auto& [shape, place] = compound->part(i);
        const Vec3<double> own = place.linear.transpose() * inner;
        most = std::max(most, n.dot(pose(place(shape.support(own)))));
      }
      return most;
    }
    for (const Vec3<double>& vertex : object->mesh->vertices())
      most = std::max(most, inner.dot(vertex));
    return most + n.dot(pose.translation);
  }
};

/// Angle between the quaternions of two keys, in radians.
double turn_between(const PoseKey& a, const PoseKey& b) {
  double cosine = 0;
  for (std::size_t i = 0; i < 4; ++i) cosine += a.rotate[i] * b.rotate[i];
  return 2 * std::acos(std::min(std::abs(cosine), 1.0));
}

/// The bodies at all moments of their motion.
std::vector<PlacedBody> placings(const Scene& scene) {
  std::vector<PlacedBody> bodies;
  for (const Object& object : scene.objects) {
    if (object.half_space || object.visible_to == 0) continue;
    if (object.mesh && object.mesh->sides() == MeshSides::front) continue;  // a plane
    if (!object.motion || object.motion->keys.empty()) {
      bodies.push_back({&object, object.pose});
      continue;
    }
    const std::vector<PoseKey>& keys = object.motion->keys;
    for (std::size_t k = 0; k < keys.size() && bodies.size() < most_placings; ++k) {
      bodies.push_back({&object, object.motion->pose_at(keys[k].time)});
      if (k + 1 == keys.size()) break;
      const double steps = std::ceil(turn_between(keys[k], keys[k + 1]) / most_turn);
      for (int i = 1; i < steps; ++i)
        bodies.push_back(
            {&object, object.motion->pose_at(std::lerp(keys[k].time, keys[k + 1].time,
                                                       static_cast<double>(i) / steps))});
    }
  }
  return bodies;
}

/// The axes of a camera: orthonormal, `up` of the picture.
struct Axes {
  Vec3<double> right, up, forward;
};

Axes axes_looking(const Vec3<double>& forward) {
  const Vec3<double> right = unit<double>(forward.cross(Vec3<double>(0, 0, 1)));
  return {right, right.cross(forward), forward};
}

/// Boxes around each set of particles.
void add_particles(const Scene& scene, std::vector<PlacedBody>& bodies) {
  for (const ParticleSet& set : scene.particles) {
    const Bounds<double> box = bounds_of(set);
    if (set.visible_to != 0 && !box.empty()) bodies.push_back({nullptr, {}, box});
  }
}

/// All bodies as one: their hull, in a skin that gives even a point a size.
struct Framed {
  std::vector<PlacedBody> bodies;
  double skin = 0;

  double support_value(const Vec3<double>& n) const {
    double largest = -std::numeric_limits<double>::infinity();
    for (const PlacedBody& body : bodies) largest = std::max(largest, body.support_value(n));
    return largest + skin * n.norm();
  }
};

/// Between the two planes of a frustum that meet in a line: how far that line lies to the side and
/// forward, as far forward as it can.
struct Wedge {
  double side, forward;
};

Wedge wedge_around(const Framed& all, const Vec3<double>& side, const Vec3<double>& forward,
                   double tangent) {
  // Every point x has x . side - s <= tangent (x . forward - f), and so on the other side.
  const double h = all.support_value(side - tangent * forward);
  const double h_other = all.support_value(-side - tangent * forward);
  return {(h - h_other) / 2, -(h + h_other) / (2 * tangent)};
}

/// Sideways offset of a camera at this forward distance, so that as much is free on one side of
/// the picture as on the other: within the wedge with the tangent, at most the given one, whose
/// line lies there. The narrower a wedge, the further back it begins.
double middle_of_picture(const Framed& all, const Vec3<double>& side, const Vec3<double>& forward,
                         double tangent, double place) {
  double narrow = 0, wide = tangent;
  for (int i = 0; i < halvings; ++i) {
    const double between = (narrow + wide) / 2;
    (wedge_around(all, side, forward, between).forward < place ? narrow : wide) = between;
  }
  return wedge_around(all, side, forward, wide).side;
}

bool is_in_a_half_space(const Scene& scene, const Vec3<double>& point) {
  return std::ranges::any_of(scene.objects, [&](const Object& object) {
    if (!object.half_space) return false;
    const HalfSpaceBody<double> placed = object.half_space->posed(object.pose);
    return placed.normal.dot(point) <= placed.offset;
  });
}

/// View directions to try, in order: from the front, the right and above, then from the other
/// sides; more steeply, level, from below, and down into a box of planes.
std::vector<Vec3<double>> directions_to_look() {
  std::vector<Vec3<double>> directions;
  for (const double height : {0.9, 2.7, 0.0, -0.9, 12.0, 200.0})
    for (const auto& [x, y] : {std::pair{2.1, -1.7}, {1.7, 2.1}, {-2.1, 1.7}, {-1.7, -2.1}})
      directions.push_back(-unit<double>(Vec3<double>(x, y, height)));
  return directions;
}

}  // namespace

View view_of_everything(const Scene& scene, double fov_y_degrees, const Resolution& picture) {
  View view{{0, -1, 0}, {0, 0, 0}};
  constexpr double kept = 1 - 2 * framing_margin;
  const double tan_y = kept * std::tan(fov_y_degrees * std::numbers::pi / 360);
  const double tan_x = tan_y * picture.width / picture.height;

  Framed all{placings(scene)};
  add_particles(scene, all.bodies);
  const Object nothing;
  if (all.bodies.empty()) all.bodies.push_back({&nothing, {}});
  double size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3<double> n = Vec3<double>::Unit(axis);
    size = std::max(size, (all.support_value(n) + all.support_value(-n)) / 2);
  }
  all.skin = size > 0 ? skin_of_size * size : 1;

  bool is_first = true;
  for (const Vec3<double>& forward : directions_to_look()) {
    const Axes axes = axes_looking(forward);
    const Wedge across = wedge_around(all, axes.right, forward, tan_x);
    const Wedge along = wedge_around(all, axes.up, forward, tan_y);
    const double nearest = std::min(across.forward, along.forward);
    const double to_right = across.forward == nearest
                                ? across.side
                                : middle_of_picture(all, axes.right, forward, tan_x, nearest);
    const double upwards = along.forward == nearest
                               ? along.side
                               : middle_of_picture(all, axes.up, forward, tan_y, nearest);
    const double middle = (all.support_value(forward) - all.support_value(-forward)) / 2;
    const Vec3<double> position = to_right * axes.right + upwards * axes.up + nearest * forward;
    const bool is_free = !is_in_a_half_space(scene, position);
    if ((is_first || is_free) && position.allFinite()) {
      view = {position, position + (middle - nearest) * forward};
    }
    if (is_free) break;
    is_first = false;
  }
  return view;
}

void frame_everything(Scene& scene, const Resolution& picture) {
  CameraDescription& camera = scene.camera;
  camera.fov_y_degrees = default_fov_y_degrees;
  camera.resolution = picture;
  const View view = view_of_everything(scene, camera.fov_y_degrees, picture);
  camera.position = view.position;
  camera.look_at = view.look_at;
}

void frame_with_own_lens(Scene& scene) {
  CameraDescription& camera = scene.camera;
  const double framed = part_of_lens * std::min(camera.fov_y_degrees, widest_framed_degrees);
  const View view = view_of_everything(scene, framed, camera.resolution);
  camera.position = view.position;
  camera.look_at = view.look_at;
}

}  // namespace minkray
