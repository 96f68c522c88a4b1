// SPDX-License-Identifier: MIT
// Calls that make scenes and change them.
#include <cmath>

#include "tests/fuzz/c_abi_program.h"
#include "tests/support/temporary_folder.h"

namespace minkray::fuzz {
namespace {

struct SceneFile {
  const char* name;
  const char* text;
  std::uint32_t objects, particles;
  bool is_robot;
};

constexpr SceneFile files[] = {
    {"arm.urdf",
     R"(<robot name="r"><link name="a"><visual><geometry><box size="1 2 3"/></geometry></visual></link>
<link name="b"><visual><geometry><sphere radius="1"/></geometry></visual><collision><geometry><cylinder
radius="1" length="2"/></geometry></collision></link><link name="c"><visual><geometry><box size="1 1 1"/>
</geometry></visual></link><joint name="hinge" type="revolute"><parent link="a"/><child link="b"/>
<origin xyz="4 0 0"/><axis xyz="0 0 1"/><limit lower="-1" upper="1"/></joint>
<joint name="slide" type="prismatic"><parent link="b"/><child link="c"/><origin xyz="4 0 0"/>
<axis xyz="1 0 0"/><limit lower="-1" upper="1"/><mimic joint="hinge" multiplier="2"/></joint></robot>)",
     3, 0, true},
    {"ball.xml",
     R"(<mujoco><worldbody><geom type="plane" size="0 0 1"/><body pos="0 0 3"><joint name="ball" type="ball"/>
<geom type="capsule" size=".3 1"/><body pos="0 0 3"><joint name="hinge" axis="0 1 0"/><geom type="box"
size=".5 .5 .5"/></body></body></worldbody></mujoco>)",
     3, 0, true},
    {"scene.json",
     R"({"version":1,"camera":{"position":[0,-9,1],"look_at":[0,0,0]},"lights":[{"type":"directional",
"direction":[0,1,-1],"color":[1,1,1]}],"materials":[{"name":"m","type":"lambert","color":[1,0.5,0.5]}],
"objects":[{"name":"x","shape":{"type":"sphere","radius":1},"material":"m"}],"particles":[{"name":"p",
"shape":{"type":"box","half_extents":[0.2,0.2,0.2]},"material":"m","columns":["position"],
"poses":[[2,0,0],[-2,0,0]]}]})",
     1, 2, false},
    {"wrong.json", "{\"version\":", 0, 0, false},
};

}  // namespace

void CallProgram::make_scene() {
  if (hostile()) {
    promises_.call("minkray_scene_make", minkray_scene_make(nullptr), Sure::wrong, true);
    return;
  }
  Answers<minkray_scene> made;
  if (promises_.call("minkray_scene_make", minkray_scene_make(made.data()), Sure::right,
                     made.is_untouched()))
    scenes_.emplace_back().scene = made[0];
}

void CallProgram::release_scene() {
  if (bytes_.below(4) != 0) return make_scene();
  const Given<minkray_scene> given = scene();
  promises_.call("minkray_scene_release", minkray_scene_release(given.value), given.sure, true);
  if (HeldScene* held = model_of(given.value)) held->is_held = false;
}

void CallProgram::check_sizes(HeldScene& of) {
  Answers<std::uint32_t> objects, particles;
  promises_.call("minkray_scene_size",
                 minkray_scene_size(of.scene, objects.data(), particles.data()), Sure::right, true);
  promises_.expect(objects[0] == of.objects && particles[0] == of.particles,
                   "a scene of " + std::to_string(objects[0]) + " objects and " +
                       std::to_string(particles[0]) + " particles, not " +
                       std::to_string(of.objects) + " and " + std::to_string(of.particles));
}

