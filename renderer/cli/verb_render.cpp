// SPDX-License-Identifier: MIT
// minkray render: a picture of a scene.
#include <CLI/CLI.hpp>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>

#include "core/parallel/parallel.h"
#include "renderer/cli/image_arguments.h"
#include "renderer/cli/progress_line.h"
#include "renderer/cli/verbs.h"
#include "renderer/errors.h"
#include "renderer/interrupt.h"
#include "renderer/json/json.h"
#include "renderer/labels.h"
#include "renderer/ray_audit.h"
#include "renderer/scene/scene_json.h"

namespace minkray {
namespace {

struct Options {
  ImageArguments image;
  double exposure = 0;
  int bounces = IntegratorOptions().bounces;
  bool certify = false;
  std::string stats;  ///< empty: none, "true": text, "json"
};

struct Statistics {
  std::size_t objects = 0;
  int threads = 0;
  double load_seconds = 0, build_seconds = 0, trace_seconds = 0, write_seconds = 0;
  std::size_t world_bytes = 0, bvh_bytes = 0;
  RayCounts counts;

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
          {"exhausted", c.work.exhausted},
          {"camera_rays_from_inside", c.from_inside},
          {"bytes", {{"world", s.world_bytes}, {"hierarchy", s.bvh_bytes}}}};
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
            << "exhausted   " << c.work.exhausted << " casts\n"
            << "memory      " << s.world_bytes << " bytes, of which the hierarchy " << s.bvh_bytes
            << "\n";
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

ExitCode run(const Options& options) {
  if (!std::isfinite(options.exposure) || std::abs(options.exposure) > 100)
    throw WrongUsage("--exposure: must be a number of stops from -100 to 100");
  if (!options.stats.empty() && options.stats != "true" && options.stats != "json")
    throw WrongUsage("--stats: takes nothing or =json (got " + options.stats + ")");
  const CastOptions<Real> cast = cast_options(options.image.solver);
  options.image.check_outputs();

  Statistics statistics;
  const auto timed = [&](const char* what, double& seconds, const auto& work) {
    const Stopwatch watch;
    work();
    seconds = watch.seconds();
    if (options.image.verbose) std::cerr << what << ": " << seconds << " s\n";
  };
  Scene scene;
  timed("load", statistics.load_seconds, [&] { scene = load_scene(options.image.scene); });
  RenderOptions render_options = options.image.render_options(scene);
  render_options.integrator.bounces = options.bounces;

  RenderWorld world;
  timed("build", statistics.build_seconds, [&] { world = make_world(scene, cast); });
  std::optional<RayAudit> audit;
  if (options.certify) render_options.integrator.audit = &audit.emplace(scene, world);
  statistics.objects = scene.objects.size();
  statistics.threads = thread_count();
  statistics.world_bytes = world.bytes();
  statistics.bvh_bytes = world.bvh().bytes();

  {
    const InterruptGuard guard;
    Rendering rendering;
    timed("trace", statistics.trace_seconds, [&] {
      ProgressLine line(!options.image.quiet);
      rendering = render(scene, world, render_options,
                         {[&](double fraction, std::uint64_t rays) { line.show(fraction, rays); },
                          InterruptGuard::interrupted});
    });
    InterruptGuard::end_if_interrupted();
    statistics.counts = rendering.counts;
    timed("write", statistics.write_seconds, [&] {
      const auto gain = static_cast<float>(std::exp2(options.exposure));
      Image picture = rendering.image;
      for (Vec3<float>& pixel : picture.pixels) pixel *= gain;
      if (scene.labels) draw_labels(picture, scene, world, render_options);
      write_images(options.image.outputs, picture, rendering.image);
    });
  }

  warn_of_exhausted(statistics.counts.work.exhausted, statistics.counts.work.casts);
  if (statistics.counts.from_inside > 0)
    std::cerr << "warning: the camera is inside a shape, where it sees black\n";
  if (options.stats == "json") std::cout << as_json(statistics).dump(2) << "\n";
  if (options.stats == "true") print(statistics);
  if (!audit) return ExitCode::done;
  report(*audit);
  return audit->failures().empty() ? ExitCode::done : ExitCode::comparison_failed;
}

}  // namespace

void add_render(CLI::App& app, ExitCode& exit_code) {
  CLI::App* verb = app.add_subcommand("render", "Make a picture of a scene");
  const auto options = std::make_shared<Options>();
  options->image.samples = 16;
  options->image.add_to(*verb);
  verb->add_option("--solver", options->image.solver, "Of the ray casts")->capture_default_str();
  verb->add_option("--exposure", options->exposure, "Stops brighter; .pfm keeps the scene's light")
      ->capture_default_str();
  verb->add_option("--bounces", options->bounces,
                   "How often light is scattered between objects; 0 for ambient occlusion")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  verb->add_flag("--stats", options->stats, "Print rays, speed, work and memory; --stats=json");
  verb->add_flag("--certify", options->certify,
                 "Prove the answer to every ray (docs/certificates.md); exit 1 if a proof fails");
  verb->callback([options, &exit_code] {
    with_threads(options->image.threads, [&] { exit_code = run(*options); });
  });
}

}  // namespace minkray
