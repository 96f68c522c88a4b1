// SPDX-License-Identifier: MIT
// Which part of the sources may know which other part, and which library.
#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "core/shape/shape.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

/// Each layer and all that it may include beside itself. Nothing points back.
const std::map<std::string, std::vector<std::string>> layers = {
    {"core/math", {}},
    {"core/files", {}},
    {"core/shape", {"core/math", "core/files"}},
    {"core/solver", {"core/math", "core/shape"}},
    {"core/parallel", {}},
    {"core/bvh", {"core/math", "core/parallel"}},
    {"core/world", {"core/math", "core/shape", "core/solver", "core/bvh", "core/parallel"}},
    {"renderer",
     {"core/math", "core/files", "core/shape", "core/solver", "core/bvh", "core/world",
      "core/parallel"}},
    {"renderer/compare",
     {"core/math", "core/shape", "core/solver", "core/bvh", "core/world", "core/parallel",
      "renderer"}},
    {"renderer/cli",
     {"core/math", "core/shape", "core/solver", "core/bvh", "core/world", "core/parallel",
      "renderer", "renderer/compare"}},
};

/// The layer whose name is the longest start of the file's.
std::string layer_of(const std::string& file) {
  std::string layer;
  for (const auto& [name, below] : layers) {
    if (file.starts_with(name + "/") && name.size() > layer.size()) layer = name;
  }
  return layer;
}

std::vector<SourceFile> sources(const std::vector<std::string>& folders = {"core", "renderer"}) {
  std::vector<SourceFile> files;
  for (const std::string& folder : folders) {
    for (SourceFile& file : files_in(folder)) {
      if (file.name.ends_with(".h") || file.name.ends_with(".cpp")) {
        files.push_back(std::move(file));
      }
    }
  }
  return files;
}

TEST(Layers, no_include_points_back) {
  std::size_t count = 0;
  for (const SourceFile& file : sources()) {
    const std::string layer = layer_of(file.name);
    ASSERT_NE(layer, "") << file.name << " is in no layer";
    for (const std::string& included : own_includes(file)) {
      const std::string other = layer_of(included);
      const auto& below = layers.at(layer);
      EXPECT_TRUE(other == layer || std::find(below.begin(), below.end(), other) != below.end())
          << file.name << " must not include " << included;
      ++count;
    }
  }
  EXPECT_GT(count, 100u);  // the test has found the includes
}

TEST(Layers, each_library_is_seen_in_one_place) {
  // The start of what is included, and the file or folder (ending in /) that may do so.
  const std::vector<std::pair<std::string, std::string>> places = {
      {"Eigen/", "core/math/"},
      {"libqhull", "core/shape/convex_hull.cpp"},
      {"tbb/", "core/parallel/parallel.cpp"},
      {"nlohmann/", "renderer/json/json.h"},
      {"CLI/", "renderer/cli/"},
      {"embree3/", "renderer/compare/"},
      {"OpenEXR/", "renderer/exr.cpp"},
      {"mpi.h", "renderer/ranks_mpi.cpp"},
      {"stb/stb_image_write", "renderer/png.cpp"},
      {"stb/stb_easy_font", "renderer/text.cpp"},
  };
  // What only tests see; there may be one line for each of several places.
  const std::vector<std::pair<std::string, std::string>> places_in_tests = {
      {"gtest/", "tests/"},
      {"rapidcheck", "tests/support/property.h"},
      {"Eigen/", "tests/oracle/"},
      {"Eigen/", "tests/fuzz/"},
      {"mujoco/", "tests/oracle/"},
      {"ode/", "tests/oracle/"},
      {"stb/stb_image.h", "tests/renderer/"},
  };
  const std::regex standard("[a-z_]+");
  const std::regex posix("(sys/)?[a-z]+\\.h");
  for (const SourceFile& file : sources({"tests"})) {
    for (const std::string& included : library_includes(file)) {
      if (std::regex_match(included, standard)) continue;
      if (std::regex_match(included, posix) && !included.starts_with("rapidcheck")) continue;
      EXPECT_TRUE(std::any_of(places_in_tests.begin(), places_in_tests.end(),
                              [&](const auto& place) {
                                return included.starts_with(place.first) &&
                                       file.name.starts_with(place.second);
                              }))
          << file.name << " must not include " << included;
    }
  }
  for (const SourceFile& file : sources()) {
    for (const std::string& included : library_includes(file)) {
      const auto place = std::find_if(places.begin(), places.end(), [&](const auto& candidate) {
        return included.starts_with(candidate.first);
      });
      const bool is_known =
          std::regex_match(included, standard) || std::regex_match(included, posix);
      if (place == places.end() && is_known) continue;
      ASSERT_NE(place, places.end()) << file.name << " includes the unknown library " << included;
      EXPECT_TRUE(file.name.starts_with(place->second))
          << file.name << " must not include " << included;
    }
  }
}

/// Whether a kind of shape has operands.
template <class S>
constexpr bool is_operator() {
  bool found = false;
  for_each_field<S>([&](const auto& field) {
    using M = typename std::remove_cvref_t<decltype(field)>::Member;
    found |= std::is_same_v<M, Nested<double>> || std::is_same_v<M, ShapeList<double>>;
  });
  return found;
}

TEST(Layers, no_shape_is_named_outside_of_its_header_and_the_list) {
  // "tapered_capsule" to "TaperedCapsule".
  const auto type_name = [](std::string_view name) {
    std::string type;
    bool upper = true;
    for (const char c : name) {
      if (c != '_') type += upper ? static_cast<char>(std::toupper(c)) : c;
      upper = c == '_';
    }
    return type;
  };
  std::string names;
  for_each_shape_kind<double>([&]<class S>() {
    // Points and segments are what queries are made of, whatever shapes there are.
    if (S::name == "point" || S::name == "segment") return;
    if (!is_operator<S>()) names += (names.empty() ? "" : "|") + type_name(S::name);
  });
  const std::regex named("\\b(" + names + ")<");
  for (const SourceFile& file : sources()) {
    if (file.name.starts_with("core/shape/")) continue;
    // Generated scenes are of particular shapes.
    if (file.name.starts_with("renderer/generate/")) continue;
    if (file.name.starts_with("renderer/paper/")) continue;  // repeats the papers' own experiments
    std::smatch match;
    EXPECT_FALSE(std::regex_search(file.text, match, named))
        << file.name << " names the shape " << match.str();
  }
}

TEST(Repository, no_file_names_a_folder_of_one_machine) {
  const std::regex absolute(R"re((^|[\s"'(=])/(tmp|home|root|work|Users|mnt)/)re");
  for (const char* folder : {"core", "renderer", "tests", "scenes", "docs", ".ci"}) {
    for (const SourceFile& file : files_in(folder)) {
      if (file.name.starts_with("scenes/meshes/") || file.text.size() > 1000000) continue;
      std::smatch match;
      EXPECT_FALSE(std::regex_search(file.text, match, absolute)) << file.name << match.str();
    }
  }
}

TEST(Repository, every_source_begins_with_its_licence) {
  for (const char* folder : {"core", "renderer", "tests"}) {
    for (const SourceFile& file : files_in(folder)) {
      const bool is_source = file.name.ends_with(".h") || file.name.ends_with(".cpp");
      if (!is_source) continue;
      EXPECT_TRUE(file.text.starts_with("// SPDX-License-Identifier: MIT\n")) << file.name;
      if (file.name.ends_with(".h")) {
        EXPECT_NE(file.text.find("#pragma once\n"), std::string::npos) << file.name;
      }
    }
  }
}

}  // namespace
}  // namespace minkray
