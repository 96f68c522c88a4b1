// SPDX-License-Identifier: MIT
#include "renderer/arguments/image_arguments.h"
#include "renderer/scene/framing.h"

#include <algorithm>
#include <iostream>
#include <optional>

#include "core/files/text.h"
#include "core/support/named_kind.h"
#include "renderer/arguments/import_arguments.h"
#include "renderer/arguments/scene_file.h"
#include "renderer/base/errors.h"
#include "renderer/base/hash.h"
#include "renderer/base/interrupt.h"
#include "renderer/cli/options.h"
#include "renderer/import/import.h"
#include "renderer/io/image_file.h"
#include "renderer/io/output_file.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/paper/solvers.h"
#include "renderer/scene/calibrated_camera.h"

namespace minkray {
namespace {

/// Maximum number of pixels, since encoders count bytes in an int. For a crop of a larger picture,
/// only the crop's pixels count.
constexpr int max_pixels = 1 << 27;
constexpr int max_side = 1 << 16;

PixelRect parse_crop(const std::string& text, const Resolution& resolution) {
  const auto numbers = numbers_between<int>(text, ',');
  const auto wrong = [&](const std::string& why) -> WrongUsage {
    return WrongUsage("--crop: " + why + " (got " + text + ")");
  };
  if (!numbers || numbers->size() != 4) throw wrong("must be x0,y0,x1,y1 in pixels");
  const PixelRect crop{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
  if (crop.empty()) throw wrong("must have x0 < x1 and y0 < y1");
  if (crop.x0 < 0 || crop.y0 < 0 || crop.x1 > resolution.width || crop.y1 > resolution.height)
    throw wrong("must lie in the image of " + std::to_string(resolution.width) + "x" +
                std::to_string(resolution.height));
  return crop;
}

}  // namespace

Resolution parse_resolution(const std::string& text) {
  const auto numbers = numbers_between<int>(text, 'x');
  const auto wrong = [&](const std::string& why) -> WrongUsage {
    return WrongUsage("--resolution: " + why + " (got " + text + ")");
  };
  if (!numbers || numbers->size() != 2)
    throw wrong("must be WIDTHxHEIGHT in pixels, such as 960x540");
  const Resolution resolution{(*numbers)[0], (*numbers)[1]};
  if (resolution.width < 1 || resolution.height < 1)
    throw wrong("width and height must be at least 1");
  if (resolution.width > max_side || resolution.height > max_side)
    throw wrong("width and height must be at most " + std::to_string(max_side));
  return resolution;
}

std::uint64_t parse_seed(const std::string& text) {
  std::uint64_t seed = 0;
  if (!read_number(text, seed))
    throw WrongUsage("--seed: must be a whole number from 0 to 18446744073709551615 (got " + text +
                     ")");
  return seed;
}

void ImageArguments::add_to(const Verb& verb, const std::string& suffix) {
  files = &verb.files();
  add_scene_option(verb, scene);
  add_other_files(verb, import);
  const Option verbose = add_import_options(verb, import);
  add_output_option(verb, outputs, "the scene's name + " + suffix);
  preview.add_to(verb);
  verb.add_option("-r,--resolution", resolution, "Picture size in pixels (default: the scene's)")
      .takes("WxH");
  add_camera_file_option(verb, camera_file);
  verb.add_option("-s,--spp", samples, "Samples per pixel").between(1, 1 << 24).show_default();
  verb.add_option("-t,--threads", threads, "Threads; 0: one per core")
      .between(0, 1024)
      .show_default();
  verb.add_option("--crop", crop, "Render only this region (ROI) of the picture, in pixels")
      .takes("X0,Y0,X1,Y1");
  // Takes the seed as text, since CLI11 clamps values that are too large.
  verb.add_option("--seed", seed, "Random seed, 0 to 2^64 - 1").takes("N").show_default();
  verb.add_flag("-q,--quiet", quiet, "Print neither progress nor a report").excludes(verbose);
}

void ImageArguments::choose_output(const std::string& suffix) {
  if (!outputs.empty()) return;
  check_can_be_scene(scene);
  outputs.push_back(default_output(scene, suffix));
  files->write(outputs.back(), "--output");
  is_output_chosen = true;
}

void ImageArguments::tell_output() const {
  if (is_output_chosen && !quiet)
    std::cerr << "the picture goes to " << printable(outputs.front()) << "\n";
}

Option add_scene_option(const Verb& verb, std::string& scene) {
  return verb.add_option("scene", scene, scene_argument())
      .required()
      .replace(scene_file)
      .reads_file();
}

void add_camera_file_option(const Verb& verb, std::string& camera_file) {
  verb.add_option(
          "--camera-file", camera_file,
          "JSON file of a calibrated camera, whose lens and picture size replace the scene's")
      .reads_file();
}

void add_output_option(const Verb& verb, std::vector<std::string>& outputs,
                       const std::string& otherwise) {
  verb.add_option("-o,--output", outputs,
                  "Picture to write (" + image_extensions() + "); repeatable" +
                      (otherwise.empty() ? "" : "; default: " + otherwise))
      .required(otherwise.empty())
      .one_value_each()
      .writes_file();
}

void check_outputs(const std::vector<std::string>& outputs) {
  for (const std::string& output : outputs)
    if (!is_image_path(output))
      throw WrongUsage("--output: must end in one of " + image_extensions() + " (got " + output +
                       ")");
  for (const std::string& output : outputs) check_writable(output);
}

namespace {

/// Text of a lens for the hash of a scene. Part files are merged only if their hashes, and so their
/// lenses, are equal.
std::string lens_text(const CalibratedCamera::Numbers& numbers) {
  std::vector<double> all = {double(numbers.model == CalibratedCamera::Model::fisheye),
                             numbers.fx,
                             numbers.fy,
                             numbers.cx,
                             numbers.cy,
                             double(numbers.width),
                             double(numbers.height),
                             numbers.p1,
                             numbers.p2};
  all.insert(all.end(), numbers.k.begin(), numbers.k.end());
  return Json(all).dump();
}

/// Sets the lens and size of the scene's camera from a file.
void take_lens(Scene& scene, const std::string& file) {
  auto lens = std::make_shared<const CalibratedCamera>(read_calibrated_camera(file));
  const CalibratedCamera::Numbers& numbers = lens->numbers();
  scene.camera.resolution = {numbers.width, numbers.height};
  if (std::max(numbers.width, numbers.height) > most_pixels_a_side)
    throw BadInput(file + ": width and height must be at most " +
                   std::to_string(most_pixels_a_side) + " for pictures");
  if (numbers.row_time > 0)
    std::cerr << "warning: pictures expose all rows at once, without row_time (" +
                     printable(file, 100) + ")\n";
  Hash hash;
  hash.add(scene.hash);
  hash.add(lens_text(numbers));
  scene.hash = hash.text();
  scene.camera.calibration = std::move(lens);
}

}  // namespace

Scene ImageArguments::load_scene() const {
  ImportOptions options = import;
  if (!resolution.empty()) options.picture = parse_resolution(resolution);
  Imported imported = import_scene(scene, options);
  if (imported.model && !quiet) warn_of_limits(*imported.model, options);
  Scene loaded = std::move(imported.scene);
  if (loaded.camera_is_framed && !resolution.empty()) {
    loaded.camera.resolution = options.picture;
    frame_with_own_lens(loaded);
  }
  files->read(imported.files);
  if (!camera_file.empty()) take_lens(loaded, camera_file);
  return loaded;
}

RenderOptions ImageArguments::render_options(const Scene& loaded, std::size_t panels) const {
  RenderOptions options;
  options.resolution = resolution.empty() ? loaded.camera.resolution : parse_resolution(resolution);
  if (!crop.empty()) options.crop = parse_crop(crop, options.resolution);
  const PixelRect region = options.region();
  if (std::int64_t{region.width()} * region.height() >
      max_pixels / static_cast<std::int64_t>(panels))
    throw WrongUsage("--resolution: at most " + std::to_string(max_pixels) +
                     " pixels at once; use --crop (got " + std::to_string(region.width()) + "x" +
                     std::to_string(region.height()) + ")");
  options.samples = samples;
  options.seed = parse_seed(seed);
  return options;
}

CastOptions cast_options(const std::string& solver, const std::string& option) {
  const NamedSolver* const known = row_named(named_solvers, solver);
  if (!known)
    throw WrongUsage(option + ": must be one of " + listed(names_in(named_solvers)) + " (got " +
                     solver + ")");
  CastOptions options;
  options.solver = known->kind;
  return options;
}

void write_images(const std::vector<std::string>& outputs, const Image& picture,
                  const Image& floats) {
  for (const std::string& output : outputs) {
    const auto bytes = encode_image(keeps_floats(output) ? floats : picture, output);
    InterruptGuard::end_if_interrupted();
    write_file(output, bytes);
    InterruptGuard::end_if_interrupted();
  }
}

void warn_of_limits(const Model& model, const ImportOptions& options) {
  if (options.joints.empty() && options.joint_rows.empty() && options.keyframe.empty()) return;
  for (const PassedOver& one : model.passed_over)
    if (one.what.starts_with("limit of the joint"))
      std::cerr << "warning: " << one.what << ": " << one.why << "\n";
}

void warn_of_no_shapes(const std::string& robot) {
  std::cerr << "warning: " << printable(robot)
            << ": the robot has no shapes of the chosen --geometry; nothing of it is checked\n";
}

void warn_of_counts(const RayCounts& counts) {
  warn_of_exhausted(counts.work.exhausted, counts.work.casts);
  if (counts.from_inside > 0)
    std::cerr << "warning: the camera is inside a shape; the picture is black there\n";
}

void warn_of_exhausted(std::uint64_t exhausted, std::uint64_t casts) {
  if (exhausted == 0) return;
  std::cerr << "warning: the solver did not converge in " << exhausted << " of " << casts
            << " casts; rays passed through those shapes (minkray heatmap --channel status shows "
               "where)\n";
}

}  // namespace minkray
