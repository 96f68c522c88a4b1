// SPDX-License-Identifier: MIT
// minkray field: picture of the signed distance to a scene's nearest object, on a plane.
#include <iostream>
#include <memory>

#include "core/parallel/parallel.h"
#include "renderer/arguments/image_arguments.h"
#include "renderer/arguments/import_arguments.h"
#include "renderer/arguments/number_list.h"
#include "renderer/arguments/scene_file.h"
#include "renderer/arguments/shape_file.h"
#include "renderer/arguments/tolerance_option.h"
#include "renderer/base/interrupt.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/field/field_picture.h"
#include "renderer/import/import.h"
#include "renderer/scene/summary.h"

namespace minkray {
namespace {

struct FieldVerbOptions {
  CommandFiles* files = nullptr;
  std::string scene, probe, through, normal = "0,0,1", resolution = "640x480";
  ImportOptions import;
  std::vector<std::string> outputs;
  PreviewArguments preview;
  double extent = 0;  ///< 0: shows everything
  double tolerance = FieldOptions{}.tolerance;
  int threads = 0;
  bool quiet = false;
};

constexpr const char* field_suffix = "-field.png";

Vec3<double> field_vector(const std::string& text, const char* option) {
  const std::vector<double> numbers = number_list(text, option, {3}, "x,y,z");
  return {numbers[0], numbers[1], numbers[2]};
}

void field(FieldVerbOptions& options) {
  check_tolerance(options.tolerance);
  const Resolution resolution = parse_resolution(options.resolution);
  const Vec3<double> normal = field_vector(options.normal, "--normal");
  if (!(normal.norm() > 0)) throw WrongUsage("--normal: must not be 0,0,0");
  if (options.outputs.empty()) {
    options.outputs.push_back(default_output(options.scene, field_suffix));
    options.files->write(options.outputs.back(), "--output");
    if (!options.quiet)
      std::cerr << "the picture goes to " << printable(options.outputs.front()) << "\n";
  }
  check_outputs(options.outputs);
  const Imported imported = import_scene(options.scene, options.import);
  const Scene& scene = imported.scene;
  options.files->read(imported.files);
  if (imported.model && !options.quiet) warn_of_limits(*imported.model, options.import);
  const Shape probe =
      options.probe.empty() ? Shape(Point()) : shape_in(options.probe, options.files);

  Bounds<double> bounds;
  for (const Object& object : scene.objects)
    if (!object.half_space) bounds.extend(bounds_of(object));
  Vec3<double> middle = bounds.empty() ? Vec3<double>(Vec3<double>::Zero()) : bounds.centre();
  if (!options.through.empty()) middle = field_vector(options.through, "--through");
  double extent = options.extent;
  if (!(extent > 0)) {
    // A quarter more than the diameter of the ball around everything, whatever the picture's
    // format.
    const double diameter = bounds.empty() ? 0 : 2 * bounds.half_extents().norm();
    const double wide = std::max(1.0, double(resolution.width) / resolution.height);
    extent = 1.25 * wide * (diameter > 0 ? diameter : 1);
  }
  const FieldPlane plane =
      plane_facing(middle, normal, extent, resolution.width, resolution.height);

  const InterruptGuard guard;
  FieldOptions how;
  how.tolerance = options.tolerance;
  how.go_on = [] { return !InterruptGuard::interrupted(); };
  const DistanceField found = measure_field(scene, probe, plane, how);
  InterruptGuard::end_if_interrupted();
  const std::string title = options.probe.empty() ? "distance from the objects"
                                                  : "distance of the probe from the objects";
  const Image picture = field_picture(found, title);
  write_images(options.outputs, picture, field_numbers(found));
  show_preview(picture, options.preview);
  if (options.quiet || !options.preview.preview.empty()) return;
  double least = std::numeric_limits<double>::infinity(), widest = 0;
  std::size_t unknown = 0;
  for (std::size_t i = 0; i < found.value.size(); ++i) {
    least = std::min(least, found.value[i]);
    unknown += found.is_unknown(i) ? 1 : 0;
    if (std::isfinite(found.upper[i])) widest = std::max(widest, found.upper[i] - found.lower[i]);
  }
  std::cout << "least distance " << least << ", proven to " << widest << "; " << found.supports
            << " support points\n";
  if (unknown > 0)
    std::cout << unknown << " pixels (grey) are near objects whose distance is unknown\n";
}

}  // namespace

void add_field(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("field");
  const auto options = std::make_shared<FieldVerbOptions>();
  options->files = &verb.files();
  add_scene_option(verb, options->scene);
  add_other_files(verb, options->import);
  add_import_options(verb, options->import);
  add_output_option(verb, options->outputs, std::string("the scene's name + ") + field_suffix);
  options->preview.add_to(verb);
  verb.add_option("--through", options->through,
                  "Point at the centre of the picture (default: the scene's centre)")
      .takes("X,Y,Z");
  verb.add_option("--normal", options->normal, "Normal of the plane, towards the viewer")
      .takes("X,Y,Z")
      .show_default();
  verb.add_option("--extent", options->extent,
                  "Width of the picture in scene units; default: wide enough for all objects")
      .between(0.0, 1e300);
  verb.add_option("--probe", options->probe,
                  "JSON file of a shape that replaces the point whose distance is measured\n"
                  "The shape is moved to each point of the plane; the picture shows its signed "
                  "distance to the nearest object")
      .reads_file();
  verb.add_option("-r,--resolution", options->resolution, "Picture size in pixels")
      .takes("WxH")
      .show_default();
  add_tolerance(verb, options->tolerance);
  verb.add_option("-t,--threads", options->threads, "Threads; 0: one per core")
      .between(0, 1024)
      .show_default();
  verb.add_flag("-q,--quiet", options->quiet, "Print no report");
  verb.on_call([options] { with_threads(options->threads, [&] { field(*options); }); });
}

}  // namespace minkray
