// SPDX-License-Identifier: MIT
// A finished picture into the files that were asked for.
#pragma once

#include "renderer/image/tone_map.h"
#include "renderer/share/part_file.h"

namespace minkray {

/// How light is shown by formats that keep no floats, and kept by OpenEXR.
struct Display {
  double exposure = 0;  ///< in stops
  ToneMap tone_map = ToneMap::srgb;
  bool has_halfs = false;  ///< R, G and B of .exr have 16 bits
};

struct FinishedPicture {
  Image image;                ///< linear, as the scene is lit
  std::vector<Label> labels;  ///< for formats that are to be looked at
  PixelRect window;           ///< which region of the picture the image is
  Resolution resolution;
  ExrImage exr;  ///< the same with all channels and facts
};

/// Encodes and writes to each of the paths: all there is to OpenEXR, the light to other formats
/// that keep floats, and as it is displayed, with labels, to the rest. Ends the process early if
/// it was interrupted.
void write_picture(const std::vector<std::string>& outputs, const FinishedPicture& picture,
                   const Display& display);

/// What formats without floats show, with labels.
Image to_look_at(const FinishedPicture& finished, const Display& display);

/// The tone map of this name in the list of them.
ToneMap tone_map_named(const std::string& name);
std::vector<std::string> tone_map_names();

/// Throws WrongUsage if the exposure is no usable number of stops.
void check_exposure(double exposure);

}  // namespace minkray
