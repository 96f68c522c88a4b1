// SPDX-License-Identifier: MIT
#include "renderer/jobs/frames.h"

#include <algorithm>
#include <cmath>

#include "core/files/text.h"
#include "renderer/base/errors.h"

namespace minkray {
namespace {

constexpr int most_frames = 1000000;

/// Greatest width of small copies and white space between them, in pixels.
constexpr int small_width = 320, white_between = 4;

[[noreturn]] void bad_range(const std::string& text, const char* expected) {
  throw WrongUsage(std::string("--frames: ") + expected + " (got " + text + ")");
}

/// Averages over whole blocks of pixels.
Image smaller(const Image& image) {
  const int step = std::max(1, (image.width + small_width - 1) / small_width);
  Image small(std::max(1, image.width / step), std::max(1, image.height / step));
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      Vec3<float> sum = Vec3<float>::Zero();
      int count = 0;
      for (int j = y * step; j < std::min((y + 1) * step, image.height); ++j)
        for (int i = x * step; i < std::min((x + 1) * step, image.width); ++i, ++count)
          sum += image.at(i, j);
      small.at(x, y) = sum / static_cast<float>(count);
    }
  return small;
}

/// Begin and end of the only run of #; npos if there is not exactly one.
std::pair<std::size_t, std::size_t> run_in(const std::string& name) {
  const std::size_t slash = name.find_last_of('/');
  const std::size_t begin = name.find('#', slash == std::string::npos ? 0 : slash);
  if (begin == std::string::npos) return {begin, begin};
  const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
  if (name.find('#', end) != std::string::npos) return {std::string::npos, std::string::npos};
  return {begin, end};
}

}  // namespace

FrameRange parse_frames(const std::string& text) {
  const char* const expected = "must be the first and the last frame, as in 0..24";
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos) bad_range(text, expected);
  const auto number = [&](std::size_t begin, std::size_t end) {
    int value = 0;
    if (!read_number(std::string_view(text).substr(begin, end - begin), value))
      bad_range(text, expected);
    if (value < 0 || value > most_frames) bad_range(text, "frames go from 0 to 1000000");
    return value;
  };
  const FrameRange range{number(0, dots), number(dots + 2, text.size())};
  if (range.first > range.last) bad_range(text, "the first frame must not be after the last");
  return range;
}

void check_frame_name(const std::string& name) {
  if (run_in(name).first == std::string::npos)
    throw WrongUsage(
        "--output: with --frames, the file name must have one run of # for the frame's number, as "
        "in frame-####.png (got " +
        name + ")");
}

std::string file_of_frame(const std::string& name, int frame) {
  const auto [begin, end] = run_in(name);
  std::string number = std::to_string(frame);
  if (number.size() < end - begin) number.insert(0, end - begin - number.size(), '0');
  return name.substr(0, begin) + number + name.substr(end);
}

void ContactSheet::add(const Image& frame) {
  frames_.push_back(smaller(frame));
}

Image ContactSheet::image() const {
  if (frames_.empty()) return {};
  const int count = static_cast<int>(frames_.size());
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  const int rows = (count + columns - 1) / columns;
  const int width = frames_[0].width, height = frames_[0].height;
  const int right = width + white_between, down = height + white_between;
  Image sheet(columns * right - white_between, rows * down - white_between,
              Vec3<float>::Constant(1));
  for (int i = 0; i < count; ++i)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        sheet.at(i % columns * right + x, i / columns * down + y) =
            frames_[static_cast<std::size_t>(i)].at(x, y);
  return sheet;
}

}  // namespace minkray
