// SPDX-License-Identifier: MIT
// Man pages (man(7) macros) from the description of the command line.
#pragma once

#include <span>

#include "renderer/cli/verb_description.h"

namespace minkray {

/// minkray(1): all commands.
std::string man_page(std::span<const VerbDescription> verbs);

/// minkray-COMMAND(1).
std::string man_page(const VerbDescription& verb);

}  // namespace minkray
