// SPDX-License-Identifier: MIT
#include "tests/fuzz/robot_promises.h"
#include "tests/fuzz/target.h"

namespace minkray::fuzz {

std::string check_sdf(std::string_view bytes) {
  return check_robot_within("sdf", bytes, "robot.sdf");
}

}  // namespace minkray::fuzz
