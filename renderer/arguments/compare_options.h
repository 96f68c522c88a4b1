// SPDX-License-Identifier: MIT
// Options of `minkray compare`. The command is part of the command line, but its work needs Embree.
// A separate program, minkray-compare, does that work, so that pictures do not require Embree.
#pragma once

#include "renderer/arguments/image_arguments.h"
#include "renderer/cli/exit_code.h"

namespace minkray {

struct CompareArguments {
  ImageArguments image;
  int rays = 0;        ///< per object; 0: chosen by the number of objects
  int directions = 0;  ///< initial directions of the meshes; 0: chosen likewise
  bool json = false;
};

/// Compares every object of the scene with Embree and prints the results. minkray-compare does this
/// itself (compare_here.cpp). minkray runs minkray-compare with the same command line
/// (compare_elsewhere.cpp), and throws WrongUsage if that has not been built.
void compare(const CompareArguments& options, ExitCode& exit_code);

}  // namespace minkray
