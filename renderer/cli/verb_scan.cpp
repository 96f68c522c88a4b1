// SPDX-License-Identifier: MIT
// minkray scan: the rays of a sensor at a scene.
#include <iostream>
#include <memory>
#include <optional>

#include "core/parallel/parallel.h"
#include "renderer/base/errors.h"
#include "renderer/base/interrupt.h"
#include "renderer/cli/file_ending.h"
#include "renderer/cli/image_arguments.h"
#include "renderer/cli/import_arguments.h"
#include "renderer/cli/number_list.h"
#include "renderer/cli/options.h"
#include "renderer/cli/progress_line.h"
#include "renderer/cli/verbs.h"
#include "renderer/import/import.h"
#include "renderer/io/output_file.h"
#include "renderer/json/object_reader.h"
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
  std::string pose, mount, path, seed = "0", noise, table;
  double sweep = 0.1;
  ScanOptions scan;
  std::vector<std::string> outputs;
  int threads = 0;
  bool quiet = false;
};

/// A link of a robot, or an object.
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
  throw WrongUsage("--on: there is no link and no object \"" + printable(name, 60) + "\" (" +
                   suggestion(name, names) + ")");
}

void read_options(ScanVerbOptions& options) {
  if (options.rays.has_value() + options.pattern.has_value() + options.pinhole.has_value() != 1)
    throw WrongUsage("scan: give one of --rays, --pattern and --pinhole");
  options.scan.seed = parse_seed(options.seed);
  if (!options.pose.empty()) {
    const auto v = number_list(options.pose, "--pose", {3, 7},
                               "x,y,z, and the quaternion qx,qy,qz,qw if wanted");
    options.scan.pose.translation = {v[0], v[1], v[2]};
    if (v.size() == 7) {
      if (v[3] == 0 && v[4] == 0 && v[5] == 0 && v[6] == 0)
        throw WrongUsage("--pose: the quaternion must not be zero");
      options.scan.pose.linear = rotation_matrix_of_any(v[3], v[4], v[5], v[6]);
    }
  }
  if (!options.noise.empty()) {
    const auto v = number_list(options.noise, "--noise", {1, 2},
                               "the deviation of ranges, and of angles in radians if wanted");
    if (v[0] < 0 || (v.size() > 1 && v[1] < 0)) throw WrongUsage("--noise: must be >= 0");
    options.scan.range_noise = v[0];
    if (v.size() > 1) options.scan.angle_noise = v[1];
  }
  if (!options.table.empty()) {
    check_ending(options.table, ".json", "--ids");
    check_writable(options.table);
  }
  for (const std::string& output : options.outputs) {
    scan_format_of(output);
    check_writable(output);
  }
}

/// A sensor that nobody placed may stand in a body, where it sees nothing else.
void warn_of_inside(const Scan& scan, int returns) {
  std::size_t rays = 0, inside = 0;
  for (std::size_t first = 0; first < scan.echoes.size(); first += std::size_t(returns), ++rays)
    inside += scan.echoes[first].status == 2;
  if (inside > 0)
    std::cerr << "warning: " << inside << " of " << rays
              << " rays begin within a body, at t = 0 (--pose and --on say where the sensor is)\n";
}

void run(ScanVerbOptions& options) {
  read_options(options);
  const SensorRays rays = options.rays      ? rays_of_npy(*options.rays)
                          : options.pattern ? rays_of_pattern(*options.pattern, options.sweep)
                                            : rays_of_pinhole(*options.pinhole);
  for (const std::string& output : options.outputs)
    if (scan_format_of(output).is_image && rays.width == 0)
      throw WrongUsage("--output: rays that are no image's cannot become one (got " + output + ")");
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
    const auto bytes = scan_format_of(output).encode(result, rays, options.scan.returns);
    write_file(output, bytes);
    InterruptGuard::end_if_interrupted();
  }
  if (!options.table.empty()) {
    const std::string text = id_table(scene);
    write_file(options.table,
               std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
  }
  warn_of_exhausted(result.counts.exhausted, result.counts.casts);
  warn_of_inside(result, options.scan.returns);
}

}  // namespace

void add_scan(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("scan");
  const auto options = std::make_shared<ScanVerbOptions>();
  options->files = &verb.files();
  add_scene_option(verb, options->scene);
  add_other_files(verb, options->import);
  verb.add_option("--rays", options->rays,
                  "A .npy array of (N, 6), origin and direction, or (N, 7) with t_max; float32 or "
                  "float64")
      .reads_file();
  verb.add_option("--pattern", options->pattern,
                  "spinning:CHANNELSxSTEPS[:LOWEST,HIGHEST degrees], or a CSV file with columns "
                  "time (s), azimuth and zenith or elevation (degrees)")
      .reads_file();
  verb.add_option("--pinhole", options->pinhole,
                  "A JSON file of a camera: fx, fy, cx, cy, width, height in pixels; x right, y "
                  "down, z ahead")
      .reads_file();
  verb.add_option("--pose", options->pose, "Pose of the sensor").takes("X,Y,Z[,QX,QY,QZ,QW]");
  verb.add_option("--on", options->mount,
                  "The link (of a robot) or object that the sensor is mounted on: poses are in its "
                  "frame, and the sensor moves with it")
      .takes("NAME");
  verb.add_option("--path", options->path,
                  "A CSV file of the sensor's poses: columns time (s), x, y, z, and qx, qy, qz, qw "
                  "if it turns")
      .reads_file();
  verb.add_option("--start", options->scan.start, "When the sweep begins, in seconds")
      .between(-1e9, 1e9);
  verb.add_option("--sweep", options->sweep, "How many seconds a turn of spinning takes")
      .between(0.0, 1e9)
      .show_default();
  verb.add_option("--noise", options->noise,
                  "Standard deviations, in the scene's unit and in radians")
      .takes("RANGE[,ANGLE]");
  verb.add_option("--dropout", options->scan.dropout, "Probability that a ray returns nothing")
      .between(0.0, 1.0);
  verb.add_option("--seed", options->seed, "Random seed of noise and dropout (0 to 2^64 - 1)")
      .takes("N")
      .show_default();
  verb.add_option("--returns", options->scan.returns,
                  "Echoes of a ray: the bodies that it enters behind each other")
      .between(1, 64)
      .show_default();
  std::string endings;
  for (const ScanFormat& format : scan_formats())
    endings += (endings.empty() ? "" : ", ") + std::string(format.ending);
  verb.add_option("-o,--output", options->outputs,
                  "Where to write (" + endings + "); may be given again")
      .required()
      .one_value_each()
      .writes_file();
  verb.add_option("--ids", options->table, "A JSON file for the objects' numbers and names")
      .writes_file();
  verb.add_option("-t,--threads", options->threads, "Threads; 0: one per core")
      .between(0, 1024)
      .show_default();
  verb.add_flag("-q,--quiet", options->quiet, "No progress");
  add_import_options(verb, options->import);
  verb.on_call([options] { with_threads(options->threads, [&] { run(*options); }); });
}

}  // namespace minkray
