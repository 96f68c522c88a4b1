// SPDX-License-Identifier: MIT
#include "renderer/clearance/bodies.h"

#include <algorithm>
#include <map>

#include "core/mesh/mapped.h"
#include "core/parts/compound.h"
#include "core/support/composed_map.h"
#include "renderer/base/errors.h"
#include "renderer/import/model/mesh_hull.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

const Shape nothing = Point();

bool is_rotation(const Mat3<double>& linear) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  return (linear * linear.transpose() - Mat3<double>::Identity()).cwiseAbs().maxCoeff() <=
             rounding &&
         linear.determinant() > 0;
}

/// A map that is no rotation, but for a shift, becomes part of the mesh.
ClearanceBody body_of(const std::string& name, const std::string& link, int link_index,
                      std::shared_ptr<const TriangleMesh> mesh, const Affine<double>& map) {
  ClearanceBody body{name, link, link_index, ContactShape(nothing)};
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  double loss = 0;
  if (is_rotation(map.linear)) {
    body.linear = map.linear;
    body.mesh = std::move(mesh);
  } else {
    body.mesh = mapped(*mesh, {map.linear, Vec3<double>::Zero()});
    loss = rounding * mesh->reach() * map.linear.norm();
  }
  const Vec3<double> centre = body.own_middle();
  body.middle.at = image_of({body.linear, map.translation}, TwoFoldVec3<double>(centre));
  if (!centre.isZero(0) && !is_along_axes(body.linear)) loss += rounding * body.mesh->reach();
  body.middle.loss = loss;
  return body;
}

/// The shape under a map, which may scale: it becomes part of the shape.
ClearanceBody body_of(const std::string& name, const std::string& link, int link_index,
                      const Shape& shape, const Affine<double>& map) {
  ClearanceBody body{name, link, link_index, ContactShape(shape, map)};
  body.middle = placed_middle(body.shape, {});
  return body;
}

/// The hulls of meshes, each made once.
class Hulls {
 public:
  const Shape& of(const std::shared_ptr<const TriangleMesh>& mesh) {
    const auto [at, is_new] = known_.try_emplace(mesh.get(), nothing);
    if (is_new) at->second = hull_of(*mesh);
    return at->second;
  }

 private:
  std::map<const TriangleMesh*, Shape> known_;
};

}  // namespace

double ClearanceBody::ball_radius() const {
  if (!mesh) return shape.ball_radius();
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  return (1 + rounding) * mesh->bounds().reach_of_centre().norm() + rounding * mesh->reach();
}

PlacedPlane moved(PlacedPlane plane, const Affine<double>& pose) {
  plane.normal = pose.linear * plane.normal;
  plane.point = image_of(pose, plane.point);
  return plane;
}

SignedDistance distance_to_half_space(const PlacedPlane& plane, const ClearanceBody& body,
                                      const Mat3<double>& linear, const PlacedMiddle& middle) {
  if (!body.mesh) return distance_to_half_space(plane, body.shape, linear, middle);
  // Seen from the body's middle nothing is far away.
  PlacedPlane near = plane;
  near.point = TwoFoldVec3<double>((plane.point - middle.at).rounded());
  SignedDistance found = distance_to_half_space(
      near, body.parts(), Affine<double>{linear, -(linear * body.own_middle())});
  const double loss =
      middle.loss + core_rounding * (body.mesh->reach() + length_of(near.point.high));
  found.lower -= loss;
  found.upper += loss;
  found.status = found.lower > 0   ? SignedStatus::separated
                 : found.upper < 0 ? SignedStatus::overlapping
                                   : SignedStatus::touching;
  found.point_a += middle.at.rounded();
  found.point_b += middle.at.rounded();
  return found;
}

ClearanceBody seen_from(const Affine<double>& frame, ClearanceBody obstacle) {
  const TwoFoldMat3<double> turned_back(frame.linear.transpose());
  const auto seen = [&](const TwoFoldVec3<double>& point) {
    return turned_back * (point - TwoFoldVec3<double>(frame.translation));
  };
  // The inverse of a map that is rigid to rounding is its transpose, to rounding.
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const bool is_exact = is_along_axes(frame.linear);
  obstacle.linear = turned_back.high * obstacle.linear;
  obstacle.middle.at = seen(obstacle.middle.at);
  if (!is_exact) obstacle.middle.loss += rounding * length_of(obstacle.middle.at.high);
  if (obstacle.plane) {
    obstacle.plane->normal = turned_back.high * obstacle.plane->normal;
    obstacle.plane->point = seen(obstacle.plane->point);
  }
  return obstacle;
}

