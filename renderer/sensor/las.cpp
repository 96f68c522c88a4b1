// SPDX-License-Identifier: MIT
#include "renderer/sensor/las.h"

#include <array>
#include <cmath>

#include "renderer/sensor/put_bytes.h"

namespace minkray {
namespace {

constexpr std::uint16_t header_bytes = 375, point_bytes = 30;
constexpr std::size_t most_returns = 15;

/// Quantisation of the coordinates of one axis.
struct LasAxis {
  double scale = 1, offset = 0, least = 0, most = 0;  ///< least and most: ends as readers decode
                                                      ///< them

  std::int32_t number(double x) const {
    return static_cast<std::int32_t>(std::llround((x - offset) / scale));
  }
  double read_again(double x) const { return number(x) * scale + offset; }
};

/// True if an echo has a place in a file of points; noise may make it infinite.
bool is_point(const Echo& echo) {
  return echo.object >= 0 && echo.point.allFinite();
}

LasAxis las_axis(const Scan& scan, int axis) {
  LasAxis made;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Echo& echo : scan.echoes) {
    if (!is_point(echo)) continue;
    least = std::min(least, echo.point[axis]);
    most = std::max(most, echo.point[axis]);
  }
  if (!(least <= most)) return made;
  made.offset = std::round((least + most) / 2);
  const double reach = std::max(most - made.offset, made.offset - least);
  constexpr double most_number = 2147483000;  // leaves some numbers for rounding
  made.scale = std::pow(10.0, std::max(-9.0, std::ceil(std::log10(reach / most_number))));
  made.least = made.read_again(least);
  made.most = made.read_again(most);
  return made;
}

void put_header(FileBytes& bytes, const std::array<LasAxis, 3>& axes,
                const std::array<std::uint64_t, most_returns>& by_return) {
  std::uint64_t points = 0;
  for (const std::uint64_t count : by_return) points += count;
  put_text(bytes, "LASF");
  put(bytes, std::uint16_t{0});       // source
  put(bytes, std::uint16_t{1 << 4});  // coordinate systems, if any, are WKT
  put_text(bytes, "", 16);
  put(bytes, std::uint8_t{1});
  put(bytes, std::uint8_t{4});
  put_text(bytes, "SIMULATION", 32);
  put_text(bytes, "minkray", 32);
  put(bytes, std::uint32_t{0});  // day and year are 0, so that the same scan has the same bytes
  put(bytes, header_bytes);
  put(bytes, std::uint32_t{header_bytes});
  put(bytes, std::uint32_t{0});
  put(bytes, std::uint8_t{6});
  put(bytes, point_bytes);
  put_text(bytes, "", 24);  // counts of old versions
  for (const LasAxis& axis : axes) put(bytes, axis.scale);
  for (const LasAxis& axis : axes) put(bytes, axis.offset);
  for (const LasAxis& axis : axes) {
    put(bytes, axis.most);
    put(bytes, axis.least);
  }
  put_text(bytes, "", 20);  // no waveforms, no extended records
  put(bytes, points);
  for (const std::uint64_t count : by_return) put(bytes, count);
}

}  // namespace

std::vector<unsigned char> las_of(const ScanOutput& output) {
  const std::array<LasAxis, 3> axes = {las_axis(output.scan, 0), las_axis(output.scan, 1),
                                       las_axis(output.scan, 2)};
  const auto several = static_cast<std::size_t>(output.returns);
  std::array<std::uint64_t, most_returns> by_return = {};
  FileBytes points;
  for (std::size_t ray = 0; ray < output.rays.rays.size(); ++ray) {
    const std::span<const Echo> echoes(output.scan.echoes.data() + ray * several, several);
    std::size_t met = 0;
    while (met < several && is_point(echoes[met])) ++met;
    const std::size_t count = std::min(met, most_returns);
    for (std::size_t k = 0; k < count; ++k) {
      const Echo& echo = echoes[k];
      ++by_return[k];
      for (int axis = 0; axis < 3; ++axis)
        put(points, axes[static_cast<std::size_t>(axis)].number(echo.point[axis]));
      const double share = echo.intensity * echo.distance * echo.distance;
      put(points, static_cast<std::uint16_t>(std::lround(65535 * std::min(1.0, share))));
      put(points, static_cast<std::uint8_t>((k + 1) | count << 4));
      put(points, std::uint8_t{0});
      put(points, std::uint8_t{0});
      const int channel = output.channel_of(ray);
      put(points, static_cast<std::uint8_t>(channel < 256 ? channel : 0));
      put(points, std::int16_t{0});
      put(points, static_cast<std::uint16_t>(echo.object < 65535 ? echo.object + 1 : 0));
      put(points, output.time_of(ray * several));
    }
  }
  FileBytes bytes;
  put_header(bytes, axes, by_return);
  bytes.insert(bytes.end(), points.begin(), points.end());
  return bytes;
}

}  // namespace minkray
