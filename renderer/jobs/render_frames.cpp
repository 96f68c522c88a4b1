// SPDX-License-Identifier: MIT
#include "renderer/jobs/render_frames.h"

#include <filesystem>

#include "renderer/base/hash.h"
#include "renderer/cli/command_files.h"
#include "renderer/jobs/render_picture.h"
#include "renderer/jobs/timed.h"
#include "renderer/jobs/write_picture.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/share/frames_record.h"

namespace minkray {
namespace {

/// One record per output.
std::vector<FramesRecord> records_of(const RenderJob& job, const RenderArguments& options) {
  Facts facts = facts_of(job);
  facts[fact::rate] = Json(options.rate).dump();
  facts[fact::exposure] = Json(options.exposure).dump();
  std::vector<FramesRecord> records;
  for (const std::string& name : options.image.outputs)
    records.emplace_back(FramesRecord::path_for(name), facts, options.resume);
  for (const FramesRecord& record : records) record.write();  // writes none before all are checked
  return records;
}

/// Adds each frame's files to the command's: none may be an input or another output.
void add_frames(const RenderArguments& options, const FrameRange& frames) {
  for (const std::string& name : options.image.outputs) {
    options.image.files->write(FramesRecord::path_for(name), "--output");
    for (int frame = frames.first; frame <= frames.last; ++frame)
      options.image.files->write(file_of_frame(name, frame), "--output");
  }
}

}  // namespace

void render_frames(RenderJob& job, const RenderArguments& options, const FrameRange& frames,
                   RenderStatistics& statistics) {
  add_frames(options, frames);
  const std::string scene_hash = job.scene.hash;
  std::vector<FramesRecord> records = records_of(job, options);
  ContactSheet sheet;
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    std::vector<std::string> outputs;
    bool is_there = true;
    for (std::size_t i = 0; i < records.size(); ++i) {
      outputs.push_back(file_of_frame(options.image.outputs[i], frame));
      is_there = is_there && records[i].has(frame) && std::filesystem::exists(outputs[i]);
    }
    if (options.resume && is_there) continue;
    if (!options.image.quiet) std::cerr << printable(outputs.front()) << "\n";
    timed(options.image.import.verbose, "move", statistics.build_seconds, [&] {
      set_time(job.scene, frame / options.rate);
      follow(job.world, job.scene);
    });
    Hash hash;
    hash.add(scene_hash);
    hash.add(std::to_string(job.scene.time));
    job.scene.hash = hash.text();
    const Image image = render_picture(job, options, outputs, statistics);
    for (FramesRecord& record : records) record.add(frame);
    if (!options.contact_sheet.empty()) sheet.add(image);
  }
  if (options.contact_sheet.empty()) return;
  const Image image = sheet.image();
  const FinishedPicture picture{
      image, {}, {0, 0, image.width, image.height}, {image.width, image.height}, {}};
  write_picture({options.contact_sheet}, picture, options.display());
}

}  // namespace minkray
