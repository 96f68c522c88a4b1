// SPDX-License-Identifier: MIT
// The functions of the C interface that make scenes and change them.
#include "renderer/library/call.h"
#include "renderer/library/held_scene.h"
#include "renderer/library/held_shape.h"
#include "renderer/library/poses.h"

namespace minkray {

Handles<HeldScene>& held_scenes() {
  static Handles<HeldScene>& scenes = *new Handles<HeldScene>(2);  // as those of shapes
  return scenes;
}

HeldScene& scene_of(minkray_scene scene) {
  HeldScene* held = held_scenes().find(scene.id);
  if (!held)
    wrong_use(std::string("scene: must be a scene (got ") +
              (scene.id == 0 ? "none" : "one that was released, or none") + ")");
  return *held;
}

namespace {

ImportOptions import_options(const minkray_file_options* given) {
  ImportOptions options;
  if (!given) return options;
  if (given->size < sizeof(minkray_file_options))
    wrong_use("options.size: must be sizeof(minkray_file_options)");
  const std::string geometry = given->geometry ? given->geometry : "visual";
  if (geometry == "collision")
    options.geometry = GeometryChoice::collision;
  else if (geometry == "all")
    options.geometry = GeometryChoice::all;
  else if (geometry != "visual")
    wrong_use("options.geometry: must be \"visual\", \"collision\" or \"all\" (got \"" +
              printable(geometry, 60) + "\")");
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
  return call("minkray_scene_release", [&] {
    if (!held_scenes().release(scene.id)) scene_of(scene);
  });
}

int minkray_scene_add(minkray_scene scene, minkray_shape shape, const minkray_pose* pose,
                      const char* name, uint32_t* object) {
  return call("minkray_scene_add", [&] {
    HeldScene& held = scene_of(scene);
    const HeldShape& added = shape_of(shape, "shape");
    const Affine<double> map = pose_of(pose, "pose");
    const HeldScene::Change change(held);
    const uint32_t index = held.add(added, map, name);
    if (object) *object = index;
  });
}

int minkray_scene_add_half_space(minkray_scene scene, const double normal[3], double offset,
                                 const char* name, uint32_t* object) {
  return call("minkray_scene_add_half_space", [&] {
    HeldScene& held = scene_of(scene);
    const Vec3<double> n = vector_of(normal, "normal");
    if (n.isZero(0)) wrong_use("normal: must not be zero");
    vector_of(std::array{offset, 0.0, 0.0}.data(), "offset");
    const HeldScene::Change change(held);
    const uint32_t index = held.add(HalfSpaceBody<double>{unit(n), offset}, name);
    if (object) *object = index;
  });
}

int minkray_scene_add_file(minkray_scene scene, const char* file,
                           const minkray_file_options* options, uint32_t* group) {
  return call("minkray_scene_add_file", [&] {
    HeldScene& held = scene_of(scene);
    require(file, "file");
    const ImportOptions import = import_options(options);
    std::optional<Affine<double>> pose;
    if (options && options->pose) pose = pose_of(options->pose, "options.pose");
    const HeldScene::Change change(held);
    const uint32_t index = held.add_file(file, import, pose);
    if (group) *group = index;
  });
}

int minkray_scene_set_pose(minkray_scene scene, uint32_t object, const minkray_pose* pose) {
  return call("minkray_scene_set_pose", [&] {
    HeldScene& held = scene_of(scene);
    require(pose, "pose");
    const Affine<double> map = pose_of(pose, "pose");
    const HeldScene::Change change(held);
    held.set_pose(object, map);
  });
}

int minkray_scene_set_group_pose(minkray_scene scene, uint32_t group, const minkray_pose* pose) {
  return call("minkray_scene_set_group_pose", [&] {
    HeldScene& held = scene_of(scene);
    require(pose, "pose");
    const Affine<double> map = pose_of(pose, "pose");
    const HeldScene::Change change(held);
    held.set_group_pose(group, map);
  });
}

int minkray_scene_set_joint(minkray_scene scene, uint32_t group, const char* joint,
                            const double* values, size_t count) {
  return call("minkray_scene_set_joint", [&] {
    HeldScene& held = scene_of(scene);
    require(joint, "joint");
    if (count > 0) require(values, "values");
    const HeldScene::Change change(held);
    held.set_joint(group, joint, {values, count});
  });
}

int minkray_scene_commit(minkray_scene scene) {
  return call("minkray_scene_commit", [&] {
    HeldScene& held = scene_of(scene);
    const HeldScene::Change change(held);
    held.commit();
  });
}

int minkray_scene_size(minkray_scene scene, uint32_t* objects, uint32_t* particles) {
  return call("minkray_scene_size", [&] {
    const HeldScene& held = scene_of(scene);
    if (objects) *objects = static_cast<uint32_t>(held.plain().objects.size());
    size_t count = 0;
    for (const ParticleSet& set : held.plain().particles) count += set.size();
    if (particles) *particles = static_cast<uint32_t>(count);
  });
}

int minkray_scene_name(minkray_scene scene, uint32_t object, const char** name) {
  return call("minkray_scene_name", [&] {
    const HeldScene& held = scene_of(scene);
    require(name, "name");
    *name = held.object(object).name.c_str();
  });
}

int minkray_scene_pose(minkray_scene scene, uint32_t object, minkray_pose* pose) {
  return call("minkray_scene_pose", [&] {
    const HeldScene& held = scene_of(scene);
    require(pose, "pose");
    *pose = plain_pose(held.object(object).pose);
  });
}

int minkray_scene_group(minkray_scene scene, uint32_t group, uint32_t* first_object,
                        uint32_t* objects, uint32_t* joints) {
  return call("minkray_scene_group", [&] {
    const HeldScene::Group& found = scene_of(scene).group(group);
    if (first_object) *first_object = found.first;
    if (objects) *objects = found.count;
    if (joints) *joints = static_cast<uint32_t>(found.joints.size());
  });
}

int minkray_scene_joint(minkray_scene scene, uint32_t group, uint32_t joint, const char** name,
                        size_t* number_count) {
  return call("minkray_scene_joint", [&] {
    const HeldScene::Group& found = scene_of(scene).group(group);
    if (joint >= found.joints.size())
      wrong_use("joint: must be less than " + std::to_string(found.joints.size()) + " (got " +
                std::to_string(joint) + ")");
    if (name) *name = found.joints[joint].first.c_str();
    if (number_count) *number_count = found.joints[joint].second;
  });
}

}  // extern "C"
