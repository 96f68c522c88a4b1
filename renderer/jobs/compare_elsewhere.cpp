// SPDX-License-Identifier: MIT
#include "renderer/arguments/compare_options.h"
#include "renderer/cli/program_beside.h"

namespace minkray {

void compare(const CompareArguments&, ExitCode&) {
  run_beside("compare", "minkray-compare", own_words());
}

}  // namespace minkray
