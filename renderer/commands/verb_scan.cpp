// SPDX-License-Identifier: MIT
// minkray scan: casts the rays of a sensor at a scene.
#include <iostream>
#include <memory>
#include <optional>

#include "core/parallel/parallel.h"
#include "core/support/named_kind.h"
#include "renderer/arguments/image_arguments.h"
#include "renderer/arguments/import_arguments.h"
#include "renderer/arguments/number_list.h"
#include "renderer/base/errors.h"
#include "renderer/base/interrupt.h"
#include "renderer/cli/file_ending.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/import/import.h"
#include "renderer/io/output_file.h"
#include "renderer/jobs/progress_line.h"
#include "renderer/json/object_reader.h"
#include "renderer/sensor/lidar_models.h"
#include "renderer/sensor/mcap.h"
#include "renderer/sensor/scan.h"
#include "renderer/sensor/scan_files.h"
#include "renderer/sensor/sensor_path.h"

namespace minkray {
namespace {

struct ScanVerbOptions {
  CommandFiles* files = nullptr;
  std::string scene;
  ImportOptions import;
  std::optional<std::string> rays, pattern, pinhole;
  std::string pose, mount, path, seed = "0", noise, range, order = "first", table;
  double sweep = 0.1;
  ScanOptions scan;
  std::vector<std::string> outputs;
  int threads = 0;
  bool has_halfs = false, quiet = false;
};

constexpr NamedKind<EchoOrder> echo_orders[] = {
    {EchoOrder::first, "first", "nearest first"},
    {EchoOrder::strongest, "strongest", "greatest intensity first"},
    {EchoOrder::last, "last", "furthest first"}};

/// Returns the frame of a robot's link, or of an object.
MovingFrame mount_of(Imported& imported, const std::string& name) {
  if (name.empty()) return {};
  if (imported.model)
    if (auto frame = frame_of_link(*imported.model, imported.rows, name)) return *frame;
  if (auto frame = frame_of_object(imported.scene, name)) return *frame;
  std::vector<std::string> names;
  for (const Object& object : imported.scene.objects) names.push_back(printable(object.name, 60));
  if (imported.model)
    for (const ModelLink& link : imported.model->links) names.push_back(printable(link.name, 60));
  constexpr std::size_t enough = 40;
  if (names.size() > enough) names.resize(enough);
  throw WrongUsage("--on: no link or object is named \"" + printable(name, 60) + "\" (" +
                   suggestion(name, names) + ")");
}

void read_options(ScanVerbOptions& options) {
  if (options.rays.has_value() + options.pattern.has_value() + options.pinhole.has_value() != 1)
    throw WrongUsage("scan: give one of --rays, --pattern and --pinhole");
  options.scan.seed = parse_seed(options.seed);
  if (!options.pose.empty()) {
    const auto v = number_list(options.pose, "--pose", {3, 7}, "x,y,z or x,y,z,qx,qy,qz,qw");
    options.scan.pose.translation = {v[0], v[1], v[2]};
    if (v.size() == 7) {
      if (v[3] == 0 && v[4] == 0 && v[5] == 0 && v[6] == 0)
        throw WrongUsage("--pose: the quaternion must not be zero");
      options.scan.pose.linear = rotation_matrix_of_any(v[3], v[4], v[5], v[6]);
    }
  }
  if (!options.noise.empty()) {
    const auto v = number_list(options.noise, "--noise", {1, 2, 3},
                               "standard deviations of range, of angle (rad) and of range per "
                               "unit distance");
    for (const double number : v)
      if (number < 0) throw WrongUsage("--noise: must be >= 0 (got " + options.noise + ")");
    options.scan.range_noise = v[0];
    if (v.size() > 1) options.scan.angle_noise = v[1];
    if (v.size() > 2) options.scan.range_noise_per_length = v[2];
  }
  if (!options.range.empty()) {
    const auto v = number_list(options.range, "--range", {2}, "least and greatest range");
    if (v[0] < 0 || v[1] <= v[0])
      throw WrongUsage("--range: must be 0 <= MIN < MAX (got " + options.range + ")");
    options.scan.nearest = v[0];
    options.scan.farthest = v[1];
  }
  options.scan.order = kind_named(echo_orders, options.order);
  if (!options.table.empty()) {
    check_ending(options.table, ".json", "--ids");
    check_writable(options.table);
  }
  for (const std::string& output : options.outputs) {
    if (scan_format_of(output).ending == ".mcap" && options.scan.start < 0)
      throw WrongUsage("--start: must be >= 0 for " + output);
    check_writable(output);
  }
}

/// Warns of rays that start inside a body. Often the sensor's pose is missing, and the body
/// contains the origin.
void warn_of_inside(const Scan& scan, int returns) {
  std::size_t rays = 0, inside = 0;
  for (std::size_t first = 0; first < scan.echoes.size(); first += std::size_t(returns), ++rays)
    inside += scan.echoes[first].status == 2;
  if (inside > 0)
    std::cerr << "warning: " << inside << " of " << rays
              << " rays start inside a body, at t = 0 (use --pose or --on to place the sensor)\n";
}

void run(ScanVerbOptions& options) {
  read_options(options);
  const SensorRays rays = options.rays ? rays_of_npy(*options.rays)
                          : options.pattern
                              ? rays_of_pattern(*options.pattern, options.sweep, options.scan.start)
                              : rays_of_pinhole(*options.pinhole);
  const double echoes = double(rays.rays.size()) * options.scan.returns;
  for (const std::string& output : options.outputs) {
    const ScanFormat& format = scan_format_of(output);
    if (format.is_image && rays.width == 0)
      throw WrongUsage("--output: an image needs rays in rows and columns (got " + output + ")");
    if (format.ending == ".mcap" && echoes > double(most_mcap_points))
      throw WrongUsage("--output: " + output + " holds at most " +
                       std::to_string(most_mcap_points) + " echoes");
  }
  options.import.purpose = ScenePurpose::rays;
  Imported imported = import_scene(options.scene, options.import);
  const Scene& scene = imported.scene;
  options.files->read(imported.files);
  if (imported.model && !options.quiet) warn_of_limits(*imported.model, options.import);
  options.scan.mount = mount_of(imported, options.mount);
  if (!options.path.empty()) options.scan.path = read_sensor_path(options.path);
  const InterruptGuard guard;
  Scan result;
  {
    ProgressLine line(!options.quiet);
    result = scan(scene, rays, options.scan, [&](double fraction, std::uint64_t count) {
      line.show(fraction, count);
      return !InterruptGuard::interrupted();
    });
  }
  InterruptGuard::end_if_interrupted();
  for (const std::string& output : options.outputs) {
    const auto bytes = scan_format_of(output).encode(
        {result, rays, options.scan.returns, scene, options.scan.start, options.has_halfs});
    write_file(output, bytes);
    InterruptGuard::end_if_interrupted();
  }
  if (!options.table.empty()) {
    const std::string text = id_table(scene);
    write_file(options.table, text);
  }
  warn_of_exhausted(result.counts.exhausted, result.counts.casts);
  warn_of_inside(result, options.scan.returns);
  if (rays.missing > 0)
    std::cerr << "warning: " << rays.missing << " of " << rays.rays.size()
              << " pixels have no ray, since the distortion has no inverse there (status 5)\n";
}

void add_ray_options(const Verb& verb, ScanVerbOptions& options) {
  const std::string heading = "Rays and their origin";
  verb.add_option(
          "--rays", options.rays,
          ".npy file of rays, one per row: origin (3 numbers), direction (3) and, optionally, "
          "t_max: the ray's end, in lengths of its direction")
      .group(heading)
      .reads_file();
  verb.add_option("--pattern", options.pattern,
                  "Scan pattern:\n"
                  "spinning:CHANNELSxSTEPS[:LOWEST,HIGHEST[:FROM,TO]]\n"
                  "(lowest and highest elevation, first and last azimuth, in degrees)\n"
                  "or a lidar model: " +
                      listed(names_in(lidar_models())) +
                      "\nor a file: .csv (time, azimuth, zenith), .json (elevations), "
                      ".mat3x4f (one 3 x 4 pose matrix per ray, RobotecGPULidar)")
      .group(heading)
      .reads_file()
      .takes("PATTERN");
  verb.add_option("--pinhole", options.pinhole,
                  "JSON file of a calibrated camera: fx, fy, cx, cy, width, height, distortion")
      .group(heading)
      .reads_file();
  verb.add_option(
          "--pose", options.pose,
          "Position and rotation (quaternion) of the sensor, relative to its path (--path) or its "
          "carrier (--on) if given; default: at the origin, not rotated")
      .group(heading)
      .takes("X,Y,Z[,QX,QY,QZ,QW]");
  verb.add_option("--on", options.mount, "Robot link or object that carries the sensor")
      .group(heading)
      .takes("NAME");
  verb.add_option(
          "--path", options.path,
          "CSV file of the sensor's path: time (s), x, y, z and, optionally, qx, qy, qz, qw")
      .group(heading)
      .reads_file();
  verb.add_option("--start", options.scan.start, "Time in seconds at which the sweep starts")
      .group(heading)
      .between(-1e9, 1e9)
      .show_default();
  verb.add_option("--sweep", options.sweep, "Seconds per revolution of a lidar")
      .group(heading)
      .between(0.0, 1e9)
      .show_default();
}

void add_measurement_options(const Verb& verb, ScanVerbOptions& options) {
  const std::string heading = "Measurement";
  verb.add_option("--range", options.range,
                  "Minimum and maximum range (scene units; default: unlimited)")
      .group(heading)
      .takes("MIN,MAX");
  verb.add_option("--noise", options.noise,
                  "Standard deviations: RANGE + PER_LENGTH x distance for the range (scene units), "
                  "ANGLE for the angle (rad); default: 0")
      .group(heading)
      .takes("RANGE[,ANGLE[,PER_LENGTH]]");
  verb.add_option("--dropout", options.scan.dropout, "Probability that a ray returns nothing")
      .group(heading)
      .between(0.0, 1.0)
      .show_default();
  verb.add_option("--seed", options.seed, "Random seed of noise and dropout, 0 to 2^64 - 1")
      .group(heading)
      .takes("N")
      .show_default();
  verb.add_option(
          "--returns", options.scan.returns,
          "Maximum number of echoes per ray; without --divergence, each body that the ray enters "
          "gives an echo")
      .group(heading)
      .between(1, 64)
      .show_default();
  verb.add_option("--echo", options.order,
                  "Order of echoes; those beyond the maximum (--returns) are dropped:" +
                      lines_of_help(echo_orders))
      .group(heading)
      .one_of(names_in(echo_orders))
      .show_default();
  verb.add_option("--divergence", options.scan.divergence,
                  "Full angle of the beam (rad); 0: a single ray\n"
                  "Above 0, the beam is sampled by several rays (--beam-rays); each ray's first "
                  "hit gives an echo")
      .group(heading)
      .between(0.0, 1.0);
  verb.add_option("--beam-rays", options.scan.beam_rays,
                  "Rays that sample a beam, used with --divergence")
      .group(heading)
      .between(1, 4096)
      .show_default();
  verb.add_option("--resolution", options.scan.resolution,
                  "Minimum distance in scene units between two echoes of a beam\n"
                  "Used with --divergence: echoes closer together than this are joined")
      .group(heading)
      .between(0.0, 1e9)
      .show_default();
}

}  // namespace

void add_scan(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("scan");
  const auto options = std::make_shared<ScanVerbOptions>();
  options->files = &verb.files();
  add_scene_option(verb, options->scene);
  add_other_files(verb, options->import);
  add_ray_options(verb, *options);
  add_measurement_options(verb, *options);
  verb.add_option("-o,--output", options->outputs,
                  "File to write (" + listed(scan_formats(), &ScanFormat::ending) + "); repeatable")
      .required()
      .one_value_each()
      .writes_file();
  verb.add_option("--ids", options->table, "JSON file to write: number and name of each object")
      .writes_file();
  verb.add_flag("--half", options->has_halfs, "Write .exr with 16-bit floats");
  verb.add_option("-t,--threads", options->threads, "Threads; 0: one per core")
      .between(0, 1024)
      .show_default();
  verb.add_flag("-q,--quiet", options->quiet, "Print no progress");
  add_import_options(verb, options->import);
  verb.on_call([options] { with_threads(options->threads, [&] { run(*options); }); });
}

}  // namespace minkray
