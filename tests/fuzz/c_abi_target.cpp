// SPDX-License-Identifier: MIT
#include "tests/fuzz/c_abi_program.h"
#include "tests/fuzz/target.h"

namespace minkray::fuzz {

void CallProgram::step() {
  using Step = void (CallProgram::*)();
  static constexpr Step steps[] = {
      &CallProgram::make_shape, &CallProgram::read_shape,     &CallProgram::make_custom,
      &CallProgram::own_shape,  &CallProgram::write_shape,    &CallProgram::ask_shape,
      &CallProgram::make_scene, &CallProgram::release_scene,  &CallProgram::add_object,
      &CallProgram::add_object, &CallProgram::add_half_space, &CallProgram::add_file,
      &CallProgram::move,       &CallProgram::set_joint,      &CallProgram::commit,
      &CallProgram::commit,     &CallProgram::look,           &CallProgram::cast,
      &CallProgram::cast,       &CallProgram::cast_at_one,    &CallProgram::prove,
      &CallProgram::distance,   &CallProgram::impact,         &CallProgram::clearance,
      &CallProgram::lidar,      &CallProgram::picture};
  constexpr int count = sizeof steps / sizeof steps[0];
  (this->*steps[bytes_.below(count)])();
}

std::string CallProgram::run() {
  constexpr int most_steps = 60;
  for (int i = 0; i < most_steps && !bytes_.empty() && promises_.broken().empty(); ++i) step();
  for (HeldScene& scene : scenes_)
    promises_.call("minkray_scene_release", minkray_scene_release(scene.scene),
                   right_if(scene.is_held), true);
  for (HeldShape& shape : shapes_)
    for (; shape.owners >= 0; --shape.owners)
      promises_.call("minkray_shape_release", minkray_shape_release(shape.shape),
                     right_if(shape.owners > 0), true);
  promises_.expect(released_.times == static_cast<int>(supports_.size()),
                   "of " + std::to_string(supports_.size()) + " support functions " +
                       std::to_string(released_.times) + " were released");
  return promises_.broken();
}

std::string check_c_abi(std::string_view bytes) {
  return CallProgram(Bytes(bytes)).run();
}

}  // namespace minkray::fuzz
