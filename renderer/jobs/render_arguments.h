// SPDX-License-Identifier: MIT
// Command-line options of `minkray render`.
#pragma once

#include <optional>
#include <string>

#include "core/support/named_kind.h"
#include "renderer/arguments/image_arguments.h"
#include "renderer/jobs/write_picture.h"
#include "renderer/share/ranks.h"

namespace minkray {

class Verb;

struct RenderArguments {
  ImageArguments image;
  double exposure = 0;
  std::string tone_map = "srgb";
  double clamp = 0;
  double noise = 0;
  int bounces = IntegratorOptions().bounces;
  int ray_group = IntegratorOptions().ray_group;
  int max_depth = IntegratorOptions().max_depth;
  std::string integrator = "auto";
  BvhBuild build = BvhBuild::quality;
  bool certify = false;
  std::string stats;  ///< empty: none, "true": text, "json"
  std::optional<std::string> aov;
  std::optional<std::string> tile, sample_share;
  std::optional<int> tiles;
  double checkpoint_seconds = 60;
  bool resume = false;
  bool progressive = false;
  bool denoise = false;
  bool has_halfs = false;
  std::string tev;  ///< empty: none
  std::optional<std::string> frames;
  double rate = 24;
  std::string contact_sheet;  ///< empty: none

  /// Adds the options, which are written to these members when the command is called; defaults in
  /// help are the members' values.
  void add_to(const Verb& verb);

  /// Chooses an output if none is given, and adds the checkpoint next to it to the command's files.
  /// Throws WrongUsage if an output is required.
  void choose_output(const Ranks& ranks);

  Display display() const { return {exposure, kind_named(tone_maps, tone_map), has_halfs}; }
  bool is_share() const { return tile || sample_share; }
};

}  // namespace minkray
