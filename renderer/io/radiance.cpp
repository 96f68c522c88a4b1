// SPDX-License-Identifier: MIT
#include "renderer/io/radiance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/files/text.h"

namespace minkray {
namespace {

using Rgbe = std::array<unsigned char, 4>;

/// Rows so narrow or so wide are never run-length encoded.
constexpr int least_encoded = 8, most_encoded = 32767;
/// Bytes beyond this start a run, and hold its length; others hold the number of bytes that
/// follow.
constexpr int run = 128, longest_run = 127;

class RadianceReader {
 public:
  RadianceReader(std::string_view bytes, std::int64_t most_pixels)
      : rest_(bytes), most_pixels_(most_pixels) {}

  Image read() {
    read_header();
    read_size();
    check_image_size(width_, height_, most_pixels_);
    check_length();
    Image image(width_, height_);
    std::vector<Rgbe> row(static_cast<std::size_t>(width_));
    for (row_ = 0; row_ < height_; ++row_) {
      read_row(row);
      for (int x = 0; x < width_; ++x) image.at(x, row_) = linear(row[static_cast<std::size_t>(x)]);
    }
    return image;
  }

 private:
  [[noreturn]] static void wrong(const std::string& what) {
    throw std::runtime_error("cannot be read: " + what);
  }
  [[noreturn]] void cut_off() const {
    wrong("ends in row " + std::to_string(row_) + " of " + std::to_string(height_));
  }

  std::string_view line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) wrong("must have a header that ends with an empty line");
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return text;
  }

  void read_header() {
    const std::string_view name = line();
    if (name != "#?RADIANCE" && name != "#?RGBE") wrong("must begin with #?RADIANCE");
    bool is_rgbe = false;
    for (std::string_view text = line(); !text.empty(); text = line())
      is_rgbe |= text == "FORMAT=32-bit_rle_rgbe";
    if (!is_rgbe) wrong("must have FORMAT=32-bit_rle_rgbe in its header");
  }

  /// The number behind a name; advances the text to its end.
  static int number_after(std::string_view name, std::string_view& text) {
    int number = 0;
    if (text.starts_with(name)) {
      text.remove_prefix(name.size());
      if (take_number(text, number) && number >= 0) return number;
    }
    wrong("must give its size as -Y HEIGHT +X WIDTH: rows from the top, each from the left");
  }
  void read_size() {
    std::string_view text = line();
    height_ = number_after("-Y ", text);
    width_ = number_after(" +X ", text);
  }

  /// Prevents allocating memory for pixels that the file cannot hold.
  void check_length() const {
    const std::size_t width = static_cast<std::size_t>(width_), plain = sizeof(Rgbe) * width;
    const std::size_t encoded = sizeof(Rgbe) * (1 + 2 * ((width + longest_run - 1) / longest_run));
    if (rest_.size() / static_cast<std::size_t>(height_) < std::min(plain, encoded))
      wrong("is too short for " + std::to_string(width_) + " x " + std::to_string(height_) +
            " pixels");
  }

  unsigned char byte() {
    if (rest_.empty()) cut_off();
    const auto first = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return first;
  }
  Rgbe pixel() { return {byte(), byte(), byte(), byte()}; }

  void read_row(std::vector<Rgbe>& row) {
    row[0] = pixel();
    const bool is_encoded = width_ >= least_encoded && width_ <= most_encoded && row[0][0] == 2 &&
                            row[0][1] == 2 && row[0][2] < run;
    if (is_encoded) {
      if (row[0][2] * 256 + row[0][3] != width_)
        wrong("row " + std::to_string(row_) + " must have " + std::to_string(width_) + " pixels");
      for (std::size_t part = 0; part < 4; ++part) read_encoded(row, part);
      return;
    }
    for (std::size_t x = 1; x < row.size(); ++x) row[x] = pixel();
    // The way of before 1991: a pixel of three ones repeats the one before it.
    for (const Rgbe& one : row)
      if (one[0] == 1 && one[1] == 1 && one[2] == 1)
        wrong("row " + std::to_string(row_) + " has runs of an old kind");
  }

  void read_encoded(std::vector<Rgbe>& row, std::size_t part) {
    for (std::size_t x = 0; x < row.size();) {
      const int head = byte();
      const bool is_run = head > run;
      const auto count = static_cast<std::size_t>(is_run ? head - run : head);
      if (count > row.size() - x)
        wrong("row " + std::to_string(row_) + " has a run beyond its end");
      if (is_run) {
        const unsigned char value = byte();
        for (std::size_t i = 0; i < count; ++i) row[x++][part] = value;
      } else {
        for (std::size_t i = 0; i < count; ++i) row[x++][part] = byte();
      }
    }
  }

  static Vec3<float> linear(const Rgbe& pixel) {
    if (pixel[3] == 0) return Vec3<float>::Zero();
    constexpr int bias = 128 + 8;  // of the exponent, and the numbers are 256ths
    const float scale = std::ldexp(1.0F, pixel[3] - bias);
    return {static_cast<float>(pixel[0]) * scale, static_cast<float>(pixel[1]) * scale,
            static_cast<float>(pixel[2]) * scale};
  }

  std::string_view rest_;
  std::int64_t most_pixels_;
  int width_ = 0, height_ = 0, row_ = 0;
};

}  // namespace

Image read_radiance(std::string_view bytes, std::int64_t most_pixels) {
  return RadianceReader(bytes, most_pixels).read();
}

}  // namespace minkray
