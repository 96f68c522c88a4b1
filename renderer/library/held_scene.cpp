// SPDX-License-Identifier: MIT
#include "renderer/library/held_scene.h"

#include <cmath>

#include "renderer/film/render.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/library/call.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

constexpr double grey_of_added = 0.7;  ///< of what is added without a material

std::vector<std::pair<std::string, std::size_t>> moving_joints(const Model& model) {
  std::vector<std::pair<std::string, std::size_t>> joints;
  for (const ModelLink& link : model.links)
    for (const ModelJoint& joint : link.joints)
      if (joint.kind != JointKind::fixed && !joint.name.empty())
        joints.emplace_back(joint.name, width_of(joint.kind));
  return joints;
}

}  // namespace

void HeldScene::check_room(std::size_t more) const {
  if (instance_count(scene_) + more > most_instances) wrong_use("scene: has too many objects");
}

std::uint32_t HeldScene::grey() {
  if (!grey_) {
    grey_ = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back({"grey", LambertMaterial{Colour::Constant(grey_of_added)}});
  }
  return *grey_;
}

void HeldScene::keep_customs(const std::vector<std::shared_ptr<const CustomSupport>>& customs) {
  for (const auto& custom : customs)
    if (known_customs_.insert(custom.get()).second) customs_.push_back(custom);
}

std::uint32_t HeldScene::append(Object object, const char* name) {
  check_room(1);
  object.material = grey();
  const auto index = static_cast<std::uint32_t>(scene_.objects.size());
  object.name = name ? name : "object " + std::to_string(index);
  scene_.objects.push_back(std::move(object));
  due_ = Due::build;
  return index;
}

std::uint32_t HeldScene::add(const HeldShape& shape, const Affine<double>& pose, const char* name) {
  keep_customs(shape.customs());
  Object object;
  object.shape = *shape.shape();
  if (shape.customs().empty()) object.definition = shape.definition();
  object.pose = pose;
  return append(std::move(object), name);
}

std::uint32_t HeldScene::add(const HalfSpaceBody<double>& half_space, const char* name) {
  Object object;
  object.half_space = half_space;
  return append(std::move(object), name);
}

void HeldScene::append(Scene&& from) {
  const auto shift = static_cast<std::uint32_t>(scene_.materials.size());
  for (Material& material : from.materials) {
    if (auto* mix = std::get_if<MixMaterial>(&material.kind))
      for (std::uint32_t& index : mix->materials.indices) index += shift;
    scene_.materials.push_back(std::move(material));
  }
  for (Object& object : from.objects) {
    object.material += shift;
    scene_.objects.push_back(std::move(object));
  }
  for (ParticleSet& set : from.particles) {
    for (std::uint32_t& material : set.materials) material += shift;
    scene_.particles.push_back(std::move(set));
  }
  if (!has_camera_) {
    scene_.camera = from.camera;
    scene_.lights = std::move(from.lights);
    scene_.background = from.background;
    scene_.background_is_sky = from.background_is_sky;
    has_camera_ = true;
  }
  due_ = Due::build;
}

std::uint32_t HeldScene::add_file(const std::string& file, const ImportOptions& options,
                                  const std::optional<Affine<double>>& pose) {
  Imported imported = import_scene(file, options);
  check_room(instance_count(imported.scene));
  if (pose && !imported.scene.particles.empty())
    wrong_use("options.pose: must be NULL for a file with particles");
  Group group;
  group.first = static_cast<std::uint32_t>(scene_.objects.size());
  group.count = static_cast<std::uint32_t>(imported.scene.objects.size());
  group.has_particles = !imported.scene.particles.empty();
  group.model = std::move(imported.model);
  group.options = options;
  for (const Object& object : imported.scene.objects) group.in_file.push_back(object.pose);
  if (group.model) group.joints = moving_joints(*group.model);
  append(std::move(imported.scene));
  groups_.push_back(std::move(group));
  if (pose) {
    groups_.back().pose = *pose;
    place(groups_.back());
  }
  return static_cast<std::uint32_t>(groups_.size() - 1);
}

