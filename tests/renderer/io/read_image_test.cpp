// SPDX-License-Identifier: MIT
// Files that stb_image does not read by itself. Chunks of no pixels are allowed in PNG files: they
// are the same picture, and a file of nothing else is an error; stb_image copies the first of them
// to a null pointer, found by the fuzz target `image`. Colours missing from a palette are black;
// stb_image read them from uninitialised memory.
#include "renderer/io/read_image.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/io/png.h"
#include "tests/support/expect_exit.h"
#include "tests/support/temporary_folder.h"

namespace minkray {
namespace {

/// A chunk of no bytes. Its CRC is that of its name alone.
const std::string empty_chunk("\0\0\0\0IDAT\x35\xaf\x06\x1e", 12);

class EmptyChunks : public ::testing::Test {
 protected:
  Image read(const std::string& bytes) const {
    return read_image(folder.write("picture.png", bytes));
  }

  std::string complaint(const std::string& bytes) const {
    return message_of<std::runtime_error>([&] { read(bytes); });
  }

  TemporaryFolder folder;
  std::string picture = [] {
    std::vector<std::uint8_t> rgb(3 * 5 * 4);
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<std::uint8_t>(4 * i);
    const std::vector<unsigned char> bytes = png_of(5, 4, rgb);
    return std::string(bytes.begin(), bytes.end());
  }();
  std::size_t data = picture.find("IDAT") - 4, end = picture.find("IEND") - 4;
};

TEST_F(EmptyChunks, around_the_pixels_change_nothing) {
  const Image plain = read(picture);
  ASSERT_EQ(plain.width, 5);
  ASSERT_EQ(plain.height, 4);
  std::string more = picture;
  more.insert(end, empty_chunk);
  more.insert(data, empty_chunk + empty_chunk);
  EXPECT_EQ(read(more).pixels, plain.pixels);
}

TEST_F(EmptyChunks, alone_are_no_picture) {
  const std::string none = picture.substr(0, data) + empty_chunk + picture.substr(end);
  EXPECT_NE(complaint(none), "");
}

TEST_F(EmptyChunks, of_a_file_that_is_cut_off) {
  std::string more = picture;
  more.insert(data, empty_chunk);
  for (std::size_t length = 0; length < data + 40; ++length)
    EXPECT_NE(complaint(more.substr(0, length)), "") << length;
}

/// A chunk, whose CRC is not checked.
std::string chunk(const std::string& name, const std::string& data) {
  return std::string(3, '\0') + static_cast<char>(data.size()) + name + data + "crc.";
}

/// A palette of one colour, and four pixels in one stored block of deflate.
std::string picture_of_palette(const std::string& palette, const std::string& indices) {
  const std::string size = {0, 0, 0, 4, 0, 0, 0, 1, 8, 3, 0, 0, 0};
  const std::string rows = std::string(1, '\0') + indices;  // of the first filter
  std::string block = {1, static_cast<char>(rows.size()), 0, static_cast<char>(~rows.size()),
                       '\xff'};
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", size) + chunk("PLTE", palette) +
         chunk("IDAT", "\x78\x01" + block + rows + "adle") + chunk("IEND", "");
}

TEST(Palettes, have_black_where_they_have_no_colour) {
  const TemporaryFolder folder;
  const std::string indices = {0, 1, '\x80', '\xff'};
  const Image image =
      read_image(folder.write("picture.png", picture_of_palette("\xff\xff\xff", indices)));
  const Vec3<float> white = {1, 1, 1}, black = {0, 0, 0};
  EXPECT_EQ(image.pixels, (std::vector<Vec3<float>>{white, black, black, black}));
}

TEST(Chunks, of_pixels_that_the_file_does_not_hold_are_refused_before_there_is_room_for_them) {
  const TemporaryFolder folder;
  const std::string whole = picture_of_palette("\xff\xff\xff", std::string(4, '\0'));
  const auto read = [&](const std::string& bytes) -> std::string {
    return message_of<std::runtime_error>([&] { read_image(folder.write("picture.png", bytes)); });
  };
  EXPECT_EQ(read(whole), "");
  const std::size_t name = whole.find("IDAT"), pixels = name + 4, checked = whole.find("IEND") - 8;
  std::string huge = whole;
  huge[name - 4] = '\x7a';  // the length's highest byte: 2 GB
  EXPECT_TRUE(has(read(huge), "cut off"));
  for (std::size_t length = pixels; length < checked; ++length)
    EXPECT_TRUE(has(read(whole.substr(0, length)), "cut off")) << length;
  // Data behind the end is ignored.
  EXPECT_EQ(read(whole + huge.substr(name - 4, 8)), "");
}

/// Six pictures of one colour, of 400 KB each, took 8 GB.
TEST_F(EmptyChunks, all_pictures_of_a_scene_have_a_limit_together) {
  const std::string file = folder.write("picture.png", picture);
  EXPECT_EQ(read_image(file, 20).width, 5);
  for (const std::int64_t left : {19, 0}) {
    EXPECT_EQ(message_of<std::runtime_error>([&] { read_image(file, left); }),
              "all pictures of a scene together must have at most 2^27 pixels (got 5 x 4, and "
              "those before it leave " +
                  std::to_string(left) + ")");
  }
}

/// The message was "no SOI", which is about JPEG files.
TEST_F(EmptyChunks, running_out_of_memory_says_so) {
  if (limited_memory().empty()) GTEST_SKIP() << "needs a limit of memory";
  constexpr int side = 6000;
  const std::vector<unsigned char> bytes =
      png_of(side, side, std::vector<std::uint8_t>(std::size_t{3} * side * side));
  folder.write("large.png", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const std::string scene = folder.write(
      "scene.json", R"({"version": 1, "camera": {"position": [0, -5, 1], "look_at": [0, 0, 0]},
    "lights": [{"type": "environment", "file": "large.png"}], "materials": [], "objects": []})");
  for (const char* kilobytes : {"200000", "500000"}) {
    expect_exit(
        3, run_shell("ulimit -v " + std::string(kilobytes) + "; $MINKRAY info '" + scene + "'"),
        {"large.png: not enough memory to read it"});
  }
}

}  // namespace
}  // namespace minkray
