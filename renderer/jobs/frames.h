// SPDX-License-Identifier: MIT
// Pictures of a scene at several times: ranges of frames and names of their files.
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

/// File of a frame: the run of # in the name becomes the frame's number, padded with zeros to the
/// run's length.
std::string file_of_frame(const std::string& name, int frame);

/// Throws WrongUsage unless the file name has one run of #.
void check_frame_name(const std::string& name);

/// Small copies of frames in rows, in the order in which they were added.
class ContactSheet {
 public:
  void add(const Image& frame);
  /// Arranges the frames in about as many rows as columns, on white.
  Image image() const;

 private:
  std::vector<Image> frames_;
};

}  // namespace minkray
