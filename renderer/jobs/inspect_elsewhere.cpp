// SPDX-License-Identifier: MIT
#include "renderer/arguments/inspect_options.h"
#include "renderer/cli/program_beside.h"

namespace minkray {

void inspect(const InspectArguments&, ExitCode&) {
  run_beside("inspect", "minkray-inspect", own_words());
}

}  // namespace minkray
