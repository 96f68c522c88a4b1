// SPDX-License-Identifier: MIT
// minkray distance: distance or depth of two shapes with its proof, or a table of such pairs for a
// robot or a scene, alone or among others.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>

#include "core/parallel/parallel.h"
#include "renderer/arguments/allowed_links.h"
#include "renderer/arguments/image_arguments.h"
#include "renderer/arguments/import_arguments.h"
#include "renderer/arguments/scene_file.h"
#include "renderer/arguments/shape_file.h"
#include "renderer/arguments/tolerance_option.h"
#include "renderer/base/csv.h"
#include "renderer/clearance/near_bodies.h"
#include "renderer/cli/file_ending.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/import/import.h"
#include "renderer/import/model/file_kind.h"
#include "renderer/io/output_file.h"
#include "renderer/json/number_json.h"
#include "renderer/query/answer.h"

namespace minkray {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

struct DistanceVerbOptions {
  CommandFiles* command_files = nullptr;
  std::vector<std::string> files;
  double tolerance = AnswerOptions{}.tolerance;
  double at_most = no_limit;  ///< for two shapes
  bool only_sign = false;     ///< for two shapes
  double within = no_limit;
  bool json = false, only_obstacles = false;
  std::string output;
  AllowedLinks allowed;
  ImportOptions import;
  int threads = 0;

  DistanceVerbOptions() { import.geometry = GeometryChoice::collision; }

