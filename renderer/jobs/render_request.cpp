// SPDX-License-Identifier: MIT
#include "renderer/jobs/render_request.h"

#include <algorithm>
#include <cmath>

#include "core/support/named_kind.h"
#include "renderer/base/errors.h"
#include "renderer/cli/command_line.h"
#include "renderer/cli/words_meant.h"
#include "renderer/film/data_channels.h"
#include "renderer/io/image_file.h"
#include "renderer/jobs/write_picture.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

void check_shares(const RenderOptions& options) {
  const Share tile = options.tile, share = options.sample_share;
  const PixelRect picture = options.picture();
  if (!can_be_tiled(picture, tile.count))
    throw WrongUsage("--tile: the picture has too few pixels for " + std::to_string(tile.count) +
                     " tiles");
  const int blocks = SampleBlocks{options.samples}.count();
  if (share.count > blocks)
    throw WrongUsage("--sample-share: " + std::to_string(options.samples) +
                     " samples per pixel can be shared by at most " + std::to_string(blocks) +
                     " (got " + share.text() + ")");
}

/// Throws WrongUsage for another program's name of a channel, with the name to use here.
void check_channels(const std::string& list) {
  const std::vector<std::string> known = names_in(data_channels);
  for (const std::string& name : pieces_of(list, ',')) {
    if (name.empty() || name == "all" || std::ranges::find(known, name) != known.end()) continue;
    if (const std::string meant = value_meant(name, known); !meant.empty())
      throw WrongUsage("--aov: there is no channel " + printable(name, 40) + "; " + meant);
  }
}

}  // namespace

RenderJob job_of(const RenderArguments& options, const Ranks& ranks) {
  RenderJob job;
  check_exposure(options.exposure);
  if (!options.stats.empty() && options.stats != "true" && options.stats != "json")
    throw WrongUsage("--stats: must be given alone or as --stats=json (got " + options.stats + ")");
  if (std::isnan(options.checkpoint_seconds))
    throw WrongUsage("--checkpoint: must be a number of seconds (got nan)");
  if (std::isnan(options.rate))
    throw WrongUsage("--rate: must be a number of frames per second (got nan)");
  if (options.aov) {
    check_channels(*options.aov);
    job.channels = parse_data_channels(*options.aov);
  }
  const std::vector<std::string>& outputs = options.image.outputs;
  if (options.aov && std::none_of(outputs.begin(), outputs.end(), keeps_planes))
    throw WrongUsage("--aov: needs an output that ends in .exr (got " + outputs.front() + ")");
  for (const std::string& output : outputs)
    if (options.is_share() && !keeps_planes(output))
      throw WrongUsage("--output: a share of a picture must end in .exr (got " + output + ")");
  if (options.is_share() && options.has_halfs)
    throw WrongUsage(
        "--half: not allowed with --tile or --sample-share, which store 32-bit floats");
  if (options.tile) job.options.tile = parse_share(*options.tile, "--tile");
  if (options.sample_share)
    job.options.sample_share = parse_share(*options.sample_share, "--sample-share");
  if (options.sample_share && options.noise > 0)
    throw WrongUsage(
        "--noise: not allowed with --sample-share, since it needs all samples of a pixel");
  if (options.sample_share && options.aov)
    throw WrongUsage("--aov: not allowed with --sample-share (use --tile)");
  if (options.progressive && (options.is_share() || ranks.count() > 1))
    throw WrongUsage(
        "--progressive: not allowed with --tile, --sample-share or MPI, which render parts");
  if (options.denoise && (options.is_share() || ranks.count() > 1))
    throw WrongUsage(
        "--denoise: not allowed with --tile, --sample-share or MPI, which render parts");
  if (options.denoise && options.image.samples < 2)
    throw WrongUsage("--denoise: needs at least 2 samples per pixel");
  if (!options.tev.empty() && (options.is_share() || ranks.count() > 1))
    throw WrongUsage("--tev: not allowed with --tile, --sample-share or MPI, which render parts");
  if (ranks.count() > 1 && options.is_share())
    throw WrongUsage("--tile, --sample-share: not allowed with MPI, whose ranks share the picture");
  if (options.certify && (ranks.count() > 1 || options.resume))
    throw WrongUsage(
        "--certify: not allowed with --resume or MPI, since it proves all rays of one run");
  if (ranks.count() == 1 && options.tiles)
    throw WrongUsage("--tiles: requires several MPI ranks (mpirun minkray render)");
  if (ranks.rank() == 0) check_outputs(outputs);
  job.command = command_line();
  job.checkpoint_seconds = options.checkpoint_seconds;
  job.resume = options.resume;
  job.denoise = options.denoise;
  job.wants_planes = ranks.count() > 1 || std::any_of(outputs.begin(), outputs.end(), keeps_planes);
  job.quiet = options.image.quiet;
  return job;
}

FrameRange frames_of(const RenderArguments& options, const Ranks& ranks) {
  if (!options.frames) {
    if (!options.contact_sheet.empty()) throw WrongUsage("--contact-sheet: requires --frames");
    return {};
  }
  const FrameRange frames = parse_frames(*options.frames);
  for (const std::string& output : options.image.outputs) check_frame_name(output);
  if (options.is_share() || ranks.count() > 1)
    throw WrongUsage(
        "--frames: not allowed with --tile, --sample-share or MPI (share the frames instead)");
  if (options.certify)
    throw WrongUsage("--frames: not allowed with --certify, which proves one picture");
  if (options.contact_sheet.empty()) return frames;
  if (options.resume)
    throw WrongUsage(
        "--contact-sheet: not allowed with --resume, since it shows all frames of one run");
  check_outputs({options.contact_sheet});
  return frames;
}

void set_options(RenderJob& job, const RenderArguments& options) {
  const RenderOptions shares = job.options;
  job.options = options.image.render_options(job.scene);
  job.options.tile = shares.tile;
  job.options.sample_share = shares.sample_share;
  job.options.integrator.bounces = options.bounces;
  job.options.integrator.ray_group = options.ray_group;
  job.options.integrator.max_depth = options.max_depth;
  job.options.integrator.clamp = options.clamp;
  job.options.noise = options.noise;
  job.options.light_channels = options.denoise || are_light_channels_wanted(job.channels);
  job.options.integrator.kind = settled(kind_named(integrators, options.integrator), job.scene);
  check_shares(job.options);
}

}  // namespace minkray
