// SPDX-License-Identifier: MIT
// A motion as one HTML page that needs no network: the bodies' meshes, their poses at many moments,
// and the verdict. The page plays the motion and shows the worst pair.
#pragma once

#include <string>

#include "renderer/plan/workcell.h"

namespace minkray {

struct ShownMotion {
  Json verdict;                            ///< output of --json
  std::string text;                        ///< verdict in words
  double worst = 0;                        ///< time to begin at
  bool has_times = true;                   ///< false: times are numbers of rows
  Vec3<double> view = {0.57, 0.72, 0.39};  ///< direction to the viewer
};

std::string motion_page(const Workcell& cell, const JointPath& path, const ShownMotion& shown);

/// Page with "<!-- motion -->" as placeholder of its data (motion_page_html.cpp).
std::string motion_page_html();

}  // namespace minkray