void CallProgram::add_object() {
  const Given<minkray_scene> to = scene();
  const Given<minkray_shape> what = shape();
  const Given<const minkray_pose*> where = pose();
  const char* name = bytes_.below(2) == 0 ? nullptr : "\xff a name\n";
  Answers<std::uint32_t> object;
  const int code = minkray_scene_add(to.value, what.value, where.value, name, object.data());
  HeldScene* held = model_of(to.value);
  if (promises_.call("minkray_scene_add", code, both(both(to.sure, what.sure), where.sure),
                     object.is_untouched())) {
    promises_.expect(object[0] == held->objects, "an object that is not numbered by its place");
    ++held->objects;
    held->committed = Sure::wrong;
  }
  if (held) check_sizes(*held);
}

void CallProgram::add_half_space() {
  const Given<minkray_scene> to = scene();
  double normal[3];
  Sure sure = Sure::right;
  for (double& x : normal) x = number();
  const double offset = number();
  for (const double x : {normal[0], normal[1], normal[2], offset})
    sure = both(sure, right_if(std::isfinite(x)));
  sure = both(sure, right_if(normal[0] != 0 || normal[1] != 0 || normal[2] != 0));
  Answers<std::uint32_t> object;
  const int code = minkray_scene_add_half_space(to.value, normal, offset, nullptr, object.data());
  HeldScene* held = model_of(to.value);
  if (!promises_.call("minkray_scene_add_half_space", code, both(to.sure, sure),
                      object.is_untouched()))
    return;
  ++held->objects;
  held->committed = Sure::wrong;
}

void CallProgram::add_file() {
  static const TemporaryFolder folder;
  const Given<minkray_scene> to = scene();
  const int which = bytes_.below(sizeof files / sizeof files[0] + 1);
  const bool is_there = which < int(sizeof files / sizeof files[0]);
  const SceneFile file = is_there ? files[which] : SceneFile{"none.json", "", 0, 0, false};
  const std::string path = (folder.path() / file.name).string();
  if (is_there && !std::filesystem::exists(path)) folder.write(file.name, file.text);
  Sure sure = to.sure;
  if (file.objects == 0) sure = both(sure, Sure::wrong);
  minkray_file_options options = {sizeof options, nullptr, nullptr, nullptr,
                                  nullptr,        0,       0,       nullptr};
  const bool has_options = bytes_.below(2) == 1;
  if (has_options) {
    const Given<const minkray_pose*> where = pose();
    sure = both(sure, where.sure);
    options.pose = where.value;
    if (options.pose && file.particles > 0) sure = Sure::wrong;
    if (hostile()) options.size -= 1, sure = Sure::wrong;
    if (hostile()) options.geometry = "colision", sure = Sure::wrong;
    if (hostile()) options.package_dir_count = 1, sure = Sure::wrong;
    if (hostile()) options.keyframe = "none", sure = both(sure, Sure::either);
  }
  Answers<std::uint32_t> group;
  const int code = minkray_scene_add_file(to.value, path.c_str(), has_options ? &options : nullptr,
                                          group.data());
  HeldScene* held = model_of(to.value);
  if (promises_.call("minkray_scene_add_file", code, sure, group.is_untouched(),
                     MINKRAY_BAD_INPUT)) {
    promises_.expect(group[0] == held->groups.size(), "a group that is not numbered by its place");
    HeldGroup& added = held->groups.emplace_back();
    added.is_robot = file.is_robot;
    added.has_particles = file.particles > 0;
    std::uint32_t first = 0, count = 0;
    promises_.call("minkray_scene_group",
                   minkray_scene_group(held->scene, group[0], &first, &count, &added.joints),
                   Sure::right, true);
    promises_.expect(first == held->objects && count == file.objects, "a group of other objects");
    for (std::uint32_t joint = 0; joint < added.joints; ++joint) {
      const char* name = nullptr;
      size_t numbers = 0;
      promises_.call("minkray_scene_joint",
                     minkray_scene_joint(held->scene, group[0], joint, &name, &numbers),
                     Sure::right, true);
      promises_.expect(name && (numbers == 1 || numbers == 4), "a joint of odd numbers");
      added.numbers += numbers;
    }
    held->objects += count;
    held->particles += file.particles;
    held->committed = Sure::wrong;
  }
  if (held) check_sizes(*held);
}

