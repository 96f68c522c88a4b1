// SPDX-License-Identifier: MIT
#include "renderer/io/exr.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "renderer/base/errors.h"
#include "renderer/io/exr_header.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

ExrImage small_image() {
  const float infinity = std::numeric_limits<float>::infinity();
  return {{0, 0, 100, 50},
          {10, 20, 13, 22},
          {{"B", std::vector<float>{1, -2, 3e-40f, infinity, 0, 1e38f}},
           {"id", std::vector<std::uint32_t>{0, 1, 2, 4294967295u, 4, 5}}},
          {{"minkray.command", "minkray render 'a b'"}, {"minkray.seed", "18446744073709551615"}}};
}

std::string_view text_of(const std::vector<unsigned char>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(Exr, halfs_have_eleven_bits) {
  ExrImage image = small_image();
  image.planes[0].values = std::vector<float>{1, -2.5f, 2049, 65504, 1e6f, 0x1p-24f};
  image.planes[0].is_half = image.planes[1].is_half = true;  // whole numbers stay what they are
  const ExrImage again = decode_exr(text_of(encode_exr(image)), "x.exr");
  EXPECT_EQ(std::get<std::vector<float>>(again.find("B")->values),
            (std::vector<float>{1, -2.5f, 2048, 65504, std::numeric_limits<float>::infinity(),
                                0x1p-24f}));
  EXPECT_EQ(again.find("id")->values, image.planes[1].values);
}

TEST(Exr, there_and_back_to_the_last_bit) {
  const ExrImage image = small_image();
  const ExrImage again = decode_exr(text_of(encode_exr(image)), "x.exr");
  EXPECT_EQ(again.display, image.display);
  EXPECT_EQ(again.window, image.window);
  ASSERT_EQ(again.planes.size(), image.planes.size());
  for (const ExrPlane& plane : image.planes) {
    ASSERT_NE(again.find(plane.name), nullptr) << plane.name;
    EXPECT_EQ(again.find(plane.name)->values, plane.values) << plane.name;
  }
  for (const auto& [name, text] : image.texts) EXPECT_EQ(again.texts.at(name), text);
  EXPECT_EQ(again.find("R"), nullptr);
}

TEST(Exr, the_same_image_gives_the_same_bytes) {
  EXPECT_EQ(encode_exr(small_image()), encode_exr(small_image()));
}

std::string refusal_of(std::string_view file) {
  return message_of<BadInput>([&] { decode_exr(file, "x.exr"); });
}

// Whatever a disk or a network makes of a file: an error, never a crash or endless memory.
TEST(Exr, damaged_files_are_errors_that_name_the_file) {
  const std::vector<unsigned char> bytes = encode_exr(small_image());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_TRUE(refusal_of(text_of(bytes).substr(0, length)).starts_with("x.exr: ")) << length;
  }
  int refused = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<unsigned char> damaged = bytes;
    damaged[i] ^= 0xff;
    refused += !refusal_of(text_of(damaged)).empty();
  }
  EXPECT_GT(refused, 100);  // texts, and a picture's numbers, may be anything
}

// Headers alone are read by another path, which reads no more of the file.
TEST(Exr, so_are_files_whose_header_is_damaged) {
  const TemporaryFolder folder;
  const std::string file = folder / "x.exr";
  const std::vector<unsigned char> bytes = encode_exr(small_image());
  const auto is_refused = [&](std::string_view damaged) {
    std::ofstream(file, std::ios::binary) << damaged;
    const std::string message = message_of<BadInput>([&] { read_exr_texts(file); });
    EXPECT_TRUE(message.empty() || message.starts_with(file + ": ")) << message;
    return !message.empty();
  };
  EXPECT_FALSE(is_refused(text_of(bytes)));
  EXPECT_EQ(read_exr_texts(file).at("minkray.command"), "minkray render 'a b'");
  for (std::size_t length = 0; length < 300; ++length)
    EXPECT_TRUE(is_refused(text_of(bytes).substr(0, length))) << length;
  int refused = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<unsigned char> damaged = bytes;
    damaged[i] ^= 0xff;
    refused += is_refused(text_of(damaged));
  }
  EXPECT_GT(refused, 50);
}

