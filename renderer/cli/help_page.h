// SPDX-License-Identifier: MIT
// Pages of --help: the options of one command under headings, or all commands of the program. Lines
// have at most 80 columns.
#pragma once

#include <span>
#include <string>

#include "renderer/cli/verb_description.h"

namespace minkray {

std::string help_page(const VerbDescription& verb);
std::string help_page(std::span<const VerbDescription> verbs, const std::string& doc,
                      const std::string& footer);

}  // namespace minkray
