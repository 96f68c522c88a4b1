// SPDX-License-Identifier: MIT
// minkray clearance: proven clearance of a robot from itself and obstacles, along a path or at one
// pose.
#include <iostream>
#include <memory>
#include <sstream>

#include "core/files/text.h"
#include "core/parallel/parallel.h"
#include "renderer/arguments/allowed_links.h"
#include "renderer/arguments/image_arguments.h"
#include "renderer/arguments/import_arguments.h"
#include "renderer/base/csv.h"
#include "renderer/clearance/clearance.h"
#include "renderer/clearance/swept_scene.h"
#include "renderer/cli/exit_code.h"
#include "renderer/cli/file_ending.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/import/import.h"
#include "renderer/io/output_file.h"
#include "renderer/json/number_json.h"
#include "renderer/scene_json/write_scene.h"

namespace minkray {
namespace {

struct ClearanceVerbOptions {
  CommandFiles* files = nullptr;
  std::string robot, steps, sweep;
  std::vector<std::string> others, obstacles;
  AllowedLinks allowed;
  ImportOptions import;
  ClearanceOptions clearance;
  std::optional<std::string> at_least;
  bool only_obstacles = false;
  int threads = 0;

  ClearanceVerbOptions() { import.geometry = GeometryChoice::collision; }
};

/// Words shared by rows of --steps and the result.
std::string status_of(const Closest& closest) {
  if (closest.lower > 0) return "clear";
  return closest.upper < 0 ? "collides" : "touches";
}

Json json_of(const Clearance& clearance, const std::vector<ClearanceBody>& bodies) {
  const Closest& closest = clearance.closest;
  Json json = {{"status", clearance.pairs > 0 ? status_of(closest) : "clear"},
               {"lower", number_json(closest.lower)},
               {"upper", number_json(closest.upper)}};
  if (std::isfinite(closest.upper)) {
    json["time"] = number_json(closest.time);
    json["a"] = bodies[closest.a].name;
    json["b"] = bodies[closest.b].name;
    json["point_a"] = point_json(closest.distance.point_a);
    json["point_b"] = point_json(closest.distance.point_b);
    json["normal"] = point_json(closest.distance.normal);
  }
  if (!closest.is_settled) json["settled"] = false;
  json["pairs"] = clearance.pairs;
  json["steps"] = clearance.steps_count;
  json["distances"] = clearance.distances;
  return json;
}

std::string steps_text(const Clearance& clearance, const JointPath& path,
                       const std::vector<ClearanceBody>& bodies) {
  std::ostringstream text;
  text.precision(17);
  text << "begin,end,lower,upper,time,a,b,status\n";
  for (std::size_t i = 0; i < clearance.steps.size(); ++i) {
    const Closest& step = clearance.steps[i];
    text << path.times[i] << ',' << path.times[std::min(i + 1, path.times.size() - 1)] << ','
         << step.lower << ',' << step.upper << ',' << step.time << ','
         << csv_cell(bodies[step.a].name) << ',' << csv_cell(bodies[step.b].name) << ','
         << status_of(step) << '\n';
  }
  return text.str();
}

void clearance(ClearanceVerbOptions& options, ExitCode& exit_code) {
  if (!(options.clearance.tolerance <= 1))
    throw WrongUsage("--tolerance: must be a number from 1e-9 to 1");
  const auto at_least = options.at_least ? finite_number(*options.at_least) : 0;
  if (!at_least) throw WrongUsage("--at-least: must be a number (got " + *options.at_least + ")");
  if (!options.steps.empty()) check_writable(options.steps);
  if (!options.sweep.empty()) {
    check_ending(options.sweep, ".json", "--sweep");
    check_writable(options.sweep);
  }
  Mistakes mistakes(options.robot);
  if (!is_foreign(options.robot)) mistakes.add("must be a robot's file: " + foreign_formats());
  throw_if_any(mistakes);
  std::optional<Model> model = load_model(options.robot, options.import, mistakes);
  throw_if_any(mistakes);
  options.files->read(model->files);
  pose_model(*model, options.import, mistakes);
  // Without a path, the robot rests in the pose of the options.
  const std::vector<JointRow> rows =
      options.import.joint_rows.empty()
          ? std::vector<JointRow>(1)
          : read_joint_rows(options.import.joint_rows, *model, mistakes, "--path");
  const AllowedPairs allowed = options.allowed.read(*model, mistakes);
  throw_if_any(mistakes);
  std::vector<ClearanceBody> bodies = bodies_of(*model, options.import.geometry);
  if (bodies.empty()) warn_of_no_shapes(options.robot);
  for (const std::vector<std::string>& files : {options.others, options.obstacles})
    for (const std::string& file : files) {
      const Imported obstacle = import_scene(file);
      options.files->read(obstacle.files);
      for (ClearanceBody& body : bodies_of(obstacle.scene)) bodies.push_back(body);
    }
  const std::vector<BodyPair> pairs = pairs_of(bodies, *model, allowed, !options.only_obstacles);

  const JointPath path(*model, rows);
  options.clearance.every_step = !options.steps.empty();
  const Clearance found = clearance_of(path, bodies, pairs, options.clearance);
  if (!options.steps.empty()) write_file(options.steps, steps_text(found, path, bodies));
  if (!options.sweep.empty()) {
    const Scene scene = swept_scene(*model, options.import, path, {}, mistakes);
    throw_if_any(mistakes);
    write_file(options.sweep, scene_text(scene));
  }
  std::cout << json_of(found, bodies).dump() << '\n';
  if (options.at_least && found.pairs == 0) {
    exit_code = ExitCode::comparison_failed;
    std::cerr << "no pair of bodies was checked: --at-least is not proven\n";
  } else if (options.at_least && !(found.closest.lower >= *at_least)) {
    exit_code = ExitCode::comparison_failed;
    std::cerr << "the clearance is not proven to be at least " << *options.at_least << "\n";
  }
}

}  // namespace

void add_clearance(Parser& parser, ExitCode& exit_code) {
  const Verb verb = parser.add_verb("clearance");
  const auto options = std::make_shared<ClearanceVerbOptions>();
  options->files = &verb.files();
  verb.add_option("robot", options->robot, "Robot file: " + foreign_formats())
      .required()
      .reads_file();
  verb.add_option("others", options->others, "Obstacles, as by --obstacle").reads_file();
  verb.add_option("--path", options->import.joint_rows,
                  "Joint path (CSV): a row of joint names, then rows of values\n"
                  "Joints move linearly between rows\n"
                  "Optional column \"time\" (s)\nWithout --path the robot does not move")
      .reads_file();
  verb.add_option("--obstacle", options->obstacles,
                  "Obstacle at rest: a scene or robot file; repeatable")
      .one_value_each()
      .reads_file();
  options->allowed.add_options(verb);
  verb.add_flag("--only-obstacles", options->only_obstacles,
                "Check the robot against obstacles only, not against itself (self-collision)");
  verb.add_option("--tolerance", options->clearance.tolerance,
                  "Maximum gap between lower and upper bound of the clearance, relative to the "
                  "clearance")
      .between(1e-9, 1.0)
      .show_default();
  verb.add_option("--at-least", options->at_least,
                  "Exit with 1 unless the proven clearance is at least this (scene units)")
      .takes("DISTANCE");
  verb.add_option("--steps", options->steps,
                  "CSV file to write: minimum clearance of each step from one row to the next")
      .writes_file();
  verb.add_option("--sweep", options->sweep,
                  "Scene file to write (.json): bodies that enclose the links' motion")
      .writes_file();
  add_import_options(verb, options->import, false);
  verb.add_option("-t,--threads", options->threads, "Threads; 0: one per core")
      .between(0, 1024)
      .show_default();
  verb.on_call([options, &exit_code] {
    with_threads(options->threads, [&] { clearance(*options, exit_code); });
  });
}

}  // namespace minkray
