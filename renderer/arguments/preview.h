// SPDX-License-Identifier: MIT
// Shows a picture in the terminal that runs the program.
#pragma once

#include <string>

#include "renderer/image/image.h"

namespace minkray {

class Verb;

struct PreviewArguments {
  std::string preview;  ///< empty: none; otherwise auto or one of the names of protocols

  /// Adds --preview.
  void add_to(const Verb& verb);
};

/// Below the existing text, or, for a sequence of pictures, from the screen's upper left corner.
enum class PreviewPlace : unsigned char { below, top_of_screen };

/// Writes the picture to stdout if the arguments request it: by the given protocol, or by the best
/// one that the terminal reports within a fifth of a second. If stdout is not a terminal, half
/// blocks are used and pictures for top_of_screen are left out.
void show_preview(const Image& picture, const PreviewArguments& arguments,
                  PreviewPlace place = PreviewPlace::below);

}  // namespace minkray
