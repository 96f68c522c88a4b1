// SPDX-License-Identifier: MIT
// LAS, MCAP and COCO files of scans, decoded by their specifications.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "renderer/io/exr.h"
#include "renderer/json/json.h"
#include "renderer/sensor/coco.h"
#include "renderer/sensor/las.h"
#include "renderer/sensor/mcap.h"
#include "renderer/sensor/scan.h"

namespace minkray {
namespace {

/// Reads numbers one after another.
class Reader {
 public:
  Reader(const std::vector<unsigned char>& bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  template <class Number>
  Number next() {
    Number number = {};
    if (at_ + sizeof number <= bytes_.size())
      std::memcpy(&number, bytes_.data() + at_, sizeof number);
    else
      ADD_FAILURE() << "read beyond the end";
    at_ += sizeof number;
    return number;
  }
  /// As CDR aligns them, from `base` on.
  template <class Number>
  Number aligned(std::size_t base) {
    while ((at_ - base) % sizeof(Number) != 0) ++at_;
    return next<Number>();
  }
  std::string text(std::size_t size) {
    const std::string read(bytes_.begin() + std::ptrdiff_t(at_),
                           bytes_.begin() + std::ptrdiff_t(at_ + size));
    at_ += size;
    return read;
  }
  std::size_t at() const { return at_; }
  void go_to(std::size_t at) { at_ = at; }

 private:
  const std::vector<unsigned char>& bytes_;
  std::size_t at_;
};

/// Two balls, one before the other, and a camera or a lidar in the world's origin.
class ScanFormatsTest : public ::testing::Test {
 protected:
  ScanFormatsTest() {
    scene_.materials.push_back({"matt", LambertMaterial{Colour::Constant(0.5)}});
    for (const double z : {40.0, 80.0}) {
      Object& ball = scene_.objects.emplace_back();
      ball.name = z < 50 ? "near" : "far";
      Sphere sphere;
      sphere.radius = z < 50 ? 5 : 30;
      ball.shape = sphere;
      ball.pose.translation = {0, 0, z};
    }
    CalibratedCamera::Numbers numbers;
    numbers.fx = numbers.fy = 20, numbers.cx = 9, numbers.cy = 7;
    numbers.width = 20, numbers.height = 15;
    rays_ = rays_of_camera(CalibratedCamera(numbers), "k.json");
    options_.returns = 2;
    options_.start = 12.5;
    scan_ = scan(scene_, rays_, options_);
    for (const Echo& echo : scan_.echoes) points_ += echo.object >= 0 ? 1 : 0;
  }

  ScanOutput output() const { return {scan_, rays_, 2, scene_, options_.start}; }

