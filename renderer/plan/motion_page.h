// SPDX-License-Identifier: MIT
// A motion as one HTML page that needs no network: the bodies' meshes, their poses at many moments,
// and the verdict. The page plays the motion and shows the worst pair.
#pragma once

#include <string>

#include "renderer/plan/workcell.h"

namespace minkray {

/// `verdict_json` is the output of --json, `text` the verdict in words, `worst` the time to begin
/// at.
std::string motion_page(const Workcell& cell, const JointPath& path, const Json& verdict_json,
                        const std::string& text, double worst);

/// Page with "<!-- motion -->" as placeholder of its data (motion_page_html.cpp).
std::string motion_page_html();

}  // namespace minkray
