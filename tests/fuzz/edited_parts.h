// SPDX-License-Identifier: MIT
// Part files and checkpoints of a small picture as Minkray writes them, with edits that bytes
// describe: bytes changed by chance in a packed file would seldom get past its checksums.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/share/part_file.h"

namespace minkray::fuzz {

/// A picture that exists in parts.
struct PartsOfPicture {
  RenderOptions options;         ///< of the first part
  Facts facts;                   ///< of the first part
  std::vector<ExrImage> images;  ///< two shares of it, or one checkpoint
};

/// Tiles, shares of the samples, and both.
inline constexpr int kinds_of_parts = 3;
PartsOfPicture parts_of_kind(int kind);

/// Files left by a render that was interrupted after one tile: plain, with channels of the light,
/// and of a share of the samples.
inline constexpr int kinds_of_checkpoints = 3;
PartsOfPicture checkpoint_of_kind(int kind);

/// Edits the images by lines: "NAME=TEXT" changes a text of the header, "-NAME" takes a text or a
/// plane away, "w X0 Y0 X1 Y1" is another window, "d X0 Y0 X1 Y1" another display, "i NAME" and "f
/// NAME" make a plane one of integers and of floats, "p NAME NUMBER" fills it, "> NAME NAME"
/// renames it; after "2" the second image is edited. Other lines are ignored.
void edit(std::vector<ExrImage>& images, std::string_view lines);

}  // namespace minkray::fuzz