  /// True if an option is given that does not apply to two shapes.
  bool is_of_table() const {
    return within != no_limit || only_obstacles || allowed.any() || is_of_robot();
  }
  bool is_of_robot() const {
    ImportOptions others = import;
    if (others.geometry == GeometryChoice::collision) others.geometry = GeometryChoice::visual;
    return others.any();
  }
};

enum class DistanceFile : unsigned char { shape, scene, robot };

/// A JSON file with neither a version nor objects is read, and its mistakes are reported, as a
/// shape.
DistanceFile kind_of_file(const std::string& file) {
  if (is_foreign(file)) return DistanceFile::robot;
  if (content_of(file).kind == FileKind::other) return DistanceFile::scene;
  Mistakes mistakes(file);
  std::optional<Json> json;
  if (const auto text = read_text_file(file, mistakes))
    json = parse_json(without_comments(*text).text, mistakes);
  throw_if_any(mistakes);
  const bool is_scene =
      json->is_object() && (json->contains("version") || json->contains("objects"));
  return is_scene ? DistanceFile::scene : DistanceFile::shape;
}

std::string shape_name(const std::string& file) {
  return std::filesystem::path(file).stem().string();
}

PosedBodies body_of_shape(const std::string& file, CommandFiles& files) {
  ClearanceBody body{shape_name(file), "", -1, ContactShape(shape_in(file, &files))};
  return {{std::move(body)}, {Affine<double>()}, {}};
}

/// Stores the model, too, for a robot's file.
PosedBodies bodies_in(const std::string& file, DistanceFile kind, const ImportOptions& import,
                      CommandFiles& files, std::optional<Model>& model) {
  if (kind == DistanceFile::shape) return body_of_shape(file, files);
  if (kind == DistanceFile::scene) {
    const Imported imported = import_scene(file);
    files.read(imported.files);
    return posed_bodies(imported.scene);
  }
  Mistakes mistakes(file);
  model = load_model(file, import, mistakes);
  throw_if_any(mistakes);
  files.read(model->files);
  pose_model(*model, import, mistakes);
  throw_if_any(mistakes);
  return posed_bodies(*model, import.geometry);
}

struct DistanceTable {
  std::vector<std::string> names;
  std::vector<NearBodies> pairs;
};

DistanceTable distance_table(const DistanceVerbOptions& options,
                             const std::vector<DistanceFile>& kinds) {
  const bool is_robot = kinds[0] == DistanceFile::robot;
  if (!is_robot && options.allowed.any())
    throw WrongUsage("--srdf and --allow are for a robot's links (" +
                     printable(options.files[0], 100) + " is no robot)");
  std::optional<Model> model, other_model;
  const PosedBodies first =
      bodies_in(options.files[0], kinds[0], options.import, *options.command_files, model);
  // Only the first file uses the joint options.
  ImportOptions of_others = options.import;
  of_others.keyframe.clear();
  of_others.joints.clear();
  PosedBodies others;
  for (std::size_t i = 1; i < options.files.size(); ++i)
    others.append(
        bodies_in(options.files[i], kinds[i], of_others, *options.command_files, other_model));
  AllowedPairs allowed;
  if (model) {
    if (first.bodies.empty()) warn_of_no_shapes(options.files[0]);
    warn_of_limits(*model, options.import);
    Mistakes mistakes(options.files[0]);
    allowed = options.allowed.read(*model, mistakes);
    throw_if_any(mistakes);
  }
  // Objects of one scene file are pairs only if there is no other file.
  const bool is_alone = options.files.size() == 1;
  const auto wanted = [&](std::size_t a, std::size_t b) {
    if (options.only_obstacles) return false;
    if (!model) return is_alone;
    return are_looked_at(first.places[a], first.places[b]) &&
           !allowed.allows(first.bodies[a].link, first.bodies[b].link);
  };
  DistanceTable table;
  table.pairs = near_bodies(first, others, wanted, {options.within, options.tolerance});
  for (const PosedBodies* posed : {&first, &std::as_const(others)})
    for (const ClearanceBody& body : posed->bodies) table.names.push_back(body.name);
  return table;
}

Json table_as_json(const DistanceTable& table, double within) {
  Json pairs = Json::array();
  for (const NearBodies& pair : table.pairs) {
    const SignedDistance& found = pair.distance;
    const bool is_known = !found.is_unknown();
    Json json = {{"a", table.names[pair.a]},
                 {"b", table.names[pair.b]},
                 {"status", std::string(name_of(found.status))},
                 {"value", is_known ? number_json(found.value) : Json(nullptr)},
                 {"lower", number_json(found.lower)},
                 {"upper", number_json(found.upper)}};
    if (is_known) {
      json["point_a"] = point_json(found.point_a);
      json["point_b"] = point_json(found.point_b);
      json["normal"] = point_json(found.normal);
    }
    pairs.push_back(std::move(json));
  }
  return {{"within", number_json(within)}, {"pairs", std::move(pairs)}};
}

std::string table_as_csv(const DistanceTable& table) {
  std::ostringstream text;
  text.precision(17);
  text << "a,b,status,value,lower,upper,point_a_x,point_a_y,point_a_z,point_b_x,point_b_y,"
          "point_b_z,normal_x,normal_y,normal_z\n";
  for (const NearBodies& pair : table.pairs) {
    const SignedDistance& found = pair.distance;
    const bool is_known = !found.is_unknown();
    text << csv_cell(table.names[pair.a]) << ',' << csv_cell(table.names[pair.b]) << ','
         << name_of(found.status) << ',';
    if (is_known) text << found.value;
    text << ',' << found.lower << ',' << found.upper;
    // A lower bound alone (--at-most) has no points.
    const bool has_points = std::isfinite(found.upper);
    for (const Vec3<double>* vector : {&found.point_a, &found.point_b, &found.normal})
      for (int axis = 0; axis < 3; ++axis) {
        text << ',';
        if (has_points) text << (*vector)[axis];
      }
    text << '\n';
  }
  return text.str();
}

/// Aligns columns to their widest cell.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows[0].size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += row[i] + std::string(widths[i] - row[i].size() + 2, ' ');
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string shown_number(double number, const char* format) {
  char text[40];
  // Shows -0 as 0.
  std::snprintf(text, sizeof text, format, number == 0 ? 0.0 : number);
  return text;
}

std::string shown_point(const Vec3<double>& point) {
  // Shows rounding errors of zero as 0.
  const double least = 1e-12 * point.cwiseAbs().maxCoeff();
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
    text += (axis > 0 ? " " : "") +
            shown_number(std::abs(point[axis]) < least ? 0 : point[axis], "%.6g");
  return text;
}

std::string table_as_text(const DistanceTable& table, double within) {
  if (table.pairs.empty())
    return within < no_limit ? "no pairs within " + shown_number(within, "%.6g") + "\n"
                             : "no pairs\n";
  std::vector<std::vector<std::string>> rows = {
      {"a", "b", "distance", "lower", "upper", "point_a", "point_b"}};
  for (const NearBodies& pair : table.pairs) {
    const SignedDistance& found = pair.distance;
    const bool is_known = !found.is_unknown();
    rows.push_back({printable(table.names[pair.a], 60), printable(table.names[pair.b], 60),
                    is_known ? shown_number(found.value, "%.6g") : "unknown",
                    shown_number(found.lower, "%.12g"), shown_number(found.upper, "%.12g"),
                    is_known ? shown_point(found.point_a) : "",
                    is_known ? shown_point(found.point_b) : ""});
  }
  return aligned(rows);
}

void distance_of_shapes(const DistanceVerbOptions& options) {
  if (options.is_of_table())
    throw WrongUsage(
        "distance: for two shapes only --tolerance, --at-most, --only-sign, --json and -o apply");
  SignedDistanceQuery query;
  query.a = shape_in(options.files[0], options.command_files);
  query.b = shape_in(options.files[1], options.command_files);
  query.at_most = options.at_most;
  query.only_sign = options.only_sign;
  AnswerOptions how;
  how.tolerance = options.tolerance;
  const Answer found = answer({{}, query, {}}, how);
  if (!options.output.empty())
    write_file(options.output,
               table_as_csv({{shape_name(options.files[0]), shape_name(options.files[1])},
                             {{0, 1, *found.signed_distance}}}));
  if (options.json || options.output.empty()) std::cout << found.json.dump() << '\n';
}

void distance(const DistanceVerbOptions& options) {
  check_tolerance(options.tolerance);
  if (std::isnan(options.at_most)) throw WrongUsage("--at-most: must be a number");
  if (!(options.within >= 0)) throw WrongUsage("--within: must be a number >= 0");
  if (!options.output.empty()) {
    check_ending(options.output, ".csv", "--output");
    check_writable(options.output);
  }
  std::vector<DistanceFile> kinds;
  for (const std::string& file : options.files) kinds.push_back(kind_of_file(file));
  if (kinds == std::vector{DistanceFile::shape, DistanceFile::shape})
    return distance_of_shapes(options);
  if (options.at_most != no_limit || options.only_sign)
    throw WrongUsage("--at-most and --only-sign are for two shapes; for a table use --within");
  if (kinds == std::vector{DistanceFile::shape})
    throw WrongUsage("distance: must have a second file (" + printable(options.files[0], 100) +
                     " is a shape)");
  if (kinds[0] != DistanceFile::robot &&
      (!options.import.joints.empty() || !options.import.keyframe.empty()))
    throw WrongUsage("--joint and --keyframe are for a robot, which must be the first file (" +
                     printable(options.files[0], 100) + " is none)");
  const DistanceTable table = distance_table(options, kinds);
  if (!options.output.empty()) write_file(options.output, table_as_csv(table));
  if (options.json)
    std::cout << table_as_json(table, options.within).dump() << '\n';
  else if (options.output.empty())
    std::cout << table_as_text(table, options.within);
}

}  // namespace

