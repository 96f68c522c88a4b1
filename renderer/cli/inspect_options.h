// SPDX-License-Identifier: MIT
// What `minkray inspect` was asked for. As with `minkray compare`, the verb is part of the command
// line, and what it does lives in a program of its own, minkray-inspect.
#pragma once

#include "renderer/cli/exit_code.h"
#include "renderer/cli/image_arguments.h"

namespace minkray {

struct InspectArguments {
  ImageArguments image;
  std::string beside = "paper";
  std::size_t pairs = 12;
  double megabytes = 0;  ///< of the page; 0: as many as its pixels leave room for
  bool serve = false;
  int port = 0;
};

/// Makes the page, or serves it. In minkray-inspect it does so itself (inspect_here.cpp); in
/// the other programs it runs minkray-inspect with the same command line (inspect_elsewhere.cpp).
void inspect(const InspectArguments& arguments, ExitCode& exit_code);

}  // namespace minkray
