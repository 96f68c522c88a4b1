// SPDX-License-Identifier: MIT
// A finished picture into the files that were asked for.
#pragma once

#include "renderer/share/part_file.h"

namespace minkray {

struct FinishedPicture {
  Image image;                ///< linear, as the scene is lit
  std::vector<Label> labels;  ///< for formats that are to be looked at
  PixelRect window;           ///< which region of the picture the image is
  Resolution resolution;
  ExrImage exr;  ///< the same with all channels and facts
};

/// Encodes and writes to each of the paths: all there is to OpenEXR, the light to other formats
/// that keep floats, and after `exposure` (in stops) and with labels to the rest. Ends the process
/// early if it was interrupted.
void write_picture(const std::vector<std::string>& outputs, const FinishedPicture& picture,
                   double exposure);

/// What formats without floats show: after the exposure, with labels.
Image to_look_at(const FinishedPicture& finished, double exposure);

/// Throws WrongUsage if the exposure is no usable number of stops.
void check_exposure(double exposure);

}  // namespace minkray
