// SPDX-License-Identifier: MIT
// Version and commit of this build.
#pragma once

#include <string_view>

namespace minkray {

/// "minkray 0.1.0 (4f0c2d1ab93e)": the version and the commit of the sources, with a "+" behind it
/// if they were changed since. For sources without a history, such as a package's, "minkray
/// 0.1.0".
std::string_view version_and_commit();

}  // namespace minkray
