// SPDX-License-Identifier: MIT
// Reads the inputs that are kept for the fuzz targets. tests/fuzz/inputs.py writes their files.
#pragma once

#include <string>
#include <vector>

#include "tests/support/source_files.h"

namespace minkray::fuzz {

/// The inputs of a target of one kind, corpus or findings, as files with a name each: the name of
/// the packed file, the kind and the input's own.
std::vector<SourceFile> kept_inputs(const std::string& target, const std::string& kind);

}  // namespace minkray::fuzz
