// SPDX-License-Identifier: MIT
// The files in scenes/ and docs/ that are made of the descriptions in the sources.
#include <gtest/gtest.h>

#include "renderer/info/scene_info.h"
#include "renderer/scene/scene_json.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

const std::string schema_file = "scenes/scene.schema.json";

TEST(ShippedScenes, the_schema_is_current) {
  EXPECT_EQ(text_of_file(source_folder() / schema_file), schema_text())
      << "update it with: ./run info --schema > " << schema_file;
}

TEST(ShippedScenes, the_documented_table_of_shapes_is_current) {
  EXPECT_NE(text_of_file(source_folder() / "docs/scene-format.md").find(shapes_as_markdown()),
            std::string::npos)
      << "put the output of ./run info --shapes --markdown into docs/scene-format.md";
}

TEST(ShippedScenes, all_can_be_read_and_say_what_they_show) {
  const bool has_meshes = std::filesystem::exists(source_folder() / "scenes/meshes/.complete");
  std::size_t count = 0;
  for (const SourceFile& file : files_in("scenes")) {
    if (!file.name.ends_with(".json") || file.name == schema_file) continue;
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
  for_each_shape_kind<double>([&]<class S>() {
    if (declared_by<S>.by_program) return;
    // The zoo's pictures are recorded: it stays as it is.
    const char* what_to_do = ": add a scene that shows it under its name, and read it here";
    EXPECT_NE(zoo.find("\"type\": \"" + std::string(S::name) + "\""), std::string::npos)
        << S::name << what_to_do;
    EXPECT_NE(zoo.find("\"name\": \"" + std::string(S::name)), std::string::npos)
        << S::name << what_to_do;
  });
}

TEST(ShippedScenes, missing_meshes_are_told_with_the_command_that_fetches_them) {
  const std::filesystem::path folder = testing::TempDir() + "minkray-scene-without-meshes";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(source_folder() / "scenes/fetch-meshes", folder / "fetch-meshes");
  Mistakes mistakes("robot-arm.json");
  const std::string text = text_of_file(source_folder() / "scenes/robot-arm.json");
  EXPECT_FALSE(parse_scene(text, folder, mistakes));
  ASSERT_EQ(mistakes.messages().size(), 7u);  // one a link
  EXPECT_NE(mistakes.messages()[0].find("Base.obj: cannot be read"), std::string::npos);
  EXPECT_TRUE(
      mistakes.messages()[0].ends_with("; fetch it with: " + (folder / "fetch-meshes").string()))
      << mistakes.messages()[0];
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace minkray
