// SPDX-License-Identifier: MIT
// OpenEXR files in memory: any number of named planes of floats or unsigned integers, a data
// window, and text attributes. Only exr.cpp includes the library.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "renderer/image/image.h"

namespace minkray {

/// One channel; rows from the top, as many numbers as the data window has pixels.
struct ExrPlane {
  std::string name;
  std::variant<std::vector<float>, std::vector<std::uint32_t>> values;
  bool is_half = false;  ///< floats are written with 16 bits: 11 of precision, 65504 at most
};

struct ExrImage {
  PixelRect display;  ///< the whole picture
  PixelRect window;   ///< the region that is here
  std::vector<ExrPlane> planes;
  std::map<std::string, std::string> texts;  ///< string attributes of the header, by name

  /// The plane of that name; null if there is none.
  const ExrPlane* find(std::string_view name) const;
};

/// Takes the picture apart into the planes R, G and B, which are added, with that before their
/// names.
void add_colour_planes(ExrImage& exr, const Image& image, const std::string& before = "");

/// The file's bytes: one part, scan lines, compressed without loss. The same image gives the same
/// bytes.
std::vector<unsigned char> encode_exr(const ExrImage& image);

/// The image in a file's bytes; `file` is its name for messages. Half floats become floats; string
/// attributes are kept, others are left out. Throws BadInput where it cannot be used.
ExrImage decode_exr(std::string_view bytes, const std::string& file);

/// decode_exr of a file.
ExrImage read_exr(const std::string& file);

/// True if the file exists and begins as OpenEXR files do.
bool is_exr(const std::string& file);

/// Just the string attributes of a file, without its pixels.
std::map<std::string, std::string> read_exr_texts(const std::string& name);

}  // namespace minkray
