// SPDX-License-Identifier: MIT
// Queries of `minkray cast` at whole scenes: {"scene": FILE, "ray": {...}}, beside those at single
// shapes. Each scene is loaded once.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>

#include "core/world/world.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Any number of threads may ask.
class SceneQueries {
 public:
  /// File names are relative to the folder.
  explicit SceneQueries(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Whether a line may be such a query; where in doubt it is none.
  static bool is_one(std::string_view line);

  /// The first object that the ray meets, by its number and name; nothing, and mistakes, if the
  /// query cannot be used.
  std::optional<Json> answer(std::string_view line, Mistakes& mistakes);

 private:
  struct Loaded {
    Scene scene;
    World world;
  };
  std::shared_ptr<const Loaded> load(const std::string& name);

  std::filesystem::path folder_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const Loaded>> loaded_;
};

}  // namespace minkray