void CallProgram::move() {
  const Given<minkray_scene> of = scene();
  const Given<const minkray_pose*> where = pose(true);
  const std::uint32_t which = bytes_.byte() % 8;
  const bool is_group = bytes_.below(3) == 0;
  HeldScene* held = model_of(of.value);
  const std::size_t count = !held ? 0 : is_group ? held->groups.size() : held->objects;
  const int code = is_group ? minkray_scene_set_group_pose(of.value, which, where.value)
                            : minkray_scene_set_pose(of.value, which, where.value);
  Sure sure = both(both(of.sure, where.sure), right_if(which < count));
  if (is_group && which < count && held->groups[which].has_particles) sure = Sure::wrong;
  if (!promises_.call(is_group ? "minkray_scene_set_group_pose" : "minkray_scene_set_pose", code,
                      sure, true))
    return;
  held->committed = Sure::wrong;
  if (is_group) return;
  Answers<minkray_pose> now;
  promises_.call("minkray_scene_pose", minkray_scene_pose(of.value, which, now.data()), Sure::right,
                 now.is_untouched());
  promises_.expect(std::memcmp(now.data(), where.value, sizeof(minkray_pose)) == 0,
                   "a pose that is not the one that was set");
}

void CallProgram::set_joint() {
  static constexpr const char* names[] = {"hinge", "slide", "ball", "none", nullptr};
  const Given<minkray_scene> of = scene();
  const char* name = names[bytes_.below(5)];
  const std::uint32_t group = bytes_.byte() % 4;
  double values[4];
  bool are_finite = true;
  for (double& value : values) are_finite &= std::isfinite(value = number());
  const std::size_t count = bytes_.below(3) == 0 ? 4 : 1;
  HeldScene* held = model_of(of.value);
  Sure sure = both(of.sure, Sure::either);
  if (!held || group >= held->groups.size() || !held->groups[group].is_robot || !name)
    sure = Sure::wrong;
  if (count == 4 && !are_finite) sure = Sure::wrong;
  if (promises_.call("minkray_scene_set_joint",
                     minkray_scene_set_joint(of.value, group, name, values, count), sure, true))
    held->committed = Sure::wrong;
}

void CallProgram::commit() {
  const Given<minkray_scene> of = scene();
  HeldScene* held = model_of(of.value);
  const bool is_done =
      promises_.call("minkray_scene_commit", minkray_scene_commit(of.value), of.sure, true);
  if (held) held->committed = is_done ? Sure::right : Sure::either;
}

void CallProgram::look() {
  const Given<minkray_scene> of = scene();
  const std::uint32_t which = bytes_.byte() % 8;
  HeldScene* held = model_of(of.value);
  const Sure sure = both(of.sure, right_if(held && which < held->objects));
  Answers<const char*> name;
  if (promises_.call("minkray_scene_name", minkray_scene_name(of.value, which, name.data()), sure,
                     name.is_untouched()))
    promises_.expect(std::strlen(name[0]) < 100, "a name that nobody gave");
  Answers<minkray_pose> where;
  promises_.call("minkray_scene_pose", minkray_scene_pose(of.value, which, where.data()), sure,
                 where.is_untouched());
  const Sure group = both(of.sure, right_if(held && which < held->groups.size()));
  Answers<std::uint32_t> first, count, joints;
  promises_.call("minkray_scene_group",
                 minkray_scene_group(of.value, which, first.data(), count.data(), joints.data()),
                 group, first.is_untouched() && count.is_untouched() && joints.is_untouched());
  Answers<size_t> numbers;
  promises_.call("minkray_scene_joint",
                 minkray_scene_joint(of.value, which, 9, name.data(), numbers.data()), Sure::wrong,
                 numbers.is_untouched());
  if (held) check_sizes(*held);
}

}  // namespace minkray::fuzz
