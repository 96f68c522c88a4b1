// SPDX-License-Identifier: MIT
// C interface: making and changing scenes.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/support/named_kind.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/held_scene.h"
#include "renderer/library/handles/held_shape.h"
#include "renderer/library/handles/poses.h"
#include "renderer/library/handles/scene_use.h"

namespace minkray {
namespace {

ImportOptions import_options(const minkray_file_options* given) {
  ImportOptions options;
  if (!given) return options;
  if (given->size < offsetof(minkray_file_options, meshes))
    wrong_use("options.size: must be sizeof(minkray_file_options)");
  const std::string geometry = given->geometry ? given->geometry : "visual";
  const auto* const known_geometry = row_named(geometry_choices, geometry);
  if (!known_geometry)
    wrong_use("options.geometry: must be \"visual\", \"collision\" or \"all\" (got \"" +
              printable(geometry, 60) + "\")");
  options.geometry = known_geometry->kind;
  const bool has_meshes = given->size >= sizeof(minkray_file_options) && given->meshes;
  const std::string meshes = has_meshes ? given->meshes : "";
  const auto* const known_meshes = row_named(mesh_choices, meshes);
  if (known_meshes)
    options.meshes = known_meshes->kind;
  else if (!meshes.empty())
    wrong_use("options.meshes: must be \"hull\" or \"exact\" (got \"" + printable(meshes, 60) +
              "\")");
  if (given->keyframe) options.keyframe = given->keyframe;
  if (given->package_dir_count > 0) require(given->package_dirs, "options.package_dirs");
  require_room(given->package_dir_count, sizeof(char*), "options.package_dir_count");
  for (size_t i = 0; i < given->package_dir_count; ++i) {
    require(given->package_dirs[i], "options.package_dirs[]");
    options.package_dirs.emplace_back(given->package_dirs[i]);
  }
  options.skip_missing_meshes = given->skip_missing_meshes != 0;
  return options;
}

const std::pair<std::string, std::size_t>& joint_of(const HeldScene::Group& group,
                                                    std::uint32_t joint) {
  if (joint >= group.joints.size())
    wrong_use("joint: must be less than " + std::to_string(group.joints.size()) + " (got " +
              std::to_string(joint) + ")");
  return group.joints[joint];
}

}  // namespace
}  // namespace minkray

using namespace minkray;

extern "C" {

int minkray_scene_make(minkray_scene* scene) {
  return call("minkray_scene_make", [&] {
    require(scene, "scene");
    *scene = {held_scenes().add(std::make_unique<HeldScene>())};
  });
}

int minkray_scene_release(minkray_scene scene) {
  return call("minkray_scene_release", [&] { SceneChange(scene).release(scene); });
}

int minkray_scene_add(minkray_scene scene, minkray_shape shape, const minkray_pose* pose,
                      const char* name, uint32_t* object) {
  return call("minkray_scene_add", [&] {
    const SceneChange held(scene);
    const HeldShape& added = shape_of(shape, "shape");
    const uint32_t index = held->add(added, pose_of(pose, "pose"), name);
    if (object) *object = index;
  });
}

int minkray_scene_add_half_space(minkray_scene scene, const double normal[3], double offset,
                                 const char* name, uint32_t* object) {
  return call("minkray_scene_add_half_space", [&] {
    const SceneChange held(scene);
    const Vec3<double> n = vector_of(normal, "normal");
    if (n.isZero(0)) wrong_use("normal: must not be zero");
    if (!std::isfinite(offset))
      wrong_use("offset: must be a finite number (got " + std::to_string(offset) + ")");
    const uint32_t index = held->add(HalfSpaceBody<double>{unit(n), offset}, name);
    if (object) *object = index;
  });
}

int minkray_scene_add_file(minkray_scene scene, const char* file,
                           const minkray_file_options* options, uint32_t* group) {
  return call("minkray_scene_add_file", [&] {
    const SceneChange held(scene);
    require(file, "file");
    const ImportOptions import = import_options(options);
    std::optional<Affine<double>> pose;
    if (options && options->pose) pose = pose_of(options->pose, "options.pose");
    const uint32_t index = held->add_file(file, import, pose);
    if (group) *group = index;
  });
}

int minkray_scene_set_pose(minkray_scene scene, uint32_t object, const minkray_pose* pose) {
  return call("minkray_scene_set_pose", [&] {
    const SceneChange held(scene);
    require(pose, "pose");
    held->set_pose(object, pose_of(pose, "pose"));
  });
}

int minkray_scene_set_group_pose(minkray_scene scene, uint32_t group, const minkray_pose* pose) {
  return call("minkray_scene_set_group_pose", [&] {
    const SceneChange held(scene);
    require(pose, "pose");
    held->set_group_pose(group, pose_of(pose, "pose"));
  });
}

int minkray_scene_set_joint(minkray_scene scene, uint32_t group, const char* joint,
                            const double* values, size_t count) {
  return call("minkray_scene_set_joint", [&] {
    const SceneChange held(scene);
    require(joint, "joint");
    if (count > 0) require(values, "values");
    held->set_joint(group, joint, {values, count});
  });
}

int minkray_scene_remove(minkray_scene scene, uint32_t object) {
  return call("minkray_scene_remove", [&] { SceneChange(scene)->remove(object); });
}

int minkray_scene_commit(minkray_scene scene) {
  return call("minkray_scene_commit", [&] { SceneChange(scene)->commit(); });
}

int minkray_scene_size(minkray_scene scene, uint32_t* objects, uint32_t* particles) {
  return call("minkray_scene_size", [&] {
    const SceneQuery held(scene);
    if (objects) *objects = held->size();
    size_t count = 0;
    for (const ParticleSet& set : held->particles()) count += set.size();
    if (particles) *particles = static_cast<uint32_t>(count);
  });
}

int minkray_scene_name(minkray_scene scene, uint32_t object, const char** name) {
  return call("minkray_scene_name", [&] {
    const SceneQuery held(scene);
    require(name, "name");
    *name = held->name(object);
  });
}

int minkray_scene_pose(minkray_scene scene, uint32_t object, minkray_pose* pose) {
  return call("minkray_scene_pose", [&] {
    const SceneQuery held(scene);
    require(pose, "pose");
    held->check_object(object);
    *pose = plain_pose(held->pose(object));
  });
}

int minkray_scene_group(minkray_scene scene, uint32_t group, uint32_t* first_object,
                        uint32_t* objects, uint32_t* joints) {
  return call("minkray_scene_group", [&] {
    const SceneQuery held(scene);
    const HeldScene::Group& found = held->group(group);
    if (first_object) *first_object = found.first;
    if (objects) *objects = found.count;
    if (joints) *joints = static_cast<uint32_t>(found.joints.size());
  });
}

int minkray_scene_joint(minkray_scene scene, uint32_t group, uint32_t joint, const char** name,
                        size_t* number_count) {
  return call("minkray_scene_joint", [&] {
    const SceneQuery held(scene);
    const auto& [found, numbers] = joint_of(held->group(group), joint);
    if (name) *name = found.c_str();
    if (number_count) *number_count = numbers;
  });
}

int minkray_scene_joint_value(minkray_scene scene, uint32_t group, uint32_t joint, double* values,
                              size_t size) {
  return call("minkray_scene_joint_value", [&] {
    const SceneQuery held(scene);
    const HeldScene::Group& robot = held->group(group);
    const std::vector<double> numbers = held->joint_value(robot, joint_of(robot, joint).first);
    if (size > 0) require(values, "values");
    std::copy_n(numbers.begin(), std::min(size, numbers.size()), values);
  });
}

}  // extern "C"
