// SPDX-License-Identifier: MIT
#include "renderer/io/terminal_picture.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace minkray {
namespace {

/// White above, red below.
Image two_rows() {
  Image image(2, 2, Vec3<float>(1, 1, 1));
  image.at(0, 1) = image.at(1, 1) = Vec3<float>(1, 0, 0);
  return image;
}

TEST(TerminalPicture, half_blocks_show_two_rows_of_pixels_a_line) {
  const std::string white_on_red = "\x1b[38;2;255;255;255m\x1b[48;2;255;0;0m\xe2\x96\x80";
  EXPECT_EQ(terminal_picture(two_rows(), TerminalGraphics::blocks, 80),
            white_on_red + white_on_red + "\x1b[0m\n");
}

TEST(TerminalPicture, wide_pictures_are_shrunk_to_the_columns_by_the_mean_of_their_light) {
  Image image(4, 2);
  image.at(0, 0) = image.at(1, 1) = image.at(2, 0) = image.at(3, 1) = Vec3<float>(1, 1, 1);
  const std::string shown = terminal_picture(image, TerminalGraphics::blocks, 2);
  // Half the light is the code 188 of sRGB.
  EXPECT_EQ(shown, "\x1b[38;2;188;188;188m\xe2\x96\x80\x1b[38;2;188;188;188m\xe2\x96\x80\x1b[0m\n");
}

TEST(TerminalPicture, sixels_of_one_colour_are_one_run_a_band) {
  const Image red(5, 6, Vec3<float>(1, 0, 0));
  const std::string shown = terminal_picture(red, TerminalGraphics::sixel, 80);
  EXPECT_TRUE(shown.starts_with("\x1bPq\"1;1;5;6#0;2;0;0;0"));
  EXPECT_TRUE(shown.ends_with("#180!5~$-\x1b\\\n")) << shown.substr(shown.size() - 20);
}

TEST(TerminalPicture, kitty_gets_a_png_file_in_chunks) {
  Image noise(96, 96);
  std::uint32_t state = 1;
  for (Vec3<float>& pixel : noise.pixels)
    for (int channel = 0; channel < 3; ++channel) {
      state = state * 1664525 + 1013904223;
      pixel[channel] = static_cast<float>(state >> 24) / 255;
    }
  const std::string shown = terminal_picture(noise, TerminalGraphics::kitty, 80);
  EXPECT_TRUE(shown.starts_with("\x1b_Gf=100,a=T,q=2,c=11,m=1;iVBORw0KGgo"));  // PNG's signature
  for (std::size_t begin = 0; begin < shown.size() - 1;) {
    const std::size_t end = shown.find("\x1b\\", begin);
    ASSERT_NE(end, std::string::npos);
    const std::size_t data = shown.find(';', begin) + 1;
    EXPECT_LE(end - data, 4096u);
    const bool is_last = end + 3 == shown.size();
    EXPECT_EQ(shown[data - 2], is_last ? '0' : '1');
    EXPECT_EQ((end - data) % 4, 0u);
    begin = end + 2;
  }
}

}  // namespace
}  // namespace minkray
