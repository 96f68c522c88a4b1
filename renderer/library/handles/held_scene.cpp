// SPDX-License-Identifier: MIT
#include "renderer/library/handles/held_scene.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/files/text.h"
#include "core/parts/compound.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/scene_bodies.h"
#include "renderer/scene/add_instances.h"
#include "renderer/scene/append_materials.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

constexpr double grey_of_added = 0.7;  ///< of what is added without a material

/// Gives memory that a build needed back to the system, where it is much.
void return_memory([[maybe_unused]] std::size_t instances) {
#if defined(__GLIBC__)
  constexpr std::size_t many = 50'000;  // some megabytes
  if (instances >= many) malloc_trim(0);
#endif
}

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
  std::size_t particles = 0;
  for (const ParticleSet& set : scene_.particles) particles += set.size();
  if (size_ + particles + more > most_instances) wrong_use("scene: has too many objects");
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

Instances& HeldScene::changed() {
  if (due_ != Due::build) {
    instances_ = std::move(world_).release();
    world_ = World();
    instances_.truncate(size_);  // particles are added again
    due_ = Due::build;
  }
  return instances_;
}

std::uint32_t HeldScene::number_of_added(const char* name) {
  if (name) names_.emplace(size_, name);
  return size_++;
}

std::uint32_t HeldScene::add(const HeldShape& shape, const Affine<double>& pose, const char* name) {
  check_room(1);
  keep_customs(shape.customs());
  Instances& instances = changed();
  if (!shape.is_convex()) {
    if (shape.mesh())
      instances.add(shape.mesh(), pose);
    else
      instances.add(shape.compound(), pose);
    return number_of_added(name);
  }
  const bool is_custom = !shape.customs().empty();
  instances.add(is_custom ? instances.define(*shape.shape()) : instances.define(shape.definition()),
                pose);
  if (!instances.plain_pose(size_)) poses_.emplace(size_, pose);
  return number_of_added(name);
}

std::uint32_t HeldScene::add(const HalfSpaceBody<double>& half_space, const char* name) {
  check_room(1);
  changed().add(half_space);
  poses_.emplace(size_, Affine<double>());
  return number_of_added(name);
}

void HeldScene::append(Scene&& from) {
  append_materials(scene_, from);
  Instances& instances = changed();
  for (Object& object : from.objects) {
    add_object(instances, object);
    // Equal shapes share their points.
    if (object.has_shape())
      object.shape = instances.definition(instances.definition_of(size_)).original_shape();
    scene_.objects.push_back(std::move(object));
    ++size_;
  }
  for (ParticleSet& set : from.particles) scene_.particles.push_back(std::move(set));
  if (!has_camera_) {
    scene_.camera = from.camera;
    scene_.lights = std::move(from.lights);
    scene_.background = from.background;
    scene_.background_is_sky = from.background_is_sky;
    scene_.camera_is_framed = from.camera_is_framed;
    has_camera_ = true;
  }
}

std::uint32_t HeldScene::add_file(const std::string& file, const ImportOptions& options,
                                  const std::optional<Affine<double>>& pose) {
  Imported imported = import_scene(file, options);
  check_room(instance_count(imported.scene));
  if (pose && !imported.scene.particles.empty())
    wrong_use("options.pose: must be NULL for a file with particles");
  Group group;
  group.first = size_;
  group.first_in_scene = static_cast<std::uint32_t>(scene_.objects.size());
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
    place(group.first + i, scene_.objects[group.first_in_scene + i], group.pose * group.in_file[i]);
}

void HeldScene::place(std::uint32_t number, Object& object, const Affine<double>& pose) {
  object.pose = pose;
  if (is_removed(number)) return;
  if (!object.half_space) set_instance_pose(number, pose);
  if (due_ == Due::nothing) due_ = Due::refit;
}

void HeldScene::set_instance_pose(std::uint32_t number, const Affine<double>& pose) {
  if (due_ == Due::build)
    instances_.set_pose(number, pose);
  else
    world_.set_pose(number, pose);
}

const Object* HeldScene::of_file(std::uint32_t number) const {
  const auto after = std::upper_bound(
      groups_.begin(), groups_.end(), number,
      [](std::uint32_t sought, const Group& group) { return sought < group.first; });
  if (after == groups_.begin()) return nullptr;
  const Group& group = *std::prev(after);
  if (number - group.first >= group.count) return nullptr;
  return &scene_.objects[group.first_in_scene + (number - group.first)];
}

void HeldScene::check_object(std::uint32_t number, const char* argument) const {
  if (number >= size_)
    wrong_use(std::string(argument) + ": must be less than " + std::to_string(size_) + " (got " +
              std::to_string(number) + ")");
  if (is_removed(number))
    wrong_use(std::string(argument) + ": must not be removed (got " + std::to_string(number) + ")");
}

Affine<double> HeldScene::pose(std::uint32_t number) const {
  if (const Object* object = of_file(number)) return object->pose;
  const auto kept = poses_.find(number);
  return kept != poses_.end() ? kept->second : *instances().plain_pose(number);
}

const char* HeldScene::name(std::uint32_t number) const {
  check_object(number);
  const std::lock_guard lock(names_mutex_);
  const auto known = names_.find(number);
  if (known != names_.end()) return known->second.c_str();
  const Object* object = of_file(number);
  return names_.emplace(number, object ? object->name : "object " + std::to_string(number))
      .first->second.c_str();
}

