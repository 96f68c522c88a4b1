// SPDX-License-Identifier: MIT
// The files in scenes/ and docs/ that are made of the descriptions in the sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "renderer/info/scene_info.h"
#include "renderer/member_json/tagged_json.h"
#include "renderer/scene/light_descriptions.h"
#include "renderer/scene/materials.h"
#include "renderer/scene/textures.h"
#include "renderer/scene_json/scene_json.h"
#include "tests/support/messages.h"
#include "tests/support/source_files.h"
#include "tests/support/temporary_folder.h"

namespace minkray {
namespace {

const std::string schema_file = "scenes/scene.schema.json";

/// The rows of the page's tables that begin with a name.
std::vector<std::string> rows_of(const std::string& page, std::string_view name) {
  std::istringstream lines(page);
  std::vector<std::string> rows;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("| `" + std::string(name) + "` |")) rows.push_back(line);
  return rows;
}

void expect_key(const std::vector<std::string>& rows, std::string_view name, std::string_view key) {
  const std::string marked = "`" + std::string(key) + "`";
  EXPECT_TRUE(std::ranges::any_of(
      rows, [&](const std::string& row) { return row.find(marked) != std::string::npos; }))
      << "docs/scene-format.md: the row of `" << name << "` has no " << marked;
}

/// A table has a row for each of them, and it names their keys.
template <class Kinds>
void expect_rows_with_keys(const std::string& page) {
  for_each_alternative(std::type_identity<Kinds>(), [&]<class S>() {
    const std::vector<std::string> rows = rows_of(page, S::name);
    EXPECT_FALSE(rows.empty()) << "docs/scene-format.md has no row of `" << S::name << "`";
    std::apply([&](const auto&... field) { (expect_key(rows, S::name, field.name), ...); },
               S::fields());
  });
}

TEST(ShippedScenes, the_schema_is_current) {
  EXPECT_EQ(text_of_file(source_folder() / schema_file), schema_text())
      << "update it with: ./run info --schema > " << schema_file;
}

TEST(ShippedScenes, the_documented_table_of_shapes_is_current) {
  EXPECT_TRUE(has(text_of_file(source_folder() / "docs/scene-format.md"), shapes_as_markdown()))
      << "put the output of ./run info --shapes --markdown into docs/scene-format.md";
}

TEST(ShippedScenes, the_format_names_all_lights_and_materials_with_their_keys_and_all_textures) {
  const std::string page = text_of_file(source_folder() / "docs/scene-format.md");
  expect_rows_with_keys<Light>(page);
  expect_rows_with_keys<MaterialKind>(page);
  // Keys that most textures have are documented behind their table.
  for_each_alternative(std::type_identity<TextureKind>(),
                       [&]<class S>() { EXPECT_EQ(rows_of(page, S::name).size(), 1u) << S::name; });
}

TEST(ShippedScenes, cpp_and_python_have_functions_for_all_shapes) {
  const std::string python = "renderer/library/python/minkray/";
  const std::vector<std::string> cpp_files = {"include/minkray/minkray.h"},
                                 python_files = {python + "shapes.py",
                                                 python + "shapes_of_shapes.py"};
  for (const std::vector<std::string>& files : {cpp_files, python_files}) {
    std::string text;
    for (const std::string& file : files) text += text_of_file(source_folder() / file);
    const std::string& name = files.front();
    for_each_shape_kind([&]<class S>() {
      if (S::name == "custom") return;  // made of a function, and of no name
      const std::string kind = "\"" + std::string(S::name) + "\"";
      EXPECT_TRUE(has(text, kind)) << name << " makes no shape of kind ";
    });
  }
}

TEST(ShippedScenes, all_can_be_read_and_say_what_they_show) {
  const bool has_meshes = std::filesystem::exists(source_folder() / "scenes/meshes/.complete");
  std::size_t count = 0;
  for (const SourceFile& file : files_in("scenes")) {
    if (!file.name.ends_with(".json") || file.name == schema_file) continue;
    if (file.name.starts_with("scenes/parts/")) continue;  // read where they are included
    if (!has_meshes && file.text.find("\"meshes/") != std::string::npos) continue;
    Mistakes mistakes(file.name);
    const auto scene = parse_scene(file.text, source_folder() / "scenes", mistakes);
    ASSERT_TRUE(scene) << mistakes.text();
    EXPECT_FALSE(scene->description.empty()) << file.name;
    EXPECT_FALSE(scene->objects.empty()) << file.name;
    ++count;
  }
  EXPECT_GE(count, has_meshes ? 6u : 4u);
  if (!has_meshes) GTEST_SKIP() << "scenes with meshes were not read: run scenes/fetch-meshes";
}

TEST(ShippedScenes, the_zoo_and_the_bent_pipe_show_every_shape) {
  const std::string zoo = text_of_file(source_folder() / "scenes/shape-zoo.json") +
                          text_of_file(source_folder() / "scenes/bent-pipe.json");
  for_each_shape_kind([&]<class S>() {
    if (declared_by<S>.by_program) return;
    // The zoo's pictures are recorded: it stays as it is.
    const char* what_to_do = ": add a scene that shows it under its name, and read it here";
    EXPECT_TRUE(has(zoo, "\"type\": \"" + std::string(S::name) + "\"")) << S::name << what_to_do;
    EXPECT_TRUE(has(zoo, "\"name\": \"" + std::string(S::name))) << S::name << what_to_do;
  });
}

TEST(ShippedScenes, missing_meshes_are_told_with_the_command_that_fetches_them) {
  const TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  std::filesystem::copy_file(source_folder() / "scenes/fetch-meshes", folder / "fetch-meshes");
  Mistakes mistakes("robot-arm.json");
  const std::string text = text_of_file(source_folder() / "scenes/robot-arm.json");
  EXPECT_FALSE(parse_scene(text, folder, mistakes));
  ASSERT_EQ(mistakes.messages().size(), 7u);  // one a link
  EXPECT_TRUE(has(mistakes.messages()[0], "Base.obj: cannot be read"));
  EXPECT_TRUE(
      mistakes.messages()[0].ends_with("; fetch it with: " + (folder / "fetch-meshes").string()))
      << mistakes.messages()[0];
}

}  // namespace
}  // namespace minkray
