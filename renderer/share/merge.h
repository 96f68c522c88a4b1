// SPDX-License-Identifier: MIT
// Merges the part files of one picture: tiles, shares of the samples, or both.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/share/part_file.h"

namespace minkray {

/// Cost of one share.
struct ShareCost {
  std::string name;  ///< "tile 3/8"
  double cpu_seconds = 0;
  std::uintmax_t bytes = 0;  ///< of its file
};

struct Merged {
  ExrImage exr;  ///< all planes of the picture; the facts that its shares have in common
  RayCounts counts;
  std::uint64_t missing = 0;     ///< number of shares
  std::string missing_names;     ///< the first of them: "tile 3/8, samples 1/2 of tile 3/8"
  std::vector<ShareCost> costs;  ///< in the order of the files

  /// The picture's colours.
  Image image() const { return image_of(exr, "R", "G", "B"); }
};

/// Reads the part files, in any order, and puts them together: the same bits as if the
/// picture had been rendered at once. Throws BadInput if they are of different pictures, given
/// twice, damaged, or missing. With `allow_partial` they may be missing: missing tiles are black
/// with A = 0, and of missing samples the mean of the others takes the place.
Merged merge_part_files(const std::vector<std::string>& files, bool allow_partial);

/// True if the file is the finished part file of that picture: tile and share as in the facts.
bool is_part_file_of(const std::string& file, const Facts& facts);

}  // namespace minkray
