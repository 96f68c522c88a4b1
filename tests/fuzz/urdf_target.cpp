// SPDX-License-Identifier: MIT
#include "tests/fuzz/robot_promises.h"
#include "tests/fuzz/target.h"

namespace minkray::fuzz {

std::string check_urdf(std::string_view bytes) {
  return check_robot_within("robot", bytes, "robot.urdf");
}

}  // namespace minkray::fuzz
