// SPDX-License-Identifier: MIT
// stb_image 2.27 wrote up to 4 kB behind its tables for a JPEG file of some hundred bytes, found by
// the fuzz target `image`; of 71 bytes it made 134 million pixels.
#include "renderer/io/jpeg_segments.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/fuzz/inputs.h"
#include "tests/support/messages.h"

namespace minkray {
namespace {

const std::string begin = "\xff\xd8";

/// A segment of one table with the given numbers of codes of 8 bits and of 9.
std::string table(int short_codes, int long_codes) {
  std::string counts(16, '\0');
  counts[7] = static_cast<char>(short_codes);
  counts[8] = static_cast<char>(long_codes);
  const std::string codes(static_cast<std::size_t>(short_codes + long_codes), 'x');
  const std::size_t length = 2 + 1 + counts.size() + codes.size();
  return std::string("\xff\xc4") + static_cast<char>(length >> 8) +
         static_cast<char>(length & 255) + '\0' + counts + codes;
}

/// A segment of any kind: data of applications, or a scan.
std::string segment(char marker, const std::string& text) {
  const std::size_t length = 2 + text.size();
  return std::string("\xff") + marker + static_cast<char>(length >> 8) +
         static_cast<char>(length & 255) + text;
}

bool is_refused(std::string_view bytes) {
  return !message_of<std::runtime_error>([&] { check_jpeg(bytes); }).empty();
}

/// A frame of one component, or of three with two that have every second pixel.
std::string frame(int width, int height, int components, char marker = '\xc0') {
  std::string text = {8,
                      static_cast<char>(height >> 8),
                      static_cast<char>(height & 255),
                      static_cast<char>(width >> 8),
                      static_cast<char>(width & 255),
                      static_cast<char>(components)};
  for (int i = 0; i < components; ++i) text += {static_cast<char>(i), i == 0 ? '\x22' : '\x11', 0};
  return segment(marker, text);
}

TEST(JpegTables, of_pictures_can_be_used) {
  int count = 0;
  for (const SourceFile& file : fuzz::kept_inputs("image", "corpus"))
    if (file.name.ends_with(".jpg")) {
      EXPECT_FALSE(is_refused(std::string_view(file.text).substr(1))) << file.name;
      ++count;
    }
  EXPECT_GE(count, 4);
}

TEST(JpegTables, of_more_than_256_codes_cannot) {
  EXPECT_FALSE(is_refused(begin + table(200, 56)));
  EXPECT_TRUE(is_refused(begin + table(200, 57)));
  EXPECT_TRUE(is_refused("\xff" + begin + "  \xff" + table(200, 57)));
  EXPECT_TRUE(is_refused(begin + table(10, 10) + table(255, 255)));
  EXPECT_TRUE(is_refused(begin + segment('\xda', "scan") + "data" + table(255, 2)));
}

TEST(JpegTables, are_not_looked_for_in_what_programs_say) {
  EXPECT_FALSE(is_refused(begin + segment('\xe1', table(200, 57)) + table(1, 1)));
  EXPECT_TRUE(is_refused(begin + segment('\xe1', "text") + table(200, 57)));
}

TEST(JpegTables, are_nothing_to_other_files) {
  EXPECT_FALSE(is_refused(""));
  EXPECT_FALSE(is_refused("\x89PNG" + table(200, 57)));
}

TEST(JpegPixels, are_as_many_as_bytes_can_tell) {
  const auto bytes = [](const std::string& frame, std::size_t size) {
    const std::string start = begin + frame + segment('\xda', "scan");
    return start + std::string(size - start.size(), 'x');
  };
  EXPECT_TRUE(is_refused(bytes(frame(11585, 11585, 1), 71)));
  // 80 by 80 blocks, and half of each side of two more: 9600 bits.
  EXPECT_FALSE(is_refused(bytes(frame(640, 640, 3), 1200)));
  EXPECT_TRUE(is_refused(bytes(frame(640, 640, 3), 1199)));
  EXPECT_TRUE(is_refused(bytes(frame(640, 640, 3, '\xc2'), 1199)));
  EXPECT_FALSE(is_refused(bytes(frame(7, 7, 1), 71)));
}

TEST(JpegScans, are_at_most_a_hundred) {
  std::string scans = begin + frame(8, 8, 1);
  for (int i = 0; i < 100; ++i) scans += segment('\xda', "scan") + "data";
  EXPECT_FALSE(is_refused(scans));
  EXPECT_TRUE(is_refused(scans + segment('\xda', "scan")));
}

}  // namespace
}  // namespace minkray
