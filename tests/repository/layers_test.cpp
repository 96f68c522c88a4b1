// SPDX-License-Identifier: MIT
// Dependencies allowed between parts of the sources, and on libraries.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "core/shape/shape.h"
#include "tests/support/messages.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

// One a line:
// clang-format off
/// Every folder of the sources, from the ground up: each may include itself and those before it.
const std::vector<std::string> rooms = {
    "core/math",
    "core/parallel",
    "core/files",
    "core/geometry",
    "core/support",
    "core/shape",
    "core/derived",
    "core/query",
    "core/polytope",
    "core/exact",
    "core/gjk",
    "core/model",
    "core/proof",
    "core/screen",
    "core/pair",
    "core/pair_distance",
    "core/pair_motion",
    "core/cast",
    "core/pair_derivative",
    "core/bvh",
    "core/mesh",
    "core/parts",
    "core/world",
    "renderer/base",
    "renderer/image",
    "renderer/json",
    "renderer/io",
    "renderer/scene",
    "renderer/member_json",
    "renderer/scene_json",
    "renderer/import/model",
    "renderer/import/mesh",
    "renderer/import/mjcf",
    "renderer/import/sdf",
    "renderer/import",
    "renderer/clearance",
    "renderer/paper",
    "renderer/rays",
    "renderer/surfaces",
    "renderer/lights",
    "renderer/paths",
    "renderer/audit",
    "renderer/query",
    "renderer/film",
    "renderer/sensor",
    "renderer/share",
    "renderer/field",
    "renderer/info",
    "renderer/claims",
    "renderer/generate",
    "renderer/verify",
    "renderer/plan",
    "renderer/library/handles",
    "renderer/library",
    "renderer/library/python",
    "renderer/compare",
    "renderer/inspect",
    "renderer/cli",
    "renderer/arguments",
    "renderer/jobs",
    "renderer/commands",
};
// clang-format on

std::string folder_of(const std::string& file) {
  return file.substr(0, file.rfind('/'));
}

/// Index of a room in `rooms`; their number if it is not there.
std::size_t floor_of(const std::string& room) {
  return static_cast<std::size_t>(std::find(rooms.begin(), rooms.end(), room) - rooms.begin());
}

std::vector<SourceFile> sources(const std::vector<std::string>& folders = {"core", "renderer"}) {
  std::vector<SourceFile> files;
  for (const std::string& folder : folders) {
    for (SourceFile& file : files_in(folder)) {
      if (file.name.ends_with(".h") || file.name.ends_with(".cpp") || file.name.ends_with(".inl")) {
        files.push_back(std::move(file));
      }
    }
  }
  return files;
}

TEST(Layers, no_include_points_up) {
  std::size_t count = 0;
  std::set<std::string> found;
  for (const SourceFile& file : sources()) {
    const std::string room = folder_of(file.name);
    found.insert(room);
    ASSERT_LT(floor_of(room), rooms.size()) << file.name << " is in no room of this test's list";
    for (const std::string& included : own_includes(file)) {
      EXPECT_LE(floor_of(folder_of(included)), floor_of(room))
          << file.name << " must not include " << included;
      ++count;
    }
  }
  EXPECT_GT(count, 100u);                 // the test has found the includes
  EXPECT_EQ(found.size(), rooms.size());  // and the list names no room that is not there
}

TEST(Layers, no_room_has_more_than_24_names) {
  // A name is a file's without its ending and its instruction set.
  const std::regex rest("(_avx2|_sse2)?\\.[a-z]+$");
  std::map<std::string, std::set<std::string>> names;
  for (const SourceFile& file : sources())
    names[folder_of(file.name)].insert(std::regex_replace(file.name, rest, ""));
  for (const auto& [room, of_room] : names)
    EXPECT_LE(of_room.size(), 24u) << room << " holds more than one idea: split it";
}

/// Finds the first of the rooms that can be reached from themselves; "" if there is none.
std::string room_in_a_cycle(const std::map<std::string, std::set<std::string>>& includes) {
  for (const auto& [room, others] : includes) {
    std::set<std::string> reached;
    std::vector<std::string> open(others.begin(), others.end());
    while (!open.empty()) {
      const std::string next = open.back();
      open.pop_back();
      if (next == room) return room;
      if (!reached.insert(next).second || !includes.contains(next)) continue;
      open.insert(open.end(), includes.at(next).begin(), includes.at(next).end());
    }
  }
  return "";
}

