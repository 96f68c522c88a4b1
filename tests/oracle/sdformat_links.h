// SPDX-License-Identifier: MIT
// Poses of an SDF file's links, and axes of its joints, by libsdformat.
#pragma once

#include <map>
#include <string>

#include "core/math/affine.h"

namespace minkray::testing {

struct SdformatLinks {
  std::map<std::string, Affine<double>> links;  ///< in the world, by "model::link"
  std::map<std::string, Vec3<double>> axes;     ///< of joints, in the child link's frame
};

}  // namespace minkray::testing

/// False, and why, if it does not read the file. Tests load this on first use, as libsdformat
/// makes all its tables at once: half of a test's start-up time.
extern "C" bool minkray_sdformat_links(const std::string& file,
                                       minkray::testing::SdformatLinks& all, std::string& why);
