// SPDX-License-Identifier: MIT
// Pictures of a scene at several times: which, and into which files.
#pragma once

#include <string>
#include <vector>

#include "renderer/image/image.h"

namespace minkray {

/// Frames first <= i <= last.
struct FrameRange {
  int first = 0, last = 0;

  int count() const { return last - first + 1; }
};

/// Reads "a..b". Throws WrongUsage.
FrameRange parse_frames(const std::string& text);

/// The file of a frame: the run of # in the name becomes the frame's number, with zeros in front up
/// to the run's length.
std::string file_of_frame(const std::string& name, int frame);

/// Throws WrongUsage unless the file name has one run of #.
void check_frame_name(const std::string& name);

/// Small copies of frames in rows, in the order in which they came.
class ContactSheet {
 public:
  void add(const Image& frame);
  /// Frames in about as many rows as columns, on white.
  Image image() const;

 private:
  std::vector<Image> frames_;
};

}  // namespace minkray