TEST(Layers, a_cycle_is_found) {
  EXPECT_EQ(room_in_a_cycle({{"a", {"b"}}, {"b", {"c"}}, {"c", {}}}), "");
  EXPECT_EQ(room_in_a_cycle({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}}), "b");
}

TEST(Layers, there_is_no_cycle_whatever_the_list_says) {
  std::map<std::string, std::set<std::string>> includes;
  for (const SourceFile& file : sources())
    for (const std::string& included : own_includes(file))
      if (folder_of(included) != folder_of(file.name))
        includes[folder_of(file.name)].insert(folder_of(included));
  EXPECT_EQ(room_in_a_cycle(includes), "");
}

TEST(Layers, each_library_is_seen_in_one_place) {
  // The start of what is included, and the file or folder (ending in /) that may do so.
  const std::vector<std::pair<std::string, std::string>> places = {
      {"Eigen/", "core/math/"},
      {"libqhull", "core/geometry/convex_hull.cpp"},
      {"tbb/", "core/parallel/parallel.cpp"},
      {"nlohmann/", "renderer/json/"},
      {"CLI/", "renderer/cli/options.cpp"},
      {"embree3/", "renderer/compare/"},
      {"OpenEXR/", "renderer/io/exr.cpp"},
      {"minkray/minkray_c.h", "renderer/library/handles/c_header.h"},
      {"minkray/minkray.h", "renderer/library/python/public_header.h"},
      {"pybind11/", "renderer/library/python/"},
      {"tinyxml2.h", "renderer/import/model/xml.cpp"},
      {"yaml-cpp/", "renderer/plan/document.cpp"},
      {"mpi.h", "renderer/share/ranks_mpi.cpp"},
      {"zlib.h", "renderer/io/deflate.cpp"},
      {"arpa/", "renderer/inspect/loopback.cpp"},
      {"netinet/", "renderer/inspect/loopback.cpp"},
      {"linux/membarrier.h", "renderer/library/handles/scene_use.cpp"},
      {"stb/stb_image_write", "renderer/io/png.cpp"},
      {"stb/stb_image.h", "renderer/io/read_image.cpp"},
      {"stb/stb_easy_font", "renderer/image/text.cpp"},
  };
  // Libraries for tests only; there may be one line for each of several places.
  const std::vector<std::pair<std::string, std::string>> places_in_tests = {
      {"gtest/", "tests/"},
      {"rapidcheck", "tests/support/property.h"},
      {"Eigen/", "tests/oracle/"},
      {"Eigen/", "tests/fuzz/"},
      {"mujoco/", "tests/oracle/"},
      {"ode/", "tests/oracle/"},
      {"sdf/", "tests/oracle/"},
      {"netinet/in.h", "tests/renderer/jobs/"},
      {"netinet/in.h", "tests/renderer/inspect/"},
      {"stb/stb_image.h", "tests/renderer/"},
      {"minkray/", "tests/renderer/library/"},
      {"minkray/", "tests/soak/"},
      {"minkray/minkray.h", "tests/proof/grid_meshes.h"},
      {"minkray/minkray_c.h", "tests/fuzz/c_abi_calls.h"},
      {"nlohmann/", "tests/fuzz/change/"},
      {"tinyxml2.h", "tests/fuzz/change/"},
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
      ASSERT_NE(place, places.end())
          << file.name << " includes a library that is not in this test's list: " << included;
      EXPECT_TRUE(file.name.starts_with(place->second))
          << file.name << " must not include " << included;
    }
  }
}

/// True if a kind of shape has operands.
template <class S>
constexpr bool is_operator() {
  bool found = false;
  for_each_field<S>([&](const auto& field) {
    using M = typename std::remove_cvref_t<decltype(field)>::Member;
    found |= std::is_same_v<M, Nested> || std::is_same_v<M, ShapeList>;
  });
  return found;
}

/// Converts "tapered_capsule" to "TaperedCapsule".
std::string type_name(std::string_view name) {
  std::string type;
  bool upper = true;
  for (const char c : name) {
    if (c != '_') type += upper ? static_cast<char>(std::toupper(c)) : c;
    upper = c == '_';
  }
  return type;
}

