// SPDX-License-Identifier: MIT
// Writes a finished picture to its files.
#pragma once

#include "renderer/image/tone_map.h"
#include "renderer/share/part_file.h"

namespace minkray {

/// Display of light in formats without floats, and storage in OpenEXR.
struct Display {
  double exposure = 0;  ///< exposure in stops
  ToneMap tone_map = ToneMap::srgb;
  bool has_halfs = false;  ///< R, G and B of .exr have 16 bits
};

struct FinishedPicture {
  Image image;                ///< linear, as the scene is lit
  std::vector<Label> labels;  ///< for formats without floats
  PixelRect window;           ///< region of the picture that the image covers
  Resolution resolution;
  ExrImage exr;  ///< the same picture with all channels and facts
};

/// Encodes and writes to each of the paths: everything to OpenEXR, light to other formats with
/// floats, and the displayed picture with labels to the rest. Ends the process early if it was
/// interrupted.
void write_picture(const std::vector<std::string>& outputs, const FinishedPicture& picture,
                   const Display& display);

/// Picture for formats without floats, with labels.
Image to_look_at(const FinishedPicture& finished, const Display& display);

/// Throws WrongUsage if the exposure is not a usable number of stops.
void check_exposure(double exposure);

}  // namespace minkray