// The library reads such values by their type: behind them it would find another header than we do.
TEST(Exr, attributes_that_end_where_they_do_not_say_are_refused) {
  const std::string whole(text_of(encode_exr(small_image())));
  const auto holds = [](std::string_view left) {
    return has_whole_exr_attributes([&](std::span<char> buffer) {
      if (left.size() < buffer.size()) return false;
      std::ranges::copy(left.substr(0, buffer.size()), buffer.begin());
      left.remove_prefix(buffer.size());
      return true;
    });
  };
  ASSERT_TRUE(holds(whole));
  using namespace std::string_view_literals;
  for (const std::string_view type : {"\0chlist\0"sv, "\0compression\0"sv, "\0box2i\0"sv,
                                      "\0float\0"sv, "\0v2f\0"sv, "\0lineOrder\0"sv}) {
    const std::size_t length = whole.rfind(type) + type.size();
    ASSERT_NE(whole.rfind(type), std::string::npos) << type;
    const std::size_t end = length + 4 + static_cast<unsigned char>(whole[length]);
    std::string longer = whole;
    ++longer[length];
    longer.insert(end, 1, '\0');
    EXPECT_FALSE(holds(longer)) << type;
  }
}

void append_text(std::string& file, std::string_view text) {
  file += text;
  file += '\0';
}
void append_number(std::string& file, std::uint32_t number) {
  for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(number >> shift & 0xff);
}
void append_attribute(std::string& file, std::string_view name, std::string_view type,
                      std::string_view value) {
  append_text(file, name);
  append_text(file, type);
  append_number(file, static_cast<std::uint32_t>(value.size()));
  file += value;
}

/// Header of a picture one pixel wide, of half numbers; its table of offsets is missing.
std::string header_of_column(std::uint32_t flags, int channels, std::uint32_t lines,
                             std::string_view type) {
  std::string file = "\x76\x2f\x31\x01", list, window;
  append_number(file, 2 | flags);
  for (int i = 0; i < channels; ++i) {
    append_text(list,
                std::string{char('A' + i / 26 % 26), char('A' + i % 26), char('A' + i / 676)});
    for (const std::uint32_t number : {1u, 0u, 1u, 1u}) append_number(list, number);
  }
  list += '\0';
  for (const std::uint32_t number : {0u, 0u, 0u, lines - 1}) append_number(window, number);
  std::string zero, one;
  append_number(zero, 0);
  append_number(one, 0x3f800000);
  append_attribute(file, "channels", "chlist", list);
  append_attribute(file, "compression", "compression", {"\2", 1});
  append_attribute(file, "dataWindow", "box2i", window);
  append_attribute(file, "displayWindow", "box2i", window);
  append_attribute(file, "lineOrder", "lineOrder", {"\0", 1});
  append_attribute(file, "pixelAspectRatio", "float", one);
  append_attribute(file, "screenWindowCenter", "v2f", zero + zero);
  append_attribute(file, "screenWindowWidth", "float", one);
  if (!type.empty()) append_attribute(file, "type", "string", type);
  return file + '\0';
}

// Headers of a few bytes for which the library would spend memory or time.
TEST(Exr, headers_that_promise_more_than_a_file_holds_are_refused) {
  const auto says = [](const std::string& refusal, std::string_view what) {
    EXPECT_TRUE(refusal.ends_with(what)) << refusal << "\nwhere it should be said: " << what;
  };
  says(refusal_of(header_of_column(0x800, 2, 1 << 25, "deepscanline")), "deep images are not read");
  says(refusal_of(header_of_column(0x800, 2, 4, "")), "deep images are not read");
  says(refusal_of(header_of_column(0, 2600, 1536000, "")), "the file ends too early");
  says(refusal_of(header_of_column(0, 4097, 1, "")), "it has too many channels");
  // The library reads on at the fifth byte of the value.
  std::string shifted = "\x76\x2f\x31\x01";
  append_number(shifted, 2);
  append_attribute(shifted, "v", "floatvector", std::string_view("\0\0\0\0a", 6));
  says(refusal_of(shifted + '\0'), "an attribute of it ends where it should not");
  std::string manifest = "\x76\x2f\x31\x01";
  append_number(manifest, 2);
  append_attribute(manifest, "m", "idmanifest", std::string_view("\0\0\0\0\0\0\0\0", 8));
  says(refusal_of(manifest + '\0'), "an attribute of it ends where it should not");
}

}  // namespace
}  // namespace minkray
