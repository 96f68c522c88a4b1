// SPDX-License-Identifier: MIT
// What `minkray compare` was asked for. The verb is part of the command line; what it does needs
// Embree, so that it lives in a program of its own, minkray-compare, which nobody has to build for
// a picture.
#pragma once

#include "renderer/cli/exit_code.h"
#include "renderer/cli/image_arguments.h"

namespace minkray {

struct CompareArguments {
  ImageArguments image;
  int rays = 0;        ///< an object; 0: as many as the scene's objects leave time for
  int directions = 0;  ///< that the meshes begin with; 0: likewise
  bool json = false;
};

/// Compares every object of the scene with Embree and prints what came out. In minkray-compare it
/// does so itself (compare_here.cpp); in minkray it runs minkray-compare with the same command line
/// (compare_elsewhere.cpp), and throws WrongUsage if that has not been built.
void compare(const CompareArguments& options, ExitCode& exit_code);

}  // namespace minkray
