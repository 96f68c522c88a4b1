// SPDX-License-Identifier: MIT
// What tests of importers begin with.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "renderer/import/import.h"

namespace minkray {

inline ImportOptions without_meshes() {
  ImportOptions options;
  options.skip_missing_meshes = true;
  return options;
}

/// What is said of a text that must be refused.
inline std::string mistakes_of(const std::string& text, const std::string& file = "robot.urdf") {
  Mistakes mistakes(file);
  EXPECT_FALSE(parse_model(text, file, {}, mistakes));
  return mistakes.text();
}

}  // namespace minkray
