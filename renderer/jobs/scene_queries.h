// SPDX-License-Identifier: MIT
// Queries of `minkray cast` in whole scenes: {"scene": FILE, "ray": {...}}, in addition to those at
// single shapes. Each scene is loaded once.
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

/// Safe for any number of threads.
class SceneQueries {
 public:
  /// File names are relative to the folder.
  explicit SceneQueries(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// True if a line may be such a query; false in case of doubt.
  static bool is_one(std::string_view line);

  /// Returns the number and name of the first object that the ray meets. Returns nothing, and adds
  /// mistakes, if the query cannot be used.
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
