// SPDX-License-Identifier: MIT
// What the verbs that make pictures take alike: a scene, outputs, size, samples, threads, solver.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/cli/preview.h"
#include "renderer/film/render.h"
#include "renderer/import/import_options.h"

namespace minkray {

class CommandFiles;
struct Model;
class Option;
class Verb;

struct ImageArguments {
  CommandFiles* files = nullptr;  ///< of the command
  std::string scene;
  ImportOptions import;
  std::vector<std::string> outputs;
  std::string resolution;   ///< empty: the scene's
  std::string crop;         ///< empty: all
  std::string camera_file;  ///< empty: the scene's lens
  std::string solver = "auto";
  std::string seed = "0";
  int samples = 1;
  int threads = 0;
  bool quiet = false;
  bool is_output_chosen = false;

  PreviewArguments preview;

  /// Adds the options; defaults shown are the members' values. Without -o the picture is to go to
  /// the scene's name and `suffix`, see choose_output.
  void add_to(const Verb& verb, const std::string& suffix);

  /// If there is no -o: chooses default_output of the scene.
  void choose_output(const std::string& suffix);
  /// Says where the picture goes, if choose_output chose: once it is known that there will be one.
  void tell_output() const;

  /// The scene, whose files are added to the command's. A camera that frames everything does so at
  /// the resolution that is asked for.
  Scene load_scene() const;

  /// The options for a scene, of which `panels` pictures come beside each other. Throws WrongUsage
  /// where a value is not usable.
  RenderOptions render_options(const Scene& loaded, std::size_t panels = 1) const;
};

/// Reads WIDTHxHEIGHT; throws WrongUsage for anything else.
Resolution parse_resolution(const std::string& text);

/// Throws WrongUsage for what is no whole number of 64 bits.
std::uint64_t parse_seed(const std::string& text);

/// Adds the scene by its place: a file, or the name of one that comes with Minkray. It must be
/// there unless the answer is told otherwise.
Option add_scene_option(const Verb& verb, std::string& scene);

/// Adds -o, of a list of image files. `otherwise` says where the picture goes without it; empty: -o
/// must be there.
void add_output_option(const Verb& verb, std::vector<std::string>& outputs,
                       const std::string& otherwise = "");

/// Throws WrongUsage for an output whose format is unknown, CannotWrite for one that could not be
/// written later.
void check_outputs(const std::vector<std::string>& outputs);

/// Options for the casts of a solver by name. Throws WrongUsage with the names there are.
CastOptions<double> cast_options(const std::string& solver, const std::string& option = "--solver");

/// Encodes and writes to each of the paths: `floats` to the formats that keep them, `picture` to
/// the others. Ends the process early if it was interrupted.
void write_images(const std::vector<std::string>& outputs, const Image& picture,
                  const Image& floats);

/// Warnings on stderr if joints that were asked to stand somewhere stand beyond their limits.
void warn_of_limits(const Model& model, const ImportOptions& options);

/// Warnings on stderr if any cast gave up, or a camera ray began in a shape.
void warn_of_counts(const RayCounts& counts);

/// A warning on stderr if any cast gave up.
void warn_of_exhausted(std::uint64_t exhausted, std::uint64_t casts);

}  // namespace minkray
