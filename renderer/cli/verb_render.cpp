// SPDX-License-Identifier: MIT
// minkray render: a picture of a scene.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>

#include "core/parallel/parallel.h"
#include "renderer/audit/ray_audit.h"
#include "renderer/base/errors.h"
#include "renderer/base/hash.h"
#include "renderer/base/interrupt.h"
#include "renderer/cli/command_line.h"
#include "renderer/cli/frames.h"
#include "renderer/cli/image_arguments.h"
#include "renderer/cli/progress_line.h"
#include "renderer/cli/render_job.h"
#include "renderer/cli/shared_render.h"
#include "renderer/cli/verbs.h"
#include "renderer/cli/write_picture.h"
#include "renderer/film/data_channels.h"
#include "renderer/film/labels.h"
#include "renderer/import/import.h"
#include "renderer/io/image_file.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/share/frames_record.h"
#include "renderer/share/merge.h"

namespace minkray {
namespace {

struct Options {
  ImageArguments image;
  double exposure = 0;
  int bounces = IntegratorOptions().bounces;
  int packet = IntegratorOptions().packet;
  BvhBuild build = BvhBuild::quality;
  bool certify = false;
  std::string stats;  ///< empty: none, "true": text, "json"
  std::optional<std::string> aov;
  std::optional<std::string> tile, sample_share;
  std::optional<int> tiles;
  double checkpoint_seconds = 60;
  bool resume = false;
  std::optional<std::string> frames;
  double rate = 24;
  std::string contact_sheet;  ///< empty: none

  bool is_piece() const { return tile || sample_share; }
};

struct Statistics {
  std::size_t objects = 0;
  int threads = 0;
  double load_seconds = 0, build_seconds = 0, trace_seconds = 0, write_seconds = 0;
  std::size_t world_bytes = 0, bvh_bytes = 0;
  RayCounts counts;

