// SPDX-License-Identifier: MIT
// Particles are cheaper objects: the same poses, the same pictures; and mistakes in their files
// are reported with the row.
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "renderer/film/render.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/scene_json/scene_json.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

/// A scene with that in its lists of objects and particles.
std::string scene_text(const std::string& objects, const std::string& particles) {
  return R"({"version": 1, "camera": {"position": [0, -9, 3], "look_at": [0, 0, 0],
    "resolution": [40, 30]},
    "lights": [{"type": "environment", "zenith": [1, 1, 1], "nadir": [0.5, 0.5, 0.5]}],
    "materials": [{"name": "red", "type": "lambert", "color": [0.8, 0.1, 0.1]},
                  {"name": "blue", "type": "lambert", "color": [0.1, 0.1, 0.8]}],
    "objects": [)" +
         objects + "], \"particles\": [" + particles + "]}";
}

constexpr const char* box = R"("shape": {"type": "box", "half_extents": [0.5, 0.3, 0.2]})";

class Particles : public ::testing::Test {
 protected:
  /// The scene; what is wrong with it is kept.
  std::optional<Scene> read(const std::string& block) {
    Mistakes mistakes("x.json");
    auto scene =
        parse_scene(scene_text("", "{\"name\": \"grain\", " + block + "}"), folder_ / "", mistakes);
    complaint_ = mistakes.text();
    return scene;
  }
  std::string complaint(const std::string& block) {
    EXPECT_FALSE(read(block));
    // The folder's name is another one each time.
    std::string text = complaint_;
    for (std::size_t at; (at = text.find(folder_ / "")) != text.npos;)
      text.erase(at, (folder_ / "").size());
    return text;
  }
  void write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  template <class Number>
  static std::string bytes_of(const std::vector<Number>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
  }
  template <class Number>
  void write_numbers(const std::string& name, const std::vector<Number>& numbers) {
    write(name, bytes_of(numbers));
  }

  TemporaryFolder folder_;
  std::string complaint_;
};

TEST_F(Particles, give_the_picture_of_the_same_objects_bit_for_bit) {
  const std::string shape = std::string(box) + ", ";
  Mistakes mistakes("x.json");
  const auto objects = parse_scene(
      scene_text("{\"name\": \"a\", \"material\": \"red\", " + shape +
                     R"("transform": {"translate": [1, 0, 0.5], "rotate": [0.1, 0.2, 0.3, 0.9],
                        "scale": [1, 2, 3]}}, {"name": "b", "material": "blue", )" +
                     shape +
                     R"("transform": {"translate": [-1, 0.25, 0], "rotate": [1, 1, 0, 4],
                        "scale": [1, 1, 0.5]}})",
                 ""),
      ".", mistakes);
  ASSERT_TRUE(objects) << mistakes.text();
  const auto particles = read(shape + R"("columns": ["rotation", "material", "position", "scales"],
    "materials": ["red", "blue"],
    "poses": [[0.1, 0.2, 0.3, 0.9, 0, 1, 0, 0.5, 1, 2, 3],
              [1, 1, 0, 4, 1, -1, 0.25, 0, 1, 1, 0.5]])");
  ASSERT_TRUE(particles) << complaint_;
  EXPECT_EQ(instance_count(*particles), 2u);
  EXPECT_EQ(instance_object(*particles, 1).name, "grain[1]");
  RenderOptions options;
  options.resolution = objects->camera.resolution;
  options.samples = 2;
  const Rendering a = render(*objects, make_world(*objects), options);
  const Rendering b = render(*particles, make_world(*particles), options);
  EXPECT_EQ(a.met, b.met);
  EXPECT_GT(std::count_if(a.met.begin(), a.met.end(), [](auto n) { return n > 0; }), 15);
  for (std::size_t i = 0; i < a.image.pixels.size(); ++i)
    ASSERT_EQ(a.image.pixels[i], b.image.pixels[i]);
}

TEST_F(Particles, all_kinds_of_files_say_the_same) {
  const std::vector<float> floats = {1, 2, 3, 0.5f, -4, 5, -6.25f, 2};
  write_numbers("p.f32", floats);
  write_numbers("p.f64", std::vector<double>(floats.begin(), floats.end()));
  write("p.csv", "# x, y, z, scale\n 1,2,3,0.5\r\n\n-4 +5\t-625e-2 , 2");
  write("marked.csv", "\xEF\xBB\xBF# x, y, z, scale\n1,2,3,0.5\n-4,5,-6.25,2\n");
  for (const char* file : {"p.f32", "p.f64", "p.csv", "marked.csv"}) {
    const auto scene = read(std::string(box) + R"(, "material": "red", "columns": ["position",
      "scale"], "count": 2, "file": ")" +
                            file + "\"");
    ASSERT_TRUE(scene) << complaint_;
    const ParticleSet& set = scene->particles[0];
    ASSERT_EQ(set.size(), 2u);
    EXPECT_EQ(set.pose(0).translation, Vec3<double>(1, 2, 3));
    EXPECT_EQ(set.pose(0).linear, Mat3<double>(Mat3<double>::Identity() * 0.5));
    EXPECT_EQ(set.pose(1).translation, Vec3<double>(-4, 5, -6.25));
    EXPECT_EQ(set.bytes(), 2 * 4 * sizeof(double));
  }
}

