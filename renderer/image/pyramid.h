// SPDX-License-Identifier: MIT
// Image pyramid after Williams, "Pyramidal Parametrics" (1983): each level has half the width and
// height, so a large area is looked up as fast as a small one.
#pragma once

#include <vector>

#include "renderer/image/image.h"

namespace minkray {

/// The smaller ones, down to a single pixel, which is the mean. Sides are halved and rounded up; a
/// pixel is the mean of the area that it covers, parts of pixels included. Values above white are
/// clamped to white.
std::vector<Image> smaller_images(const Image& image);

}  // namespace minkray