  double per_object(std::size_t bytes) const {
    return static_cast<double>(bytes) / static_cast<double>(std::max<std::size_t>(objects, 1));
  }
  double per_ray(std::uint64_t count) const {
    const auto rays = static_cast<double>(std::max<std::uint64_t>(counts.total(), 1));
    return static_cast<double>(count) / rays;
  }
};

Json as_json(const Statistics& s) {
  const RayCounts& c = s.counts;
  return {{"objects", s.objects},
          {"threads", s.threads},
          {"seconds",
           {{"load", s.load_seconds},
            {"build", s.build_seconds},
            {"trace", s.trace_seconds},
            {"write", s.write_seconds}}},
          {"rays",
           {{"camera", c.camera},
            {"shadow", c.shadow},
            {"ambient", c.ambient},
            {"scattered", c.scattered},
            {"mirrored", c.mirrored},
            {"total", c.total()}}},
          {"rays_per_second", static_cast<double>(c.total()) / s.trace_seconds},
          {"per_ray",
           {{"nodes", s.per_ray(c.work.nodes)},
            {"casts", s.per_ray(c.work.casts)},
            {"iterations", s.per_ray(c.work.iterations)},
            {"supports", s.per_ray(c.work.supports)}}},
          {"answered_by",
           {{"filter", c.work.answered_by(Path::filter)},
            {"model", c.work.answered_by(Path::model)},
            {"gjk", c.work.answered_by(Path::gjk)},
            {"finer", c.work.answered_by(Path::finer)}}},
          {"exhausted", c.work.exhausted},
          {"camera_rays_from_inside", c.from_inside},
          {"bytes",
           {{"world", s.world_bytes},
            {"hierarchy", s.bvh_bytes},
            {"per_object", s.per_object(s.world_bytes)}}}};
}

void print(const Statistics& s) {
  const RayCounts& c = s.counts;
  const auto seconds = [](double value) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(3) << value << " s";
    return text.str();
  };
  std::cout << "objects     " << s.objects << "\n"
            << "threads     " << s.threads << "\n"
            << "time        load " << seconds(s.load_seconds) << ", build "
            << seconds(s.build_seconds) << ", trace " << seconds(s.trace_seconds) << ", write "
            << seconds(s.write_seconds) << "\n"
            << "rays        " << c.total() << ": camera " << c.camera << ", shadow " << c.shadow
            << ", ambient " << c.ambient << ", scattered " << c.scattered << ", mirrored "
            << c.mirrored << "\n"
            << "speed       " << std::setprecision(4)
            << static_cast<double>(c.total()) / s.trace_seconds / 1e6 << " Mray/s\n"
            << "per ray     " << s.per_ray(c.work.nodes) << " nodes, " << s.per_ray(c.work.casts)
            << " casts, " << s.per_ray(c.work.iterations) << " iterations, "
            << s.per_ray(c.work.supports) << " support points\n"
            << "answered by filter " << c.work.answered_by(Path::filter) << ", model "
            << c.work.answered_by(Path::model) << ", gjk " << c.work.answered_by(Path::gjk)
            << ", finer " << c.work.answered_by(Path::finer) << "\n"
            << "exhausted   " << c.work.exhausted << " casts\n"
            << "memory      " << s.world_bytes << " bytes, of which the hierarchy " << s.bvh_bytes
            << "; " << s.per_object(s.world_bytes) << " an object, of which the hierarchy "
            << s.per_object(s.bvh_bytes) << "\n";
}

/// What was proven, and what not with a query that shows it.
void report(const RayAudit& audit) {
  std::uint64_t failed = 0;
  std::cerr << "certified   " << audit.certificates() << " certificates for";
  for (std::size_t i = 0; i < ray_kind_names.size(); ++i) {
    const auto kind = static_cast<RayKind>(i);
    failed += audit.failed(kind);
    std::cerr << (i == 0 ? " " : ", ") << audit.rays(kind) << " " << ray_kind_names[i] << " rays";
  }
  std::cerr << "; without proof " << failed << "\n";
  for (const AuditFailure& failure : audit.failures())
    std::cerr << failure.message << "\n" << failure.query << (failure.query.empty() ? "" : "\n");
  if (failed > 0)
    std::cerr << "the lines in braces are queries for minkray cast --certify; their answers there "
                 "show what is wrong\n";
}

/// Throws WrongUsage for what does not go together, and fills in what the options ask for.
void read_options(const Options& options, const Ranks& ranks, RenderJob& job) {
  check_exposure(options.exposure);
  if (!options.stats.empty() && options.stats != "true" && options.stats != "json")
    throw WrongUsage("--stats: takes nothing or =json (got " + options.stats + ")");
  if (std::isnan(options.checkpoint_seconds))
    throw WrongUsage("--checkpoint: must be a number of seconds (got nan)");
  if (std::isnan(options.rate)) throw WrongUsage("--rate: must be a number of frames (got nan)");
  if (options.aov) job.channels = parse_data_channels(*options.aov);
  const std::vector<std::string>& outputs = options.image.outputs;
  if (options.aov && std::none_of(outputs.begin(), outputs.end(), keeps_planes))
    throw WrongUsage("--aov: needs an output that ends in .exr (got " + outputs.front() + ")");
  for (const std::string& output : outputs)
    if (options.is_piece() && !keeps_planes(output))
      throw WrongUsage("--output: a piece of a picture must end in .exr (got " + output + ")");
  if (options.tile) job.options.tile = parse_share(*options.tile, "--tile");
  if (options.sample_share)
    job.options.sample_share = parse_share(*options.sample_share, "--sample-share");
  if (options.sample_share && options.aov)
    throw WrongUsage("--aov: goes with --tile, but not with --sample-share");
  if (ranks.count() > 1 && options.is_piece())
    throw WrongUsage(
        "--tile, --sample-share: the ranks of an MPI job share the picture themselves");
  if (options.certify && (ranks.count() > 1 || options.resume))
    throw WrongUsage("--certify: proves the rays of one whole run: not with --resume or MPI");
  if (ranks.count() == 1 && options.tiles)
    throw WrongUsage("--tiles: is for several ranks of an MPI job (mpirun minkray render)");
  if (ranks.rank() == 0) check_outputs(outputs);
  job.command = command_line();
  job.checkpoint_seconds = options.checkpoint_seconds;
  job.resume = options.resume;
  job.wants_planes = ranks.count() > 1 || std::any_of(outputs.begin(), outputs.end(), keeps_planes);
  job.quiet = options.image.quiet;
}

void check_shares(const RenderOptions& options) {
  const Share tile = options.tile, share = options.sample_share;
  const PixelRect picture = options.picture();
  if (!can_be_tiled(picture, tile.count))
    throw WrongUsage("--tile: the picture has too few pixels for " + std::to_string(tile.count) +
                     " tiles");
  const int blocks = SampleBlocks{options.samples}.count();
  if (share.count > blocks)
    throw WrongUsage("--sample-share: " + std::to_string(options.samples) +
                     " samples a pixel can be shared by at most " + std::to_string(blocks) +
                     " (got " + share.text() + ")");
}

/// All ranks render, rank 0 writes.
void run_on(Ranks& ranks, const RenderJob& job, const Options& options, Statistics& statistics) {
  const std::string& output = options.image.outputs.front();
  const int tiles = options.tiles.value_or(default_tile_count(job.options.picture()));
  if (!can_be_tiled(job.options.picture(), tiles))
    throw WrongUsage("--tiles: the picture has too few pixels for " + std::to_string(tiles));
  const InterruptGuard guard;
  const Stopwatch watch;
  std::optional<Merged> merged = render_on(ranks, job, tiles, output);
  statistics.trace_seconds = watch.seconds();
  if (!merged) return;
  statistics.counts = merged->counts;
  merged->exr.texts[fact::command] = job.command;
  const Stopwatch write_watch;
  write_picture(options.image.outputs,
                {merged->image(), labels_of(merged->exr.texts), merged->exr.window,
                 job.options.resolution, merged->exr},
                options.exposure);
  statistics.write_seconds = write_watch.seconds();
  remove_parts(output, tiles);
}

void report(const Statistics& statistics, const Options& options) {
  warn_of_counts(statistics.counts);
  if (options.stats == "json") std::cout << as_json(statistics).dump(2) << "\n";
  if (options.stats == "true") print(statistics);
}

template <class Work>
void timed(const Options& options, const char* what, double& seconds, const Work& work) {
  const Stopwatch watch;
  work();
  seconds += watch.seconds();
  if (options.image.verbose) std::cerr << what << ": " << watch.seconds() << " s\n";
}

/// One picture into its files; answers the light that was written.
Image render_and_write(const RenderJob& job, const Options& options,
                       const std::vector<std::string>& outputs, Statistics& statistics) {
  const InterruptGuard guard;
  Checkpoint checkpoint = checkpoint_of(job, outputs.front());
  RenderedJob done;
  timed(options, "trace", statistics.trace_seconds, [&] { done = run(job, checkpoint); });
  statistics.counts += done.rendering.counts;
  const FinishedPicture picture{std::move(done.rendering.image), std::move(done.labels),
                                job.options.part(), job.options.resolution, std::move(done.exr)};
  timed(options, "write", statistics.write_seconds,
        [&] { write_picture(outputs, picture, options.exposure); });
  checkpoint.remove();
  show_preview(to_look_at(picture, options.exposure), options.image.preview);
  return picture.image;
}

void check_frames(const Options& options, const FrameRange& frames, const Ranks& ranks) {
  if (!options.frames) {
    if (!options.contact_sheet.empty())
      throw WrongUsage("--contact-sheet: goes with --frames only");
    return;
  }
  for (const std::string& output : options.image.outputs) check_frame_name(output);
  if (options.is_piece() || ranks.count() > 1)
    throw WrongUsage("--frames: not with --tile, --sample-share or MPI; share the frames instead");
  if (options.certify) throw WrongUsage("--frames: not with --certify, which proves one picture");
  if (options.contact_sheet.empty()) return;
  if (options.resume)
    throw WrongUsage("--contact-sheet: shows the frames of a whole run: not with --resume");
  check_outputs({options.contact_sheet});
  for (const std::string& name : options.image.outputs)
    if (const auto frame = frame_of_file(name, options.contact_sheet, frames))
      throw WrongUsage("--contact-sheet: is the file of frame " + std::to_string(*frame) +
                       " (got " + options.contact_sheet + ")");
}

/// One record for each output.
std::vector<FramesRecord> records_of(const RenderJob& job, const Options& options) {
  Facts facts = facts_of(job);
  facts[fact::rate] = Json(options.rate).dump();
  facts[fact::exposure] = Json(options.exposure).dump();
  std::vector<FramesRecord> records;
  for (const std::string& name : options.image.outputs)
    records.emplace_back(FramesRecord::path_for(name), facts, options.resume);
  for (const FramesRecord& record : records) record.write();  // none before all are known to fit
  return records;
}

/// The world moves from frame to frame.
void render_frames(RenderJob& job, const Options& options, const FrameRange& frames,
                   Statistics& statistics) {
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
    timed(options, "move", statistics.build_seconds, [&] {
      set_time(job.scene, frame / options.rate);
      follow(job.world, job.scene);
    });
    Hash hash;
    hash.add(scene_hash);
    hash.add(std::to_string(job.scene.time));
    job.scene.hash = hash.text();
    const Image image = render_and_write(job, options, outputs, statistics);
    for (FramesRecord& record : records) record.add(frame);
    if (!options.contact_sheet.empty()) sheet.add(image);
  }
  if (options.contact_sheet.empty()) return;
  const Image image = sheet.image();
  const FinishedPicture picture{
      image, {}, {0, 0, image.width, image.height}, {image.width, image.height}, {}};
  write_picture({options.contact_sheet}, picture, options.exposure);
}

