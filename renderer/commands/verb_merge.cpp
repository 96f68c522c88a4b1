// SPDX-License-Identifier: MIT
// minkray merge: one picture from the part files that `render --tile` and `--sample-share` made.
#include <iostream>
#include <memory>

#include "core/support/named_kind.h"
#include "renderer/arguments/image_arguments.h"
#include "renderer/base/errors.h"
#include "renderer/base/interrupt.h"
#include "renderer/cli/command_line.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/jobs/write_picture.h"
#include "renderer/share/merge.h"

namespace minkray {
namespace {

struct MergeVerbOptions {
  std::vector<std::string> part_files;
  std::vector<std::string> outputs;
  double exposure = 0;
  std::string tone_map = "srgb";
  bool allow_partial = false;
  bool times = false;
};

void run(const MergeVerbOptions& options) {
  check_exposure(options.exposure);
  check_outputs(options.outputs);
  Merged merged = merge_part_files(options.part_files, options.allow_partial);
  if (merged.missing > 0) std::cerr << "warning: missing: " << merged.missing_names << "\n";
  merged.exr.texts[fact::command] = command_line();
  const InterruptGuard guard;
  write_picture(options.outputs,
                {merged.image(), labels_of(merged.exr.texts), merged.exr.window,
                 resolution_of(merged.exr.texts), merged.exr},
                {options.exposure, kind_named(tone_maps, options.tone_map)});
  warn_of_counts(merged.counts);
  if (options.times)
    for (const ShareCost& cost : merged.costs)
      std::cout << cost.name << " " << cost.cpu_seconds << " " << cost.bytes << "\n";
}

}  // namespace

void add_merge(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("merge");
  const auto options = std::make_shared<MergeVerbOptions>();
  verb.add_option("parts", options->part_files, "Part files (.exr), in any order")
      .required()
      .reads_file();
  add_output_option(verb, options->outputs);
  verb.add_option("--exposure", options->exposure, "Exposure of PNG output in stops")
      .show_default();
  verb.add_option("--tonemap", options->tone_map, "Tone mapping of PNG output")
      .one_of(names_in(tone_maps))
      .show_default();
  verb.add_flag("--allow-partial", options->allow_partial,
                "Accept missing parts: missing tiles are black, missing samples are ignored");
  verb.add_flag("--times", options->times,
                "Print name, CPU time (s) and file size (bytes) of each part");
  verb.on_call([options] { run(*options); });
}

}  // namespace minkray
