// SPDX-License-Identifier: MIT
// stb_image 2.27 wrote up to 4 kB behind its tables for a JPEG file of some hundred bytes, found by
// the fuzz target `image`.
#include "renderer/io/jpeg_tables.h"

#include <gtest/gtest.h>

#include "tests/support/source_files.h"

namespace minkray {
namespace {

const std::string begin = "\xff\xd8";

/// A segment of one table with so many codes of 8 bits and of 9.
std::string table(int short_codes, int long_codes) {
  std::string counts(16, '\0');
  counts[7] = static_cast<char>(short_codes);
  counts[8] = static_cast<char>(long_codes);
  const std::string codes(static_cast<std::size_t>(short_codes + long_codes), 'x');
  const std::size_t length = 2 + 1 + counts.size() + codes.size();
  return std::string("\xff\xc4") + static_cast<char>(length >> 8) +
         static_cast<char>(length & 255) + '\0' + counts + codes;
}

/// A segment of any kind: what programs have to say, or a scan.
std::string segment(char marker, const std::string& text) {
  const std::size_t length = 2 + text.size();
  return std::string("\xff") + marker + static_cast<char>(length >> 8) +
         static_cast<char>(length & 255) + text;
}

TEST(JpegTables, of_pictures_can_be_used) {
  int count = 0;
  for (const SourceFile& file : files_in("tests/fuzz/corpus/image"))
    if (file.name.ends_with(".jpg")) {
      EXPECT_TRUE(has_usable_jpeg_tables(std::string_view(file.text).substr(1))) << file.name;
      ++count;
    }
  EXPECT_GE(count, 4);
}

TEST(JpegTables, of_more_than_256_codes_cannot) {
  EXPECT_TRUE(has_usable_jpeg_tables(begin + table(200, 56)));
  EXPECT_FALSE(has_usable_jpeg_tables(begin + table(200, 57)));
  EXPECT_FALSE(has_usable_jpeg_tables("\xff" + begin + "  \xff" + table(200, 57)));
  EXPECT_FALSE(has_usable_jpeg_tables(begin + table(10, 10) + table(255, 255)));
  EXPECT_FALSE(has_usable_jpeg_tables(begin + segment('\xda', "scan") + "data" + table(255, 2)));
}

TEST(JpegTables, are_not_looked_for_in_what_programs_say) {
  EXPECT_TRUE(has_usable_jpeg_tables(begin + segment('\xe1', table(200, 57)) + table(1, 1)));
  EXPECT_FALSE(has_usable_jpeg_tables(begin + segment('\xe1', "text") + table(200, 57)));
}

TEST(JpegTables, are_nothing_to_other_files) {
  EXPECT_TRUE(has_usable_jpeg_tables(""));
  EXPECT_TRUE(has_usable_jpeg_tables("\x89PNG" + table(200, 57)));
}

}  // namespace
}  // namespace minkray