constexpr const char* suffix = ".png";

ExitCode run(Options& options) {
  Ranks ranks;
  if (options.image.outputs.empty() && (options.is_piece() || options.frames || ranks.count() > 1))
    throw WrongUsage("--output: is needed with --tile, --sample-share, --frames and MPI");
  options.image.choose_output(suffix);
  RenderJob job;
  const CastOptions<Real> cast = cast_options(options.image.solver);
  read_options(options, ranks, job);
  const FrameRange frames = options.frames ? parse_frames(*options.frames) : FrameRange{};
  check_frames(options, frames, ranks);

  Statistics statistics;
  timed(options, "load", statistics.load_seconds,
        [&] { job.scene = import_scene(options.image.scene, options.image.import).scene; });
  const RenderOptions shares = job.options;
  job.options = options.image.render_options(job.scene);
  job.options.tile = shares.tile;
  job.options.sample_share = shares.sample_share;
  job.options.integrator.bounces = options.bounces;
  job.options.integrator.packet = options.packet;
  check_shares(job.options);

  timed(options, "build", statistics.build_seconds,
        [&] { job.world = make_world(job.scene, cast, options.build); });
  statistics.objects = instance_count(job.scene);
  std::optional<RayAudit> audit;
  if (options.certify && job.world.instances().move())
    throw WrongUsage(
        "--certify: proves what stands still; here objects move while the shutter is "
        "open");
  if (options.certify) job.options.integrator.audit = &audit.emplace(job.scene, job.world);
  statistics.threads = thread_count();
  statistics.world_bytes = job.world.bytes();
  statistics.bvh_bytes = job.world.bvh().bytes();

  if (ranks.count() > 1) {
    run_on(ranks, job, options, statistics);
    if (ranks.rank() == 0) report(statistics, options);
    return ExitCode::done;
  }

  if (options.frames) {
    render_frames(job, options, frames, statistics);
    report(statistics, options);
    return ExitCode::done;
  }

  // Of pieces many are rendered, over and over where machines fail.
  const std::string& output = options.image.outputs.front();
  const auto is_there = [&](const std::string& file) { return is_part_of(file, facts_of(job)); };
  if (options.resume && options.is_piece() &&
      std::all_of(options.image.outputs.begin(), options.image.outputs.end(), is_there)) {
    if (!options.image.quiet) std::cerr << printable(output) << ": is there already\n";
    return ExitCode::done;
  }

  render_and_write(job, options, options.image.outputs, statistics);
  report(statistics, options);
  if (!audit) return ExitCode::done;
  report(*audit);
  return audit->failures().empty() ? ExitCode::done : ExitCode::comparison_failed;
}

}  // namespace