// Blocks of files end anywhere: in numbers, in lines, between "\r" and "\n".
TEST_F(Particles, long_files_are_read_as_short_ones) {
  std::string text;
  std::vector<double> numbers;
  for (int i = 0; i < 120000; ++i) {
    for (const double number : {i * 0.25, -i * 1.0, i / 1024.0}) numbers.push_back(number);
    text += std::to_string(i * 0.25) + "," + std::to_string(-i) + "  ";
    char digits[32];
    text += std::string(digits, std::to_chars(digits, digits + 32, i / 1024.0).ptr) + "\r\n";
  }
  write("p.csv", text);
  write_numbers("p.f64", numbers);
  for (const char* file : {"p.csv", "p.f64"}) {
    const auto scene = read(std::string(box) + R"(, "material": "red", "file": ")" + file + "\"");
    ASSERT_TRUE(scene) << complaint_;
    EXPECT_EQ(scene->particles[0].poses, numbers);
  }
}

TEST_F(Particles, mistakes_are_told_with_file_and_row) {
  struct Row {
    std::string file, bytes, keys, message;
  };
  const Row rows[] = {
      {"empty.f64", "", "", "must hold at least one row (got none)"},
      {"short.f64", bytes_of<double>({1, 2, 3, 4}), "",
       "row 2: is truncated (got 8 of its 24 bytes)"},
      {"two.f64", bytes_of<double>({1, 2, 3, 4, 5, 6}), "\"count\": 3, ",
       "must hold 3 rows, as \"count\" says (got 2)"},
      {"nan.f32", bytes_of<float>({1, 2, 3, 4, NAN, 6}), "",
       "row 2: position must be finite (got 4 nan 6)"},
      {"zero.f64", bytes_of<double>({1, 2, 3, 0, 0, 0, 0}),
       R"("columns": ["position", "rotation"], )",
       "row 1: rotation must not be zero (got 0 0 0 0)"},
      {"flat.csv", "1 2 3 1\n# a comment\n1 2 3 0\n", R"("columns": ["position", "scale"], )",
       "line 3: scale must not be zero, nor beyond 1e-100 to 1e100 (got 0)"},
      {"head.csv", "x,y,z\n1,2,3\n", "",
       "line 1: position must be a number that a double can hold (got \"x\"); lines of other text "
       "begin with #"},
      {"few.csv", "1,2,3\n1,2\n", "", "line 2: must hold 3 numbers (got 2)"},
      {"many.csv", "1,2,3,4\n", "", "line 1: must hold 3 numbers (got more)"},
      {"infinite.csv", "1,2,inf\n", "", "line 1: position must be finite (got 1 2 inf)"},
      {"long.csv", std::string(3 << 20, '1'), "", "line 1: must not be longer than 65536 bytes"}};
  const auto error_text = [&](const std::string& file, const std::string& keys = "") {
    return complaint(std::string(box) + R"(, "material": "red", )" + keys + "\"file\": \"" + file +
                     "\"");
  };
  const std::string at = "x.json: /particles/0/file: ";
  for (const auto& [file, bytes, keys, message] : rows) {
    write(file, bytes);
    EXPECT_EQ(error_text(file, keys), at + file + ": " + message);
  }
  EXPECT_EQ(error_text("none.csv"), at + "none.csv: cannot be read: No such file or directory");
  for (const std::string file : {"p.txt", "../"})
    EXPECT_EQ(error_text(file), at + file + ": its name must end in .csv, .f32 or .f64");
  std::filesystem::create_directory(folder_ / "folder.csv");
  EXPECT_EQ(error_text("folder.csv"), at + "folder.csv: must be a file (got a directory)");
}

TEST_F(Particles, mistakes_in_the_block_are_told_with_their_places) {
  const std::string one = R"("poses": [[1, 2, 3]])", red = R"("material": "red", )";
  const std::pair<std::string, std::string> rows[] = {
      {red + R"("poses": [])",
       "/poses: must be a list of at least one row and at most 1073741824 rows (got a list of 0)"},
      {red + R"("poses": [[1, 2, 3], [1, 2]])",
       "/poses/1: must be a list of 3 numbers (got a list of 2)"},
      {red + R"("columns": ["position", "rotatoin"], )" + one,
       "/columns/1: must be the name of a column (got \"rotatoin\"; did you mean \"rotation\"?)"},
      {red + R"("columns": ["position", "position"], )" + one,
       "/columns/1: duplicate (got \"position\" again)"},
      {one + R"(, "material": "rde")",
       "/material: must be the name of a material (got \"rde\"; did you mean \"red\"?)"},
      {R"("columns": ["position", "material"], "materials": ["red"], "poses": [[1, 2, 3, 1]])",
       "/poses/0: material must be an index of the block's materials (got 1)"},
      {red + R"("file": "p.csv", )" + one, ": must have either \"poses\" or \"file\" (got both)"},
      {red + R"("count": 2, )" + one,
       "/poses: must be a list of 2 rows, as \"count\" says (got a list of 1)"}};
  for (const auto& [keys, message] : rows)
    EXPECT_EQ(complaint(std::string(box) + ", " + keys), "x.json: /particles/0" + message);
}

// Pictures in shares are of one scene only if they are of the same poses.
TEST_F(Particles, the_scenes_hash_is_also_that_of_its_files) {
  const std::string block = std::string(box) + R"(, "material": "red", "file": "p.f64")";
  write_numbers("p.f64", std::vector<double>{1, 2, 3});
  const auto before = read(block);
  write_numbers("p.f64", std::vector<double>{1, 2, 4});
  const auto after = read(block);
  ASSERT_TRUE(before && after);
  EXPECT_NE(before->hash, after->hash);
}

}  // namespace
}  // namespace minkray