std::vector<ClearanceBody> bodies_of(const Model& model, GeometryChoice geometry) {
  std::vector<ClearanceBody> bodies;
  const std::vector<bool> wanted = chosen_geoms(model, geometry);
  Hulls hulls;
  for (std::size_t i = 0; i < model.geoms.size(); ++i) {
    const ModelGeom& geom = model.geoms[i];
    if (!wanted[i]) continue;
    const std::string link =
        geom.link < 0 ? "" : model.links[static_cast<std::size_t>(geom.link)].name;
    const std::string name =
        !geom.name.empty() ? geom.name : (link.empty() ? "world" : link) + "/" + geom.kind;
    if (geom.mesh && geom.touches == Touch::as_seen) {
      bodies.push_back(body_of(name, link, geom.link, geom.mesh, geom.pose));
      continue;
    }
    const bool is_hull = geom.mesh && geom.touches == Touch::as_hull;
    const Shape shape = is_hull ? hulls.of(geom.mesh) : geom.shape.value_or(nothing);
    bodies.push_back(body_of(name, link, geom.link, shape, geom.pose));
    if (geom.touches_as_half_space())
      bodies.back().plane = PlacedPlane::of(Vec3<double>::UnitZ(), 0, geom.pose);
  }
  return bodies;
}

std::vector<ClearanceBody> bodies_of(const Scene& scene) {
  const std::size_t count = instance_count(scene);
  if (count > most_obstacles)
    throw BadInput(
        "distances from more than 1,000,000 objects and particles are not measured (got " +
        std::to_string(count) + ")");
  std::vector<ClearanceBody> bodies;
  for (std::size_t i = 0; i < count; ++i) {
    const Object object = instance_object(scene, i);
    if (object.compound) {
      for (std::size_t part = 0; part < object.compound->size(); ++part) {
        const auto& [shape, pose] = object.compound->part(part);
        bodies.push_back(body_of(object.name, "", -1, shape, object.pose * pose));
      }
      continue;
    }
    if (object.mesh) {
      bodies.push_back(body_of(object.name, "", -1, object.mesh, object.pose));
      continue;
    }
    bodies.push_back(body_of(object.name, "", -1, object.shape, object.pose));
    if (object.half_space)
      bodies.back().plane =
          PlacedPlane::of(object.half_space->normal, object.half_space->offset, object.pose);
  }
  return bodies;
}

std::vector<std::uint32_t> objects_of_bodies(const Scene& scene) {
  std::vector<std::uint32_t> objects;
  for (std::uint32_t i = 0; i < instance_count(scene); ++i) {
    const Compound* const compound =
        i < scene.objects.size() ? scene.objects[i].compound.get() : nullptr;
    objects.insert(objects.end(), compound ? compound->size() : 1, i);
  }
  return objects;
}

LinkPlace place_of(int link, const Model& model, const std::vector<int>& groups) {
  if (link < 0) return {};
  const int group = groups[static_cast<std::size_t>(link)];
  const ModelLink& first = model.links[static_cast<std::size_t>(group)];
  const bool is_fixed = std::ranges::all_of(
      first.joints, [](const ModelJoint& joint) { return joint.kind == JointKind::fixed; });
  return {group, first.parent < 0 ? -2 : groups[static_cast<std::size_t>(first.parent)],
          first.parent < 0 && is_fixed};
}

bool are_looked_at(const LinkPlace& a, const LinkPlace& b) {
  if (a.group == b.group || (a.is_still && b.is_still)) return false;
  const bool are_links = a.group >= 0 && b.group >= 0;
  return !are_links || (a.parent != b.group && b.parent != a.group);
}

std::vector<BodyPair> pairs_of(const std::vector<ClearanceBody>& bodies, const Model& model,
                               const AllowedPairs& allowed, bool self) {
  const std::vector<int> groups = rigid_groups(model);
  std::vector<LinkPlace> places;
  // Pairs of two obstacles are not tested: there may be a million obstacles.
  std::vector<std::size_t> all, links, obstacles;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    places.push_back(place_of(bodies[i].link_index, model, groups));
    all.push_back(i);
    (places[i].group < 0 ? obstacles : links).push_back(i);
  }
  std::vector<BodyPair> pairs;
  for (const std::size_t i : all) {
    const LinkPlace& a = places[i];
    const std::vector<std::size_t>& others = a.group < 0 ? links : self ? all : obstacles;
    for (auto j = std::ranges::upper_bound(others, i); j != others.end(); ++j) {
      const LinkPlace& b = places[*j];
      if (!are_looked_at(a, b)) continue;
      if (a.group >= 0 && b.group >= 0 && allowed.allows(bodies[i].link, bodies[*j].link)) continue;
      if (pairs.size() == most_pairs)
        throw BadInput(
            "more than 10,000,000 pairs of bodies move against each other; --allow, --srdf and "
            "--only-obstacles (only_obstacles in the library) leave some out");
      pairs.push_back({i, *j});
    }
  }
  return pairs;
}

}  // namespace minkray
