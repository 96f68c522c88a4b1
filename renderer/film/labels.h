// SPDX-License-Identifier: MIT
// Draws the name of each object under its picture.
#pragma once

#include <string>
#include <vector>

#include "renderer/film/render.h"
#include "renderer/image/image.h"

namespace minkray {

/// A name and where it is written: its upper left corner, in pixels of the whole picture.
struct Label {
  double x = 0, y = 0;
  std::string text;
};

/// Objects are labelled, particles are not. Names of objects that are behind the camera or have
/// none are left out; so are all if the scene does not want them.
std::vector<Label> labels_of(const Scene& scene, const Resolution& resolution);

/// Draws labels onto `image`, the region of the picture of that resolution; those that are outside
/// of the region are not seen.
void draw_labels(Image& image, const std::vector<Label>& labels, const PixelRect& region,
                 const Resolution& resolution);

}  // namespace minkray
