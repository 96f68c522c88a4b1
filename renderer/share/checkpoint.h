// SPDX-License-Identifier: MIT
// Checkpoints of long renders: finished tiles are saved at intervals to a file next to the picture,
// from which a killed render resumes. Pixels are independent, so the picture has the same bits
// after any number of interruptions.
#pragma once

#include <chrono>
#include <future>
#include <string>

#include "renderer/share/picture_facts.h"

namespace minkray {

class Checkpoint {
 public:
  /// The file that belongs to a picture.
  static std::string path_for(const std::string& output) { return output + ".checkpoint"; }

  /// `facts` identify the picture; a file is written every `seconds` at most, never if 0.
  Checkpoint(std::string path, const RenderOptions& options, Facts facts, double seconds);
  /// Waits for a file that is being written.
  ~Checkpoint();
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  /// True if there is a file.
  bool exists() const;

  /// Throws CannotWrite if there is something that is no checkpoint.
  void check_replaceable() const;

  /// The rendering to continue, from the file. Throws BadInput, with the differences, if the file
  /// cannot be used or is of another picture.
  RenderJournal load();

  /// Must be called after each tile, one at a time. Writes at intervals, on its own thread.
  void tile_finished(const Rendering& rendering, std::size_t tile);

  /// Called after an interruption, when no thread renders, to write finished tiles once more. A
  /// rendering shorter than `seconds` leaves no file, and does not touch another's.
  void interrupted(const Rendering& rendering);

  /// The picture is kept: the file, if there is one, has served.
  void remove();

  /// Error of writing, if any; the rendering continues.
  std::string complaint();

 private:
  using Clock = std::chrono::steady_clock;
  bool is_due() const;
  void write_later(const Rendering& rendering);
  Rendering done_tiles_of(const Rendering& rendering) const;

  std::string path_;
  RenderOptions options_;
  Facts facts_;
  std::chrono::duration<double> pause_;
  Clock::time_point last_ = Clock::now();
  std::vector<bool> done_;
  bool is_ours_ = false;              ///< true if the file, if any, was loaded or written here
  std::future<std::string> writing_;  ///< gives the complaint
  std::string complaint_;
};

}  // namespace minkray