void add_distance(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("distance");
  const auto options = std::make_shared<DistanceVerbOptions>();
  options->command_files = &verb.files();
  verb.add_option(
          "files", options->files,
          "Two shape files (JSON); or a scene or robot file, optionally followed by other files "
          "to measure against\nScene or robot: " +
              scene_argument())
      .required()
      .reads_file();
  add_tolerance(verb, options->tolerance);
  verb.add_option("--within", options->within,
                  "Omit pairs that are proven to be further apart than this (scene units, >= 0)");
  verb.add_flag("--only-obstacles", options->only_obstacles,
                "Measure only to bodies of the other files, not between bodies of the first file");
  options->allowed.add_options(verb);
  verb.add_flag("--json", options->json, "Print JSON (default for two shapes)");
  verb.add_option("-o,--output", options->output,
                  "CSV file to write instead of printing the result")
      .writes_file();
  verb.add_option(
      "--at-most", options->at_most,
      "For two shapes: if the distance exceeds this (scene units), report only a lower bound");
  verb.add_flag("--only-sign", options->only_sign,
                "For two shapes: only decide whether they overlap");
  add_import_options(verb, options->import, false);
  verb.add_option("-t,--threads", options->threads, "Threads; 0: one per core")
      .between(0, 1024)
      .show_default();
  verb.on_call([options] {
    for (std::string& file : options->files) file = scene_file(file);
    with_threads(options->threads, [&] { distance(*options); });
  });
}

}  // namespace minkray
