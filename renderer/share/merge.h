// SPDX-License-Identifier: MIT
// Putting the pieces of one picture together: tiles, shares of the samples, or both.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/share/part_file.h"

namespace minkray {

/// What one piece took.
struct PieceCost {
  std::string name;  ///< "tile 3/8"
  double cpu_seconds = 0;
  std::uintmax_t bytes = 0;  ///< of its file
};

struct Merged {
  ExrImage exr;  ///< all planes of the picture; the facts that its pieces have in common
  RayCounts counts;
  std::vector<std::string> missing;  ///< "tile 3/8", "samples 1/2 of tile 3/8"
  std::vector<PieceCost> costs;      ///< in the order of the files

  /// The picture's colours.
  Image image() const { return image_of(exr, "R", "G", "B"); }
};

/// Reads the files of the pieces, in any order, and puts them together: the same bits as if the
/// picture had been rendered at once. Throws BadInput if pieces are of different pictures, given
/// twice, damaged, or missing. With `allow_partial` they may be missing: missing tiles are black
/// with A = 0, and of missing samples the mean of the others takes the place.
Merged merge_parts(const std::vector<std::string>& files, bool allow_partial);

/// Whether the file is the finished piece of that picture: tile and share as in the facts.
bool is_part_of(const std::string& file, const Facts& facts);

}  // namespace minkray
