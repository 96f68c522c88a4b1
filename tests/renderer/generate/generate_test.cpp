// SPDX-License-Identifier: MIT
#include "renderer/generate/generate.h"

#include <gtest/gtest.h>

#include "renderer/base/errors.h"
#include "renderer/paper/distance.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/scene/summary.h"
#include "renderer/scene_json/scene_json.h"
#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

TEST(Generate, every_kind_is_read_back_with_as_many_shapes_as_asked_for) {
  const TemporaryFolder folder;
  for (const GeneratedKind& kind : generated_kinds)
    for (const std::size_t count : {1u, 37u, 2000u}) {
      const std::string file = folder / (std::string(kind.name) + ".json");
      generate_scene({kind.name, count, 3}, file);
      const Scene scene = load_scene(file);
      EXPECT_EQ(instance_count(scene), count) << kind.name;
      // In sight of the camera, whatever their number.
      const Bounds<double> bounds = summarise(scene).bounds;
      EXPECT_GT((scene.camera.position - bounds.centre()).norm(), bounds.half_extents().norm());
    }
}

TEST(Generate, the_same_seed_makes_the_same_files_and_another_one_others) {
  const TemporaryFolder folder;
  for (const GeneratedKind& kind : generated_kinds) {
    std::vector<std::string> files;
    for (const std::uint64_t seed : {7u, 7u, 8u}) {
      const std::string file = folder / "scene.json", poses = folder / "scene.f32";
      std::filesystem::remove(poses);
      generate_scene({kind.name, 1500, seed}, file);
      files.push_back(text_of_file(file) +
                      (std::filesystem::exists(poses) ? text_of_file(poses) : ""));
    }
    EXPECT_TRUE(files[0] == files[1]) << kind.name;
    EXPECT_FALSE(files[0] == files[2]) << kind.name;
  }
}

// The packing is of what is read, not of what was drawn before it was rounded for the file.
TEST(Generate, no_two_ellipsoids_of_the_packing_overlap) {
  const TemporaryFolder folder;
  generate_scene({"ellipsoids", 1200, 1}, folder / "packing.json");
  const Scene scene = load_scene(folder / "packing.json");
  std::vector<CentredShape> shapes;
  for (std::size_t i = 0; i < instance_count(scene); ++i) {
    const Object object = instance_object(scene, i);
    shapes.push_back(centred(object.shape, object.pose));
  }
  int near = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double gap = (shapes[i].centre - shapes[j].centre).norm();
      if (gap > 1.5) continue;
      ++near;
      const auto distance = distance_between(shapes[i], shapes[j]);
      EXPECT_EQ(distance.status, DistanceStatus::separated) << i << " and " << j;
    }
  EXPECT_GT(near, 1000);  // as dense as a packing is
}

TEST(Generate, what_cannot_be_made_is_told) {
  const TemporaryFolder folder;
  EXPECT_THROW(generate_scene({"hulls", most_generated_hulls + 1, 0}, folder / "x.json"),
               WrongUsage);
  EXPECT_THROW(generate_scene({"cubes", 10, 0}, folder / "x.json"), WrongUsage);
  EXPECT_THROW(generate_scene({"spheres", 5000, 0}, folder / "none/x.json"), CannotWrite);
  EXPECT_TRUE(folder.files().empty());
}

}  // namespace
}  // namespace minkray