void add_render(CLI::App& app, ExitCode& exit_code) {
  CLI::App* verb = app.add_subcommand("render", "Make a picture of a scene");
  const auto options = std::make_shared<Options>();
  options->image.samples = 16;
  options->image.add_to(*verb, suffix);
  verb->add_option("--solver", options->image.solver, "Of the ray casts")->capture_default_str();
  verb->add_option("--exposure", options->exposure, "Stops brighter; .pfm keeps the scene's light")
      ->capture_default_str();
  verb->add_option("--bounces", options->bounces,
                   "How often light is scattered between objects; 0 for ambient occlusion")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  verb->add_option("--packet", options->packet,
                   "Camera rays that are traced together; the picture is the same for any number")
      ->check(CLI::Range(1, most_in_packet))
      ->capture_default_str();
  verb->add_option_function<std::string>(
          "--build",
          [options](const std::string& name) {
            options->build = name == "speed" ? BvhBuild::speed : BvhBuild::quality;
          },
          "Of the hierarchy: quality, for fast rays, or speed, for a fast build")
      ->check(CLI::IsMember({"quality", "speed"}));
  std::string channels;
  for (const DataChannelDescription& channel : data_channels)
    channels += "\n" + std::string(channel.name) + ": " + std::string(channel.doc);
  verb->add_option("--aov", options->aov,
                   "Data channels of .exr, between commas, or all; of the ray through the pixel's "
                   "centre, not filtered:" +
                       channels);
  verb->add_option("--tile", options->tile,
                   "i/n: just the i-th of n pieces of the picture, for minkray merge");
  verb->add_option("--sample-share", options->sample_share,
                   "i/n: just the i-th of n shares of each pixel's samples, for minkray merge");
  verb->add_option("--tiles", options->tiles,
                   "Under mpirun: into how many tiles the picture is split; by default each has "
                   "about 64 x 64 pixels")
      ->check(CLI::Range(1, 999999));
  verb->add_option("--checkpoint", options->checkpoint_seconds,
                   "Seconds between checkpoints beside the first output; 0 for none")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  verb->add_flag("--resume", options->resume, "Go on from the checkpoint, if there is one");
  verb->add_option("--frames", options->frames,
                   "a..b: pictures of these frames, into files with the frame's number in the "
                   "place of #### in the output's name; frame 0 is at 0 s. A record beside them, "
                   "####.png.frames, tells which are there: with --resume they are left out");
  verb->add_option("--rate", options->rate, "Frames a second")
      ->check(CLI::Range(1e-6, 1e6))
      ->capture_default_str();
  verb->add_option("--contact-sheet", options->contact_sheet,
                   "With --frames: all frames, small, in one more picture");
  verb->add_flag("--stats", options->stats, "Print rays, speed, work and memory; --stats=json");
  verb->add_flag("--certify", options->certify,
                 "Prove the answer to every ray (docs/certificates.md); exit 1 if a proof fails");
  verb->callback([options, &exit_code] {
    with_threads(options->image.threads, [&] { exit_code = run(*options); });
  });
}

}  // namespace minkray
