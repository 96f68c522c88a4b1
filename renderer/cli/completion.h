// SPDX-License-Identifier: MIT
// Completion scripts for shells, from the description of the command line.
#pragma once

#include <span>

#include "renderer/cli/verb_description.h"

namespace minkray {

std::string bash_completion(std::span<const VerbDescription> verbs);
std::string zsh_completion(std::span<const VerbDescription> verbs);
std::string fish_completion(std::span<const VerbDescription> verbs);

}  // namespace minkray
