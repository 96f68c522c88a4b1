// SPDX-License-Identifier: MIT
// Pictures in Radiance's format, of rows that are written here: plain ones and encoded ones are
// the same pixels, and cut or damaged ones are reported. stb_image 2.27 did not end at the end of
// an encoded row that was cut off, found by the fuzz target `image`; for plain ones it read
// uninitialised memory.
#include "renderer/io/radiance.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace minkray {
namespace {

std::string header(int width, int height) {
  return "#?RADIANCE\n# by a program\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n\n-Y " +
         std::to_string(height) + " +X " + std::to_string(width) + "\n";
}

/// Four bytes per pixel.
std::string random_row(int width, std::mt19937& random) {
  std::string row;
  // Few values, so that there are runs; the first is never taken for an encoded row's.
  for (int i = 0; i < 4 * width; ++i) row += static_cast<char>(128 + random() % 3);
  return row;
}

/// Runs, and what is between them, in pieces of any length; sometimes of none.
std::string encoded(const std::string& row, std::mt19937& random) {
  const std::size_t width = row.size() / 4;
  std::string text = {2, 2, static_cast<char>(width >> 8), static_cast<char>(width & 255)};
  for (std::size_t part = 0; part < 4; ++part) {
    for (std::size_t x = 0; x < width;) {
      const auto at = [&](std::size_t i) { return row[4 * i + part]; };
      const std::size_t most = std::min<std::size_t>(width - x, 1 + random() % 127);
      std::size_t same = 1;
      while (same < most && at(x + same) == at(x)) ++same;
      if (random() % 8 == 0) text += '\0';
      if (same > 1) {
        text += static_cast<char>(128 + same);
        text += at(x);
        x += same;
      } else {
        text += static_cast<char>(most);
        for (std::size_t i = 0; i < most; ++i) text += at(x++);
      }
    }
  }
  return text;
}

std::string complaint(const std::string& bytes) {
  return message_of<std::runtime_error>([&] { read_radiance(bytes); });
}

TEST(Radiance, numbers_share_an_exponent) {
  const Image image =
      read_radiance(header(2, 1) + "\x80\x40\x20\x81" + std::string("\x80\x80\x80\0", 4));
  EXPECT_EQ(image.at(0, 0), Vec3<float>(1, 0.5F, 0.25F));
  EXPECT_EQ(image.at(1, 0), Vec3<float>(0, 0, 0));
}

TEST(Radiance, rows_are_the_same_plain_and_encoded) {
  std::mt19937 random(7);
  for (const int width : {8, 9, 127, 128, 129, 300, 32767}) {
    const int height = 3;
    std::string plain = header(width, height), runs = plain, mixed = plain;
    std::string pixels;
    for (int y = 0; y < height; ++y) {
      const std::string row = random_row(width, random), packed = encoded(row, random);
      plain += row;
      runs += packed;
      mixed += y == 1 ? row : packed;
      pixels += row;
    }
    for (const std::string& bytes : {plain, runs, mixed}) {
      const Image image = read_radiance(bytes);
      ASSERT_EQ(image.width, width);
      ASSERT_EQ(image.height, height);
      for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
          const auto part = [&](std::size_t j) {
            return static_cast<unsigned char>(pixels[4 * i + j]);
          };
          ASSERT_EQ(image.pixels[i][static_cast<int>(k)], std::exp2(part(3) - 128) * part(k) / 256)
              << "pixel " << i << " of " << width << " a row";
        }
    }
  }
}

TEST(Radiance, what_is_cut_off_is_told) {
  std::mt19937 random(8);
  const std::string row = random_row(20, random);
  for (const std::string& bytes :
       {header(20, 2) + row + row, header(20, 2) + encoded(row, random) + encoded(row, random)}) {
    EXPECT_EQ(complaint(bytes), "");
    for (std::size_t size = 0; size < bytes.size(); ++size)
      ASSERT_TRUE(complaint(bytes.substr(0, size)).starts_with("cannot be read: ")) << size;
  }
}

TEST(Radiance, what_is_wrong_is_told) {
  const auto message = [](const std::string& bytes, std::string_view what) {
    EXPECT_TRUE(has(complaint(bytes), what));
  };
  message("P6\n2 2\n255\n", "must begin with #?RADIANCE");
  message("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd",
          "must have FORMAT=32-bit_rle_rgbe");
  for (const char* size :
       {"+Y 1 +X 1", "-Y 1 -X 1", "-Y 1", "-Y -1 +X 1", "-Y 99999999999 +X 1", ""})
    message("#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n" + std::string(size) + "\nabcd",
            "must give its size");
  message(header(0, 4), "must have pixels (got 0 x 4)");
  message(header(20000, 20000), "must have at most 2^27 pixels (got 20000 x 20000)");
  message(header(10000, 10000) + "abcd", "is too short for 10000 x 10000 pixels");
  // Rows of eight.
  const std::string of_eight("\x02\x02\x00\x08", 4), rest(40, '\x81');
  message(header(8, 1) + std::string("\x02\x02\x00\x09", 4) + rest, "row 0 must have 8 pixels");
  message(header(8, 1) + of_eight + "\x89" + rest, "row 0 has a run beyond its end");
  message(header(8, 1) + of_eight + "\x09" + rest, "row 0 has a run beyond its end");
  message(header(8, 1) + of_eight + std::string(40, '\0'), "ends in row 0 of 1");
  message(header(2, 1) + "\x80\x80\x80\x80\x01\x01\x01\x05", "runs of an old kind");
}

}  // namespace
}  // namespace minkray
