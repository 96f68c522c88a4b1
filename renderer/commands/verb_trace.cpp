// SPDX-License-Identifier: MIT
// minkray trace: prints every iteration of the cast for one pixel's ray.
#include <iostream>
#include <limits>
#include <memory>
#include <optional>

#include "core/derived/triangle_of.h"
#include "core/world/posed_mesh.h"
#include "renderer/arguments/choices.h"
#include "renderer/arguments/image_arguments.h"
#include "renderer/arguments/import_arguments.h"
#include "renderer/base/errors.h"
#include "renderer/claims/trace_picture.h"
#include "renderer/cli/file_ending.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/io/output_file.h"
#include "renderer/json/number_json.h"
#include "renderer/paper/solvers.h"
#include "renderer/rays/camera.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

struct TraceVerbOptions {
  CommandFiles* files = nullptr;
  std::string scene;
  ImportOptions import;
  std::vector<int> pixel;
  std::string object;
  std::optional<std::string> svg;
  std::string solver = "auto";
  std::string resolution;   ///< empty: the scene's
  std::string camera_file;  ///< empty: the scene's lens
  bool json = false;
};

/// Limit of objects: each takes some hundred bytes and is cast at separately.
constexpr std::size_t most_traced = 1000000;

/// Chooses the object to show: the named one, otherwise the first that the ray meets, otherwise the
/// one whose miss took most iterations. Without objects in the scene there is none.
std::size_t choose(const std::vector<PreparedShape>& shapes, const Scene& scene,
                   const std::vector<std::size_t>& objects, const Ray<double>& ray,
                   const CastOptions& cast, const std::string& name) {
  std::size_t nearest = shapes.size(), hardest = shapes.size();
  double t = std::numeric_limits<double>::infinity();
  int iterations = -1;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!name.empty()) {
      if (instance_object(scene, objects[i]).name == name) return i;
      continue;
    }
    const CastResult<double> result = cast_ray(shapes[i], ray, cast);
    if (result.found() && result.t() < t) {
      nearest = i;
      t = result.t();
    }
    if (result.iterations > iterations) {
      hardest = i;
      iterations = result.iterations;
    }
  }
  if (!name.empty())
    throw WrongUsage("trace: the scene has no object \"" + name +
                     "\" that is a shape, or a mesh that the ray hits");
  return nearest < shapes.size() ? nearest : hardest;
}

void trace(const TraceVerbOptions& options) {
  if (options.svg) check_ending(*options.svg, ".svg", "--svg");
  ImageArguments picture;
  picture.files = options.files;
  picture.scene = options.scene;
  picture.import = options.import;
  picture.resolution = options.resolution;
  picture.camera_file = options.camera_file;
  const Scene scene = picture.load_scene();
  const Resolution size = picture.render_options(scene).resolution;
  const int x = options.pixel[0], y = options.pixel[1];
  if (x < 0 || y < 0 || x >= size.width || y >= size.height)
    throw WrongUsage("trace: --pixel must be within 0,0 and " + std::to_string(size.width - 1) +
                     "," + std::to_string(size.height - 1));
  if (options.svg) check_writable(*options.svg);
  const Ray<double> through = Camera(scene.camera, size).ray(x + 0.5, y + 0.5);
  const Ray<double> ray{through.origin, through.direction};
  CastOptions cast;
  cast.solver = kind_named(named_solvers, options.solver);
  std::vector<PreparedShape> shapes;
  std::vector<std::size_t> objects;  // number of each shape's object
  std::vector<std::uint32_t> parts;  // number of the triangle, if the object is a mesh
  const std::size_t count = instance_count(scene);
  if (count > most_traced)
    throw BadInput(options.scene + ": has " + std::to_string(count) + " objects, trace takes " +
                   std::to_string(most_traced));
  shapes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Object object = instance_object(scene, i);
    Shape shape = object.shape;
    std::uint32_t part = no_part;
    if (object.mesh) {  // of a mesh, the triangle that the ray hits
      PartCounts counts;
      const double end = std::numeric_limits<double>::infinity();
      part = cast_ray(PosedMesh(0, object.mesh, object.pose), ray, end, false, 0, counts).part;
      if (part == no_part) continue;
      const TriangleMesh& mesh = *object.mesh;
      shape = triangle_of(mesh.corner(part, 0), mesh.corner(part, 1), mesh.corner(part, 2));
    } else if (!object.has_shape()) {
      continue;  // has a closed form, and no iterations to show
    }
    objects.push_back(i);
    parts.push_back(part);
    shapes.emplace_back(shape, object.pose);
  }
  const std::size_t chosen = choose(shapes, scene, objects, ray, cast, options.object);
  if (chosen == shapes.size())
    throw BadInput(options.scene +
                   ": has no shape with iterations (planes have none), and the ray hits no mesh");
  const CastTrace result = trace_ray(shapes[chosen], ray, cast);

  if (options.svg) {
    const std::string svg = trace_svg(result, shapes[chosen]);
    write_file(*options.svg, svg);
  }
  const double t = double(result.result.t_base) + double(result.result.t_offset);
  const bool found = result.result.found();
  if (options.json) {
    Json json{{"object", instance_object(scene, objects[chosen]).name},
              {"pixel", {x, y}},
              {"origin", point_json(ray.origin)},
              {"direction", point_json(ray.direction)},
              {"ball_centre", point_json(result.ball.centre)},
              {"status", name_of(result.result.status)}};
    if (parts[chosen] != no_part) json["triangle"] = parts[chosen];
    if (found) json["t"] = number_json(t);
    json["normal"] = point_json(result.result.normal);
    json["iterations"] = result.result.iterations;
    json["supports"] = result.result.supports;
    json["trace"] = trace_json(result);
    std::cout << json.dump() << '\n';
    return;
  }
  if (!found && options.object.empty())
    std::cout << "the ray hits no shape with iterations (planes have none); showing the miss with "
                 "most iterations:\n";
  std::cout << "object \"" << instance_object(scene, objects[chosen]).name << '"';
  if (parts[chosen] != no_part) std::cout << ", triangle " << parts[chosen];
  std::cout << ": " << name_of(result.result.status);
  if (found) std::cout << ", t = " << number_json(t).dump();
  std::cout << ", " << result.result.iterations << " iterations, " << result.result.supports
            << " supports\n"
            << trace_table(result);
}

}  // namespace

void add_trace(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("trace");
  const auto options = std::make_shared<TraceVerbOptions>();
  options->files = &verb.files();
  add_scene_option(verb, options->scene);
  add_other_files(verb, options->import);
  add_import_options(verb, options->import);
  verb.add_option("--pixel", options->pixel,
                  "Column and row of the pixel, counted from 0 at the upper left, such as 100,80")
      .required()
      .values(2, ',');
  verb.add_option("-r,--resolution", options->resolution,
                  "Picture size in pixels (default: the scene's)")
      .takes("WxH");
  add_camera_file_option(verb, options->camera_file);
  verb.add_option(
          "--object", options->object,
          "Name of the object to cast at; default: the object that the ray hits or, if it hits "
          "none, the one whose miss takes most iterations")
      .takes("NAME");
  add_solver_option(verb, options->solver);
  verb.add_flag("--json", options->json, "Print JSON");
  verb.add_option("--svg", options->svg, "SVG file to write: a drawing of the cast").writes_file();
  verb.on_call([options] { trace(*options); });
}

}  // namespace minkray
