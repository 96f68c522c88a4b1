// SPDX-License-Identifier: MIT
// Where libsdformat puts the links of an SDF file, and along what its joints turn.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/math/affine.h"

namespace minkray::testing {

struct SdformatLinks {
  std::map<std::string, Affine<double>> links;  ///< in the world, by "model::link"
  std::map<std::string, Vec3<double>> axes;     ///< of joints, in the child link's frame
};

/// Nothing, and why, if it does not read the file.
std::optional<SdformatLinks> sdformat_links(const std::string& file, std::string& why);

}  // namespace minkray::testing
