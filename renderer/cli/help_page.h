// SPDX-License-Identifier: MIT
// What --help prints: of one command its options under headings, of the program all commands. Lines
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
