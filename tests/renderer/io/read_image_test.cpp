// SPDX-License-Identifier: MIT
// PNG files with chunks of no pixels, which are allowed: they are the same picture, and where they
// are all there is it is told. stb_image copies the first of them to a null pointer, found by the
// fuzz target `image`.
#include "renderer/io/read_image.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/io/png.h"
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
    try {
      read(bytes);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
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

}  // namespace
}  // namespace minkray
