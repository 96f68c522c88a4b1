// SPDX-License-Identifier: MIT
// Reads scenes from files of any supported format: JSON, MJCF, URDF, SDF, glTF. Only import.cpp
// lists the formats.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "renderer/import/model/import_options.h"
#include "renderer/import/model/model.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/json/mistakes.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// A scene, and the model it was made of, unless it was a scene file.
struct Imported {
  Scene scene;
  std::optional<Model> model;
  std::vector<Model> other_models = {};           ///< those of options.others that are robots
  std::vector<JointRow> rows = {};                ///< that it moves by, if it does
  std::vector<std::filesystem::path> files = {};  ///< all that were read
};

/// Their names with the endings of their files, for messages: "MJCF (.xml, .mjcf), URDF (.urdf)..."
std::string foreign_formats();

/// True if the file holds a robot's description; for one that cannot be read, its extension
/// decides.
bool is_foreign(const std::filesystem::path& file);

/// Throws BadInput that names the kind of file if it is a picture, a mesh or the like.
void check_can_be_scene(const std::filesystem::path& file);

/// The scene of a file, with all that options.others hold: the first file that is a scene has the
/// camera and the lights, and joints are those of `file`. Throws BadInput with all mistakes, one
/// per line; WrongUsage if options for robots are used with a scene file.
Imported import_scene(const std::filesystem::path& file, const ImportOptions& options = {});

/// The model that a text in one of the formats describes; nothing, and mistakes, if anything is
/// wrong. Other files are searched next to `file`.
std::optional<Model> parse_model(const std::string& text, const std::filesystem::path& file,
                                 const ImportOptions& options, Mistakes& mistakes);

/// Reads the text from a file.
std::optional<Model> load_model(const std::filesystem::path& file, const ImportOptions& options,
                                Mistakes& mistakes);

}  // namespace minkray
