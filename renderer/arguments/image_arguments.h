// SPDX-License-Identifier: MIT
// Options shared by the commands that make pictures: a scene, outputs, size, samples, threads,
// solver.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/arguments/preview.h"
#include "renderer/film/render.h"
#include "renderer/import/model/import_options.h"

namespace minkray {

class CommandFiles;
struct Model;
class Option;
class Verb;

struct ImageArguments {
  CommandFiles* files = nullptr;  ///< files of the command
  std::string scene;
  ImportOptions import;
  std::vector<std::string> outputs;
  std::string resolution;   ///< empty: resolution of the scene
  std::string crop;         ///< empty: whole picture
  std::string camera_file;  ///< empty: lens of the scene
  std::string solver = "auto";
  std::string seed = "0";
  int samples = 1;
  int threads = 0;
  bool quiet = false;
  bool is_output_chosen = false;

  PreviewArguments preview;

  /// Adds the options; defaults in help are the members' values. Without -o the picture's name is
  /// made from the scene's name and `suffix`, see choose_output.
  void add_to(const Verb& verb, const std::string& suffix);

  /// Sets -o to default_output of the scene, if it is not given.
  void choose_output(const std::string& suffix);
  /// Prints the output file's name if choose_output chose it. Call this once it is certain that
  /// there will be a picture.
  void tell_output() const;

  /// Loads the scene and adds its files to the command's. A camera that frames everything uses the
  /// requested resolution.
  Scene load_scene() const;

  /// Returns the options for a scene, for `panels` pictures next to each other. Throws WrongUsage
  /// if a value is not usable.
  RenderOptions render_options(const Scene& loaded, std::size_t panels = 1) const;
};

/// Reads WIDTHxHEIGHT; throws WrongUsage for anything else.
Resolution parse_resolution(const std::string& text);

/// Throws WrongUsage for anything but a whole number of 64 bits.
std::uint64_t parse_seed(const std::string& text);

/// Adds the scene as a positional argument: a file, or the name of a built-in scene. The argument
/// is required unless the returned option is changed.
Option add_scene_option(const Verb& verb, std::string& scene);

/// Adds --camera-file, the lens of the picture.
void add_camera_file_option(const Verb& verb, std::string& camera_file);

/// Adds -o, a list of image files. `otherwise` describes the default output; if it is empty, -o is
/// required.
void add_output_option(const Verb& verb, std::vector<std::string>& outputs,
                       const std::string& otherwise = "");

/// Throws WrongUsage for an output of unknown format, CannotWrite for one that cannot be written.
void check_outputs(const std::vector<std::string>& outputs);

/// Returns options for casts with the named solver. Throws WrongUsage that lists the names.
CastOptions cast_options(const std::string& solver, const std::string& option = "--solver");

/// Encodes and writes to each of the paths: `floats` for formats that store them, `picture` for the
/// others. Ends the process early if it was interrupted.
void write_images(const std::vector<std::string>& outputs, const Image& picture,
                  const Image& floats);

/// Warns on stderr if joints were set beyond their limits.
void warn_of_limits(const Model& model, const ImportOptions& options);

/// Warns on stderr that a robot's file has no shapes to check.
void warn_of_no_shapes(const std::string& robot);

/// Warns on stderr if any cast was exhausted, or a camera ray began in a shape.
void warn_of_counts(const RayCounts& counts);

/// Warns on stderr if any cast was exhausted.
void warn_of_exhausted(std::uint64_t exhausted, std::uint64_t casts);

}  // namespace minkray