  Scene scene_;
  SensorRays rays_;
  ScanOptions options_;
  Scan scan_;
  std::size_t points_ = 0;
};

TEST_F(ScanFormatsTest, las_holds_coordinates_to_half_a_step) {
  const std::vector<unsigned char> bytes = las_of(output());
  ASSERT_EQ(bytes.size(), 375 + 30 * points_);
  Reader header(bytes, 94);
  EXPECT_EQ(header.next<std::uint16_t>(), 375);
  EXPECT_EQ(header.next<std::uint32_t>(), 375u);
  EXPECT_EQ(header.next<std::uint32_t>(), 0u);
  EXPECT_EQ(header.next<std::uint8_t>(), 6);
  EXPECT_EQ(header.next<std::uint16_t>(), 30);
  double scale[3], offset[3];
  header.go_to(131);
  for (double& x : scale) x = header.next<double>();
  for (double& x : offset) x = header.next<double>();
  double most[3], least[3];
  for (int axis = 0; axis < 3; ++axis) {
    most[axis] = header.next<double>();
    least[axis] = header.next<double>();
    EXPECT_LE(scale[axis], 1e-7);
  }
  header.go_to(247);
  EXPECT_EQ(header.next<std::uint64_t>(), points_);
  const auto first_returns = header.next<std::uint64_t>();
  EXPECT_EQ(first_returns + header.next<std::uint64_t>(), points_);
  Reader points(bytes, 375);
  for (std::size_t i = 0; i < scan_.echoes.size(); ++i) {
    const Echo& echo = scan_.echoes[i];
    if (echo.object < 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = points.next<std::int32_t>() * scale[axis] + offset[axis];
      EXPECT_LE(std::abs(x - echo.point[axis]), 0.5001 * scale[axis]);
      EXPECT_LE(least[axis] - 1e-12, x);
      EXPECT_GE(most[axis] + 1e-12, x);
    }
    EXPECT_EQ(points.next<std::uint16_t>(), std::lround(65535 * 0.5 * std::cos(echo.incidence)));
    const bool has_second = scan_.echoes[i - i % 2 + 1].object >= 0;
    EXPECT_EQ(points.next<std::uint8_t>(), (1 + i % 2) | (has_second ? 2 : 1) << 4);
    points.next<std::uint16_t>();
    EXPECT_EQ(points.next<std::uint8_t>(), i / 2 / 20);  // the image's row
    points.next<std::int16_t>();
    EXPECT_EQ(points.next<std::uint16_t>(), echo.object + 1);
    EXPECT_EQ(points.next<double>(), 12.5);
  }
}

TEST_F(ScanFormatsTest, las_leaves_out_what_noise_took_beyond_all_numbers) {
  for (std::size_t i = 0; i < scan_.echoes.size(); ++i)
    if (scan_.echoes[i].object >= 0) {
      scan_.echoes[i].point.x() = std::numeric_limits<double>::infinity();
      const bool has_second = scan_.echoes[i + 1].object >= 0;
      EXPECT_EQ(las_of(output()).size(), 375 + 30 * (points_ - (has_second ? 2 : 1)));
      break;
    }
}

TEST_F(ScanFormatsTest, mcap_has_one_point_cloud_and_an_index_that_finds_it) {
  const std::vector<unsigned char> bytes = mcap_of(output());
  const std::string magic("\x89MCAP0\r\n", 8), all(bytes.begin(), bytes.end());
  EXPECT_EQ(all.substr(0, 8), magic);
  EXPECT_EQ(all.substr(all.size() - 8), magic);
  // The footer, 29 bytes before that, leads to the summary, and that to the chunk.
  Reader footer(bytes, bytes.size() - 8 - 29);
  EXPECT_EQ(footer.next<std::uint8_t>(), 2);
  EXPECT_EQ(footer.next<std::uint64_t>(), 20u);
  Reader summary(bytes, footer.next<std::uint64_t>());
  std::size_t chunk_at = 0, index_at = 0;
  while (summary.at() < bytes.size() - 8 - 29) {
    const auto kind = summary.next<std::uint8_t>();
    const auto size = summary.next<std::uint64_t>();
    const std::size_t begin = summary.at();
    if (kind == 8) {
      EXPECT_EQ(summary.next<std::uint64_t>(), 12500000000u);
      summary.next<std::uint64_t>();
      chunk_at = summary.next<std::uint64_t>();
      const auto length = summary.next<std::uint64_t>();
      summary.next<std::uint32_t>();
      summary.next<std::uint16_t>();
      index_at = summary.next<std::uint64_t>();
      EXPECT_EQ(index_at, chunk_at + length);
    }
    summary.go_to(begin + size);
  }
  ASSERT_NE(chunk_at, 0u);
  Reader index(bytes, index_at);
  EXPECT_EQ(index.next<std::uint8_t>(), 7);
  index.go_to(index.at() + 8 + 2 + 4 + 8);
  const auto in_chunk = index.next<std::uint64_t>();
  Reader message(bytes, chunk_at + 9 + 8 + 8 + 8 + 4 + 4 + 8 + in_chunk);
  EXPECT_EQ(message.next<std::uint8_t>(), 5);
  message.go_to(message.at() + 8 + 2 + 4 + 8 + 8 + 4);
  const std::size_t base = message.at();
  EXPECT_EQ(message.aligned<std::int32_t>(base), 12);
  EXPECT_EQ(message.aligned<std::uint32_t>(base), 500000000u);
  EXPECT_EQ(message.text(message.aligned<std::uint32_t>(base)), std::string("map\0", 4));
  EXPECT_EQ(message.aligned<std::uint32_t>(base), 1u);
  EXPECT_EQ(message.aligned<std::uint32_t>(base), points_);
  const auto fields = message.aligned<std::uint32_t>(base);
  std::string names;
  for (std::uint32_t i = 0; i < fields; ++i) {
    names += message.text(message.aligned<std::uint32_t>(base)).c_str() + std::string(" ");
    message.aligned<std::uint32_t>(base);
    message.next<std::uint8_t>();
    EXPECT_EQ(message.aligned<std::uint32_t>(base), 1u);
  }
  EXPECT_EQ(names, "x y z intensity ring time object ");
  message.next<std::uint8_t>();
  const auto step = message.aligned<std::uint32_t>(base);
  EXPECT_EQ(message.aligned<std::uint32_t>(base), step * points_);
  EXPECT_EQ(message.aligned<std::uint32_t>(base), step * points_);
  for (std::size_t i = 0; i < scan_.echoes.size(); ++i) {
    const Echo& echo = scan_.echoes[i];
    if (echo.object < 0) continue;
    const std::size_t begin = message.at();
    for (const double x : echo.point) EXPECT_EQ(message.next<float>(), float(x));
    EXPECT_EQ(message.next<float>(), float(echo.intensity));
    EXPECT_EQ(message.next<std::uint16_t>(), i / 2 / 20);
    message.go_to(begin + 24);
    EXPECT_EQ(message.next<std::int32_t>(), echo.object);
  }
  EXPECT_EQ(message.next<std::uint8_t>(), 1);
}

TEST_F(ScanFormatsTest, coco_has_the_masks_of_the_objects) {
  const std::vector<unsigned char> bytes = coco_of(output());
  const Json file = Json::parse(std::string(bytes.begin(), bytes.end()));
  EXPECT_EQ(file["images"][0]["width"].get<int>(), 20);
  ASSERT_EQ(file["annotations"].size(), 2u);
  EXPECT_EQ(file["categories"][1]["name"].text(), "far");
  std::vector<int> seen(300, -1);
  for (const Json& made : file["annotations"]) {
    const Json& mask = made["segmentation"];
    EXPECT_EQ(mask["size"][0].get<int>(), 15);
    int at = 0, area = 0, left = 99, right = -1, top = 99, bottom = -1;
    for (std::size_t run = 0; run < mask["counts"].size(); ++run)
      for (int n = mask["counts"][run].get<int>(); n > 0; --n, ++at) {
        if (run % 2 == 0) continue;
        const int x = at / 15, y = at % 15;
        seen[std::size_t(y * 20 + x)] = made["category_id"].get<int>() - 1;
        ++area;
        left = std::min(left, x), right = std::max(right, x);
        top = std::min(top, y), bottom = std::max(bottom, y);
      }
    EXPECT_EQ(at, 300);
    EXPECT_EQ(made["area"].get<int>(), area);
    const Json& box = made["bbox"];
    EXPECT_EQ(box[0].get<int>(), left);
    EXPECT_EQ(box[1].get<int>(), top);
    EXPECT_EQ(box[2].get<int>(), right - left + 1);
    EXPECT_EQ(box[3].get<int>(), bottom - top + 1);
  }
  for (std::size_t i = 0; i < 300; ++i) EXPECT_EQ(seen[i], scan_.echoes[2 * i].object) << i;
}

TEST_F(ScanFormatsTest, exr_may_have_halfs) {
  ScanOutput halfs = output();
  halfs.has_halfs = true;
  for (const ScanFormat& format : scan_formats()) {
    if (format.ending != ".exr") continue;
    const std::vector<unsigned char> whole = format.encode(output()), half = format.encode(halfs);
    EXPECT_LT(half.size(), whole.size());
    const ExrImage image =
        decode_exr({reinterpret_cast<const char*>(half.data()), half.size()}, "x");
    const auto& t = std::get<std::vector<float>>(image.find("t")->values);
    for (std::size_t i = 0; i < 300; ++i) {
      const double wanted = scan_.echoes[2 * i].t;
      if (std::isfinite(wanted)) {
        EXPECT_NEAR(t[i], wanted, wanted / 2048);
      } else {
        EXPECT_EQ(t[i], wanted);
      }
    }
  }
}

}  // namespace
}  // namespace minkray
