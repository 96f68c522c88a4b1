// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "renderer/base/errors.h"
#include "renderer/image/colour.h"
#include "renderer/image/text.h"
#include "renderer/io/image_file.h"
#include "renderer/io/output_file.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace minkray {
namespace {

namespace fs = std::filesystem;

class Output : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }
  std::size_t file_count() const { return folder_.files().size(); }
  static std::string content(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static std::vector<unsigned char> bytes(const std::string& text) {
    return {text.begin(), text.end()};
  }

  TemporaryFolder folder_;
};

TEST(ImageFile, png_there_and_back) {
  Image image(37, 11);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = {static_cast<float>(x) / 36, static_cast<float>(y) / 10, 1.5f};
  const auto encoded = encode_image(image, "x.png");
  int width = 0, height = 0, channels = 0;
  unsigned char* decoded = stbi_load_from_memory(encoded.data(), static_cast<int>(encoded.size()),
                                                 &width, &height, &channels, 3);
  ASSERT_NE(decoded, nullptr);
  ASSERT_EQ(width, 37);
  ASSERT_EQ(height, 11);
  EXPECT_EQ(channels, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(decoded[(y * width + x) * 3 + c],
                  to_srgb8(static_cast<double>(image.at(x, y)[c])));
  stbi_image_free(decoded);
}

TEST(ImageFile, pfm_keeps_the_numbers_rows_from_the_bottom) {
  Image image(2, 2);
  image.at(0, 0) = {1, 2, 3};
  image.at(1, 1) = {-4, 1e10f, 6e-30f};
  const auto encoded = encode_image(image, "x.pfm");
  const std::string header = "PF\n2 2\n-1.0\n";
  ASSERT_EQ(encoded.size(), header.size() + 48);
  EXPECT_EQ(std::string(encoded.begin(), encoded.begin() + std::ssize(header)), header);
  float numbers[12];
  std::memcpy(numbers, encoded.data() + header.size(), sizeof numbers);
  EXPECT_EQ(numbers[3], -4.0f);
  EXPECT_EQ(numbers[4], 1e10f);
  EXPECT_EQ(numbers[5], 6e-30f);
  EXPECT_EQ(numbers[6], 1.0f);
}

TEST(ImageFile, formats_by_extension) {
  EXPECT_TRUE(is_image_path("a/b.png"));
  EXPECT_TRUE(keeps_floats("b.pfm"));
  EXPECT_FALSE(keeps_floats("b.png"));
  for (const char* path : {"", "png", ".png", "a.jpg", "a.png.txt"})
    EXPECT_FALSE(is_image_path(path));
}

TEST_F(Output, replaces_files_and_leaves_nothing_beside_them) {
  write_file(path("a"), bytes("first"));
  EXPECT_EQ(content(path("a")), "first");
  ::chmod(path("a").c_str(), 0640);
  check_writable(path("a"));
  EXPECT_EQ(content(path("a")), "first");
  write_file(path("a"), bytes("second"));
  EXPECT_EQ(content(path("a")), "second");
  EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms(0640));
  EXPECT_EQ(file_count(), 1u);
}

// Processes in two containers may have one number: until now each removed the other's file.
TEST_F(Output, nobody_elses_file_is_touched) {
  const std::string foreign = path(".a." + std::to_string(::getpid()) + ".tmp");
  std::ofstream(foreign) << "another's";
  write_file(path("a"), bytes("ours"));
  check_writable(path("a"));
  EXPECT_EQ(content(foreign), "another's");
  EXPECT_EQ(content(path("a")), "ours");
  EXPECT_EQ(file_count(), 2u);
}

TEST_F(Output, of_two_that_write_one_file_the_last_wins) {
  OutputFile first(path("a")), second(path("a"));
  EXPECT_EQ(file_count(), 2u);
  first.write(bytes("first "));
  second.write(bytes("second"));
  first.write(bytes("and last"));
  second.finish();
  EXPECT_EQ(content(path("a")), "second");
  first.finish();
  EXPECT_EQ(content(path("a")), "first and last");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(Output, a_link_stays_a_link) {
  write_file(path("target"), bytes("first"));
  fs::create_symlink("target", path("link"));
  write_file(path("link"), bytes("second"));
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content(path("target")), "second");
  EXPECT_EQ(file_count(), 2u);
}

TEST_F(Output, devices_are_written_to_and_not_replaced) {
  check_writable("/dev/null");
  write_file("/dev/null", bytes("x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Output, tells_early_and_clearly_what_cannot_be_written) {
  for (const std::string& target :
       {path("missing/a.png"), folder_.path().string(), folder_.path().string() + "/",
        std::string(), std::string("/proc/a.png"), path(std::string(300, 'a'))}) {
    const std::string message = message_of<CannotWrite>([&] { check_writable(target); });
    EXPECT_NE(message, "") << target;
    EXPECT_TRUE(has(message, target));
    EXPECT_THROW(write_file(target, bytes("x")), CannotWrite) << target;
  }
  EXPECT_EQ(file_count(), 0u);
}

TEST(Text, stays_within_its_size_and_the_image) {
  Image image(60, 20);
  draw_text(image, 4, 4, "Ag|\xff\x01", Vec3<float>::Ones());
  const TextSize size = text_size("Ag|");
  double ink = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      ink += static_cast<double>(image.at(x, y).x());
      const bool outside = x < 4 || y < 4 || x > 4 + size.width || y > 4 + size.height + 2;
      EXPECT_FALSE(outside && image.at(x, y).x() > 0) << x << " " << y;
    }
  EXPECT_GT(ink, 15);
  draw_text(image, -1e30, 1e30, "far", Vec3<float>::Ones());
  draw_text(image, 55, -3, "over the edge", Vec3<float>::Ones());
}

TEST(Text, rectangles_cover_pixels_by_area) {
  Image image(3, 3);
  fill_rectangle(image, 0.5, 1, 2.25, 1.5, Vec3<float>::Ones());
  EXPECT_FLOAT_EQ(image.at(0, 1).x(), 0.25f);
  EXPECT_FLOAT_EQ(image.at(1, 1).x(), 0.5f);
  EXPECT_FLOAT_EQ(image.at(2, 1).x(), 0.125f);
  EXPECT_FLOAT_EQ(image.at(1, 0).x(), 0.0f);
}

}  // namespace
}  // namespace minkray
