// SPDX-License-Identifier: MIT
// Makes the bodies of a committed scene: scales become part of shapes, meshes and compounds, and
// robots' meshes touch as their files prescribe.
#include <limits>
#include <memory>
#include <unordered_map>

#include "core/mesh/mapped.h"
#include "renderer/import/model/mesh_hull.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/library/handles/poses.h"
#include "renderer/library/handles/scene_bodies.h"

namespace minkray {
namespace {

/// Robots' meshes that touch as something else, by object.
std::unordered_map<std::uint32_t, Touch> touches_of_meshes(const HeldScene& scene) {
  std::unordered_map<std::uint32_t, Touch> touches;
  for (std::uint32_t g = 0; g < scene.groups(); ++g) {
    const HeldScene::Group& group = scene.group(g);
    if (!group.model) continue;
    const std::vector<bool> wanted = chosen_geoms(*group.model, group.options.geometry);
    std::uint32_t object = group.first;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (!wanted[i]) continue;
      const ModelGeom& geom = group.model->geoms[i];
      if (geom.mesh && geom.touches != Touch::as_seen) touches.emplace(object, geom.touches);
      ++object;
    }
  }
  return touches;
}

}  // namespace

SceneBodies::SceneBodies(const HeldScene& scene) : scene_(scene) {
  const Instances& instances = scene.world().instances();
  const PairRules& rules = scene.pair_rules();
  body_of_.assign(instances.size(), none);
  std::vector<ContactBody> bodies;
  std::unordered_map<std::uint32_t, ContactShape> ready;
  std::unordered_map<const TriangleMesh*, ContactShape> ready_hulls;
  const std::unordered_map<std::uint32_t, Touch> touches = touches_of_meshes(scene);
  for (std::uint32_t i = 0; i < instances.size(); ++i) {
    if (scene.is_removed(i)) continue;
    const PairRules::Masks masks = rules.masks(i);
    if (instances.is_half_space(i)) continue;
    const Affine<double> pose = scene.pose_of_any(i);
    if (instances.is_mesh(i)) {
      // Scaling is part of the mesh.
      std::shared_ptr<const TriangleMesh> mesh = instances.mesh_of(i).mesh;
      Affine<double> place = pose;
      const auto touch = touches.find(i);
      if (touch != touches.end() && touch->second == Touch::as_half_space) {
        half_spaces_.push_back(
            {i, PlacedPlane::of(Vec3<double>::UnitZ(), 0, pose), pose.translation, masks});
        continue;
      }
      if (touch != touches.end() && is_rigid(pose)) {
        auto known = ready_hulls.find(mesh.get());
        if (known == ready_hulls.end())
          known = ready_hulls.emplace(mesh.get(), ContactShape(hull_of(*mesh))).first;
        body_of_[i] = static_cast<std::uint32_t>(bodies.size());
        objects_.push_back(i);
        bodies.push_back({known->second, place, masks.category, masks.mask});
        continue;
      }
      if (!is_rigid(pose)) {
        mesh = mapped(*mesh, {pose.linear, Vec3<double>::Zero()});
        place.linear.setIdentity();
      }
      body_of_[i] = static_cast<std::uint32_t>(bodies.size());
      objects_.push_back(i);
      bodies.push_back({point_, place, masks.category, masks.mask, std::move(mesh)});
      continue;
    }
    if (instances.is_compound(i)) {
      std::shared_ptr<const Compound> compound = instances.compound_of(i).compound;
      Affine<double> place = pose;
      if (!is_rigid(pose)) {
        compound = compound->mapped({pose.linear, Vec3<double>::Zero()});
        place.linear.setIdentity();
      }
      body_of_[i] = static_cast<std::uint32_t>(bodies.size());
      objects_.push_back(i);
      bodies.push_back({point_, place, masks.category, masks.mask, {}, std::move(compound)});
      continue;
    }
    const std::uint32_t number = instances.definition_of(i);
    const Shape& shape = instances.definition(number).original_shape();
    body_of_[i] = static_cast<std::uint32_t>(bodies.size());
    objects_.push_back(i);
    if (is_rigid(pose)) {
      auto known = ready.find(number);
      if (known == ready.end()) known = ready.emplace(number, ContactShape(shape)).first;
      bodies.push_back({known->second, pose, masks.category, masks.mask});
    } else {
      // Scaling is part of the shape.
      const Affine<double> map{pose.linear, Vec3<double>::Zero()};
      const Affine<double> place{Mat3<double>::Identity(), pose.translation};
      bodies.push_back({ContactShape(shape, map), place, masks.category, masks.mask});
    }
  }
  world_.emplace(std::move(bodies));
  balls_.reserve(objects_.size());
  for (const ContactBody& body : world_->bodies())
    balls_.push_back(body.is_shape()
                         ? Ball{middle_in_world(body.shape, body.pose), body.shape.ball_radius()}
                         : Ball{body.pose.translation, std::numeric_limits<double>::infinity()});
  for (const Instances::PosedHalfSpace& one : instances.half_spaces()) {
    if (scene.is_removed(one.instance)) continue;
    const Affine<double> pose = scene.pose_of_any(one.instance);
    half_spaces_.push_back({one.instance,
                            PlacedPlane::of(one.at_rest.normal, one.at_rest.offset, pose),
                            pose.translation, rules.masks(one.instance)});
  }
  for (std::uint32_t g = 0; g < scene.groups(); ++g) {
    const HeldScene::Group& group = scene.group(g);
    if (!group.model) continue;
    if (robot_of_.empty()) {
      robot_of_.assign(instances.size(), none);
      places_.resize(instances.size());
    }
    const std::vector<int> rigid = rigid_groups(*group.model);
    const std::vector<bool> wanted = chosen_geoms(*group.model, group.options.geometry);
    std::uint32_t object = group.first;
    for (std::size_t i = 0; i < wanted.size() && object < group.first + group.count; ++i) {
      if (!wanted[i]) continue;
      robot_of_[object] = g;
      places_[object++] = place_of(group.model->geoms[i].link, *group.model, rigid);
    }
  }
}

}  // namespace minkray