void HeldScene::place(Group& group) {
  for (std::uint32_t i = 0; i < group.count; ++i)
    scene_.objects[group.first + i].pose = group.pose * group.in_file[i];
  if (due_ == Due::nothing) due_ = Due::refit;
}

const Object& HeldScene::object(std::uint32_t object) const {
  if (object >= scene_.objects.size())
    wrong_use("object: must be less than " + std::to_string(scene_.objects.size()) + " (got " +
              std::to_string(object) + ")");
  if (is_removed(object))
    wrong_use("object: must not be one that was removed (got " + std::to_string(object) + ")");
  return scene_.objects[object];
}

const char* HeldScene::name(std::uint32_t object) const {
  const std::string& found = this->object(object).name;
  const std::lock_guard lock(names_mutex_);
  return names_.try_emplace(object, found).first->second.c_str();
}

const HeldScene::Group& HeldScene::group(std::uint32_t group) const {
  if (group >= groups_.size())
    wrong_use("group: must be less than " + std::to_string(groups_.size()) + " (got " +
              std::to_string(group) + ")");
  return groups_[group];
}

void HeldScene::set_pose(std::uint32_t object, const Affine<double>& pose) {
  this->object(object);
  scene_.objects[object].pose = pose;
  if (due_ == Due::nothing) due_ = Due::refit;
}

void HeldScene::set_group_pose(std::uint32_t group, const Affine<double>& pose) {
  if (this->group(group).has_particles)
    wrong_use("pose: must not be given to a group with particles");
  groups_[group].pose = pose;
  place(groups_[group]);
}

void HeldScene::set_joint(std::uint32_t group, const std::string& name,
                          std::span<const double> values) {
  this->group(group);
  Group& robot = groups_[group];
  ModelJoint* joint = robot.model ? find_joint(*robot.model, name) : nullptr;
  if (!joint) {
    std::string names;
    for (const auto& [known, width] : robot.joints)
      names += (names.empty() ? "" : ", ") + printable(known, 40);
    wrong_use("joint: must be the name of one of the group's (got \"" + printable(name, 60) +
              "\"; " + (names.empty() ? "it has none" : "known are " + names) + ")");
  }
  if (values.size() != width_of(joint->kind))
    wrong_use("values: joint \"" + printable(name, 60) + "\" takes " +
              std::to_string(width_of(joint->kind)) + " numbers (got " +
              std::to_string(values.size()) + ")");
  for (const double value : values)
    if (!std::isfinite(value)) wrong_use("values: must be finite numbers");
  joint->value.assign(values.begin(), values.end());
  follow_mimics(*robot.model);
  const Scene moved = minkray::scene_of(*robot.model, robot.options, {});
  for (std::uint32_t i = 0; i < robot.count; ++i) robot.in_file[i] = moved.objects[i].pose;
  place(robot);
}

std::vector<double> HeldScene::joint_value(const Group& group, const std::string& name) const {
  for (const ModelLink& link : group.model->links)
    for (const ModelJoint& joint : link.joints)
      if (joint.name == name && joint.kind != JointKind::fixed) return value_of(link, joint);
  return {};
}

void HeldScene::remove(std::uint32_t object) {
  this->object(object);
  // Its place stays, so that all numbers do: a point that no ray meets and that gives no light.
  Object nothing;
  nothing.material = grey();
  nothing.visible_to = 0;
  scene_.objects[object] = std::move(nothing);
  removed_.insert(object);
  due_ = Due::build;
  if (customs_.empty()) return;
  known_customs_.clear();
  customs_.clear();
  for (const Object& left : scene_.objects) keep_customs(customs_of(left.shape));
}

void HeldScene::commit() {
  if (due_ == Due::build)
    world_ = make_world(scene_);
  else if (due_ == Due::refit)
    follow(world_, scene_);
  due_ = Due::nothing;
  throw_if_lied(customs_);
}

const RenderWorld& HeldScene::world() const {
  if (due_ != Due::nothing)
    wrong_use("scene: must be committed: call commit() after changes and before queries");
  refuse_if_running(customs_, "scene");
  return world_;
}

}  // namespace minkray
