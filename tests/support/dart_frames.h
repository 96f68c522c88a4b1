// SPDX-License-Identifier: MIT
// Compares the links of a URDF with DART's forward kinematics, where python3-dartpy is installed.
#pragma once

#include <optional>
#include <string>

namespace minkray {

struct FrameErrors {
  std::size_t links = 0;   ///< that both know
  std::size_t states = 0;  ///< random values of all joints
  double worst = 0;        ///< of positions (m) and entries of rotations
  std::string missing;     ///< a link that one of the two does not know
};

/// Nothing if DART is not installed, or does not read the file.
std::optional<FrameErrors> frames_beside_dart(const std::string& urdf, int states);

/// The robots of this comparison, relative to robot_models().
inline constexpr const char* robots_beside_dart[] = {
    "simbody/TaskSpaceControl-Atlas/models/atlas_v4.urdf", "dart/urdf/wam/wam.urdf",
    "dart/urdf/KR5/KR5 sixx R650.urdf", "dart/urdf/drchubo/drchubo.urdf"};

}  // namespace minkray
