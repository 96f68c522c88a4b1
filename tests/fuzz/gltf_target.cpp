// SPDX-License-Identifier: MIT
#include "tests/fuzz/robot_promises.h"
#include "tests/fuzz/target.h"

namespace minkray::fuzz {

std::string check_gltf(std::string_view bytes) {
  return check_robot(std::string(bytes), "robot.gltf");
}

}  // namespace minkray::fuzz
