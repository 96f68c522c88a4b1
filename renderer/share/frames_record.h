// SPDX-License-Identifier: MIT
// Record of an animation's finished frames, in a small file next to them. Frames that are not in it
// are rendered even if files with their names exist, so a resumed render never mixes frames of two
// scenes or sets of options.
#pragma once

#include <set>
#include <string>

#include "renderer/share/picture_facts.h"

namespace minkray {

namespace fact {

inline constexpr const char* rate = "minkray.rate";          ///< frames per second
inline constexpr const char* exposure = "minkray.exposure";  ///< in stops

}  // namespace fact

class FramesRecord {
 public:
  /// The file that belongs to frames; `name` has # in the place of their numbers.
  static std::string path_for(const std::string& name) { return name + ".frames"; }

  /// `facts` are those that all frames have in common. Takes over the frames of an existing
  /// record; writes nothing yet. One of other frames is replaced; with `resume` it throws BadInput
  /// with the differences. If the file is no record it throws BadInput with `resume`, and
  /// CannotWrite without.
  FramesRecord(std::string path, Facts facts, bool resume);

  bool has(int frame) const { return frames_.contains(frame); }

  /// The frame's file is written. Frames that others add meanwhile are kept.
  void add(int frame);

  void write() const;

 private:
  std::string path_;
  Facts facts_;
  std::set<int> frames_;
};

}  // namespace minkray