Object HeldScene::object(std::uint32_t number) const {
  if (const Object* object = of_file(number)) return *object;
  Object object;
  object.name = name(number);
  object.material = *grey_;
  object.pose = pose(number);
  if (instances().is_mesh(number)) object.mesh = instances().mesh_of(number).mesh;
  if (instances().is_compound(number)) object.compound = instances().compound_of(number).compound;
  if (instances().has_shape(number)) {
    object.shape = instances().body_of(number).definition->original_shape();
    object.definition = instances().body_of(number).definition;
  }
  for (const Instances::PosedHalfSpace& one : instances().half_spaces())
    if (one.instance == number) object.half_space = one.at_rest;
  return object;
}

Scene HeldScene::whole() const {
  Scene scene = scene_;
  scene.objects.clear();
  scene.objects.reserve(size_);
  Object nothing;  // met by no ray, and gives no light
  nothing.material = grey_.value_or(0);
  nothing.visible_to = 0;
  for (std::uint32_t i = 0; i < size_; ++i)
    scene.objects.push_back(is_removed(i) ? nothing : object(i));
  return scene;
}

const HeldScene::Group& HeldScene::group(std::uint32_t group) const {
  if (group >= groups_.size())
    wrong_use("group: must be less than " + std::to_string(groups_.size()) + " (got " +
              std::to_string(group) + ")");
  return groups_[group];
}

void HeldScene::set_pose(std::uint32_t number, const Affine<double>& pose) {
  check_object(number);
  if (const Object* object = of_file(number))
    return place(number, scene_.objects[static_cast<std::size_t>(object - scene_.objects.data())],
                 pose);
  if (due_ == Due::nothing) due_ = Due::refit;
  if (instances().is_half_space(number)) {
    poses_[number] = pose;
    return;
  }
  set_instance_pose(number, pose);
  if (instances().plain_pose(number))
    poses_.erase(number);
  else
    poses_[number] = pose;
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
    const std::string names =
        listed(robot.joints, [](const auto& known) { return printable(known.first, 40); });
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

void HeldScene::remove(std::uint32_t number) {
  check_object(number);
  // The place is kept, so that all numbers stay the same.
  removed_.insert(number);
  poses_.erase(number);
  Instances& instances = changed();
  if (instances.has_shape(number)) instances.replace(number, instances.define(Shape(Point())));
  if (customs_.empty()) return;
  known_customs_.clear();
  customs_.clear();
  std::unordered_set<std::uint32_t> definitions;
  for (std::uint32_t i = 0; i < size_; ++i)
    if (!is_removed(i) && instances.has_shape(i)) definitions.insert(instances.definition_of(i));
  for (const PosedCompound& posed : instances.compounds())
    for (std::size_t part = 0; part < posed.compound->size(); ++part)
      if (!is_removed(posed.instance)) keep_customs(customs_of(posed.compound->part(part).shape));
  for (const std::uint32_t definition : definitions)
    keep_customs(customs_of(instances.definition(definition).original_shape()));
}

void HeldScene::show_instances(Instances& instances) const {
  const auto visible_to = [&](const auto& thing, std::uint32_t material) {
    return static_cast<RayKinds>(thing.visible_to & scene_.materials[material].visible_to);
  };
  const auto show = [&](std::size_t i, RayKinds kinds) {
    if (kinds != all_ray_kinds) instances.show_to(i, kinds);
  };
  for (const Group& group : groups_)
    for (std::uint32_t i = 0; i < group.count; ++i) {
      const Object& object = scene_.objects[group.first_in_scene + i];
      show(group.first + i, visible_to(object, object.material));
    }
  std::size_t first = size_;
  for (const ParticleSet& set : scene_.particles) {
    for (std::size_t i = 0; i < set.size(); ++i) show(first + i, visible_to(set, set.material(i)));
    first += set.size();
  }
  for (const std::uint32_t number : removed_) instances.show_to(number, 0);
}

Affine<double> HeldScene::pose_of_any(std::uint32_t number) const {
  if (number >= size_) return particle_pose(scene_, number - size_);
  return is_removed(number) ? Affine<double>() : pose(number);
}

const SceneBodies& HeldScene::bodies() const {
  world();
  const std::lock_guard lock(bodies_mutex_);
  if (!bodies_) bodies_ = std::make_shared<const SceneBodies>(*this);
  return *bodies_;
}

void HeldScene::commit() {
  grey();  // of objects without a material
  if (due_ != Due::nothing) bodies_.reset();
  const auto pose_of = [&](std::size_t i) { return pose_of_any(static_cast<std::uint32_t>(i)); };
  const bool moves = std::any_of(scene_.objects.begin(), scene_.objects.end(),
                                 [](const Object& one) { return !one.movement.stands(); });
  const auto movement_of = [&](std::size_t i) {
    const Object* object = i < size_ ? of_file(static_cast<std::uint32_t>(i)) : nullptr;
    return object ? object->movement : Movement<double>();
  };
  if (due_ == Due::build) {
    add_particles(instances_, scene_);
    show_instances(instances_);
    if (!instances_.has_boxes()) instances_.pose_all(pose_of);
    world_ = World(std::exchange(instances_, Instances()));
    return_memory(world_.instances().size());
    due_ = moves ? Due::refit : Due::nothing;
  }
  if (due_ == Due::refit) {
    if (moves)
      world_.pose_all(pose_of, movement_of);
    else
      world_.pose_all(pose_of);
  }
  due_ = Due::nothing;
  throw_if_lied(customs_);
}

const World& HeldScene::world() const {
  if (due_ != Due::nothing)
    wrong_use("scene: must be committed: call commit() after changes and before queries");
  refuse_if_running(customs_, "scene");
  return world_;
}

HeldScene& scene_of(minkray_scene scene) {
  HeldScene* held = held_scenes().find(scene.id);
  if (!held)
    wrong_use(std::string("scene: must be a scene (got ") +
              (scene.id == 0 ? "none" : "a released one, or none") + ")");
  return *held;
}

}  // namespace minkray
