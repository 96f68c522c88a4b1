// SPDX-License-Identifier: MIT
// A motion as one HTML page, which needs no network: the bodies' meshes, where they are at many
// moments, and the verdict. The page plays the motion and shows the worst pair.
#pragma once

#include <string>

#include "renderer/plan/workcell.h"

namespace minkray {

/// `verdict_json` is what --json prints; `text` the verdict in words; `worst` the time to begin at.
std::string motion_page(const Workcell& cell, const JointPath& path, const Json& verdict_json,
                        const std::string& text, double worst);

/// The page with "<!-- motion -->" where its data go (motion_page_html.cpp).
std::string motion_page_html();

}  // namespace minkray
