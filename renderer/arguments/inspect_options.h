// SPDX-License-Identifier: MIT
// Options of `minkray inspect`. Its work is done by a separate program, minkray-inspect, in the
// same way as for `minkray compare`.
#pragma once

#include "renderer/arguments/image_arguments.h"
#include "renderer/cli/exit_code.h"

namespace minkray {

struct InspectArguments {
  ImageArguments image;
  std::string beside = "paper";
  std::size_t pairs = 12;
  double megabytes = 0;  ///< size of the page; 0: by the number of its pixels
  bool serve = false;
  int port = 0;
};

/// Makes the page, or serves it. minkray-inspect does this itself (inspect_here.cpp); other
/// programs run minkray-inspect with the same command line (inspect_elsewhere.cpp).
void inspect(const InspectArguments& arguments, ExitCode& exit_code);

}  // namespace minkray