TEST(Layers, a_shape_is_named_in_at_most_six_files) {
  for (const std::string name : {"cut_cylinder", "tapered_capsule", "superellipsoid"}) {
    const std::regex named("\\b(" + name + "|" + type_name(name) + "(Form)?)\\b");
    std::string found;
    int count = 0;
    for (const char* folder : {"core", "renderer", "include"}) {
      for (const SourceFile& file : files_in(folder)) {
        if (file.name.starts_with("renderer/import/")) continue;  // other programs' shapes
        if (file.name.ends_with(".pyc") || !std::regex_search(file.text, named)) continue;
        found += " " + file.name;
        ++count;
      }
    }
    EXPECT_GE(count, 4) << name << ":" << found;  // the test has found the files
    EXPECT_LE(count, 6) << name << ":" << found;
  }
}

TEST(Layers, shapes_are_named_only_where_shapes_and_forms_are_defined) {
  std::string names;
  for_each_shape_kind([&]<class S>() {
    // Queries are made of points and segments, meshes of triangles, and trees of boxes.
    for (const char* common : {"point", "segment", "triangle", "box"})
      if (S::name == common) return;
    if (!is_operator<S>()) names += (names.empty() ? "" : "|") + type_name(S::name);
  });
  const std::regex named("\\b(" + names + ")\\b");
  for (const SourceFile& file : sources()) {
    const std::string room = folder_of(file.name);
    if (room == "core/shape" || room == "core/derived" || room == "core/exact") continue;
    // Generated scenes are of particular shapes.
    if (file.name.starts_with("renderer/generate/")) continue;
    // Other programs' files are read there.
    if (file.name.starts_with("renderer/import/")) continue;
    // Parts of meshes are hulls.
    if (file.name == "renderer/scene_json/read_split.cpp") continue;
    // Input from programs arrives there.
    if (file.name == "renderer/library/c_shapes.cpp") continue;
    if (file.name.starts_with("renderer/claims/")) continue;  // repeats the papers' own experiments
    std::smatch match;
    EXPECT_FALSE(std::regex_search(file.text, match, named))
        << file.name << " names the shape " << match.str()
        << ": what is special about it belongs in the shape's header "
           "(core/support/declared.h)";
  }
}

/// Ensures that its header compiles alone; the others are checked by tests/CMakeLists.txt.
TEST(Repository, a_source_includes_its_own_header_first) {
  for (const SourceFile& file : sources()) {
    if (!file.name.ends_with(".cpp")) continue;
    const std::string header = file.name.substr(0, file.name.size() - 3) + "h";
    if (!std::filesystem::exists(source_folder() / header)) continue;
    const std::string first = file.text.substr(file.text.find("#include "));
    EXPECT_TRUE(first.starts_with("#include \"" + header + "\"\n"))
        << file.name << " must include " << header << " first";
  }
}

TEST(Repository, no_file_names_a_folder_of_one_machine) {
  const std::regex absolute(R"re((^|[\s"'(=])/(tmp|home|root|work|Users|mnt)/)re");
  for (const char* folder : {"core", "renderer", "tests", "scenes", "docs", ".ci"}) {
    for (const SourceFile& file : files_in(folder)) {
      if (file.name.starts_with("scenes/meshes/") || file.text.size() > 1000000) continue;
      std::smatch match;
      EXPECT_FALSE(std::regex_search(file.text, match, absolute))
          << file.name << " has " << match.str();
    }
  }
}

TEST(Repository, every_source_begins_with_its_licence) {
  for (const char* folder : {"core", "renderer", "tests"}) {
    for (const SourceFile& file : files_in(folder)) {
      const bool is_source = file.name.ends_with(".h") || file.name.ends_with(".cpp");
      if (!is_source) continue;
      EXPECT_TRUE(file.text.starts_with("// SPDX-License-Identifier: MIT\n"))
          << file.name << " must begin with it";
      if (file.name.ends_with(".h")) {
        EXPECT_TRUE(has(file.text, "#pragma once\n")) << file.name << " must have #pragma once";
      }
    }
  }
}

}  // namespace
}  // namespace minkray
