// SPDX-License-Identifier: MIT
// Members whose value is a name out of a list, and pictures that are named by a file.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "renderer/image/image.h"

namespace minkray {

/// One of List::names, or empty. List::what is the noun for messages: "a metal".
template <class List>
struct NameOf {
  std::string name;

  bool operator==(const NameOf&) const = default;
};

/// A picture, and the file that it came from; null if none is named.
struct PictureFile {
  std::string file;
  std::shared_ptr<const Image> image;

  /// True if its numbers are linear light, false for sRGB codes.
  bool is_linear() const {
    return file.ends_with(".exr") || file.ends_with(".hdr") || file.ends_with(".EXR") ||
           file.ends_with(".HDR");
  }
};

}  // namespace minkray
