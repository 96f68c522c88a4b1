// SPDX-License-Identifier: MIT
// Showing a picture in the terminal that the program was started in.
#pragma once

#include <string>

#include "renderer/image/image.h"

namespace minkray {

class Verb;

struct PreviewArguments {
  std::string preview;  ///< empty: none; else auto or one of the ways

  /// Adds --preview.
  void add_to(const Verb& verb);
};

/// Below what is there, or, where pictures follow each other, from the screen's upper left corner.
enum class PreviewPlace : unsigned char { below, top_of_screen };

/// Writes the picture to stdout if the arguments ask for it: in the way they name, or in the best
/// one that the terminal says that it has, which takes at most a fifth of a second to answer. Where
/// stdout is no terminal it is half blocks, and what is to be on a screen is left out.
void show_preview(const Image& picture, const PreviewArguments& arguments,
                  PreviewPlace place = PreviewPlace::below);

}  // namespace minkray
