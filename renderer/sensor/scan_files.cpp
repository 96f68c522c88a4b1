// SPDX-License-Identifier: MIT
#include "renderer/sensor/scan_files.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "core/files/text.h"
#include "core/parallel/parallel.h"
#include "renderer/base/errors.h"
#include "renderer/io/exr.h"
#include "renderer/io/png.h"
#include "renderer/json/json.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/sensor/coco.h"
#include "renderer/sensor/las.h"
#include "renderer/sensor/mcap.h"
#include "renderer/sensor/npy.h"

namespace minkray {
namespace {

static_assert(std::endian::native == std::endian::little);

using Bytes = std::vector<unsigned char>;

/// Layout of one record of the .npy file, without gaps.
constexpr const char* record_fields =
    "[('t', '<f8'), ('distance', '<f8'), ('point', '<f8', (3,)), ('normal', '<f8', (3,)), "
    "('object', '<i4'), ('t_lo', '<f8'), ('t_hi', '<f8'), ('status', '|u1'), "
    "('incidence', '<f8'), ('intensity', '<f8'), ('time', '<f8')]";
constexpr std::size_t record_bytes = 8 + 8 + 24 + 24 + 4 + 8 + 8 + 1 + 8 + 8 + 8;

template <class Number>
unsigned char* put_at(unsigned char* at, const Number& number) {
  std::memcpy(at, &number, sizeof number);
  return at + sizeof number;
}

Bytes npy_of(const ScanOutput& output) {
  const Scan& scan = output.scan;
  const std::string header =
      npy_header(record_fields, output.rays.rays.size(), static_cast<std::size_t>(output.returns));
  Bytes bytes(header.size() + record_bytes * scan.echoes.size());
  std::memcpy(bytes.data(), header.data(), header.size());
  constexpr std::size_t records_a_range = 16384;
  parallel_for(scan.echoes.size(), records_a_range, [&](std::size_t begin, std::size_t end) {
    unsigned char* at = bytes.data() + header.size() + record_bytes * begin;
    for (std::size_t i = begin; i < end; ++i) {
      const Echo& echo = scan.echoes[i];
      at = put_at(put_at(at, echo.t), echo.distance);
      for (const double x : echo.point) at = put_at(at, x);
      for (const double x : echo.normal) at = put_at(at, x);
      at = put_at(put_at(put_at(put_at(at, echo.object), echo.t_lo), echo.t_hi), echo.status);
      at = put_at(put_at(at, echo.incidence), echo.intensity);
      at = put_at(at, output.time_of(i));
    }
  });
  return bytes;
}

Bytes bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

Bytes csv_of(const ScanOutput& output) {
  std::string text =
      "ray,echo,t,distance,x,y,z,normal_x,normal_y,normal_z,object,t_lo,t_hi,status,"
      "incidence,intensity,time\n";
  const auto add = [&](double number) {
    char digits[40];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, number);
    text.append(digits, end);
    text += ',';
  };
  const auto several = static_cast<std::size_t>(output.returns);
  const Scan& scan = output.scan;
  for (std::size_t i = 0; i < scan.echoes.size(); ++i) {
    const Echo& echo = scan.echoes[i];
    text += std::to_string(i / several) + ',' + std::to_string(i % several) + ',';
    add(echo.t);
    add(echo.distance);
    for (const double x : echo.point) add(x);
    for (const double x : echo.normal) add(x);
    text += std::to_string(echo.object) + ',';
    add(echo.t_lo);
    add(echo.t_hi);
    text += std::to_string(echo.status) + ',';
    add(echo.incidence);
    add(echo.intensity);
    add(output.time_of(i));
    text.back() = '\n';
  }
  return bytes_of(text);
}

/// Writes the header, then for each hit point x, y, z, its normal and intensity in floats, and its
/// object.
Bytes points_of(const Scan& scan, std::string header, const std::string& count_mark) {
  std::size_t count = 0;
  for (const Echo& echo : scan.echoes) count += echo.object >= 0 ? 1 : 0;
  for (std::size_t at = header.find(count_mark); at != header.npos; at = header.find(count_mark))
    header.replace(at, count_mark.size(), std::to_string(count));
  Bytes bytes(header.size() + 32 * count);
  std::memcpy(bytes.data(), header.data(), header.size());
  unsigned char* at = bytes.data() + header.size();
  for (const Echo& echo : scan.echoes) {
    if (echo.object < 0) continue;
    for (const double x : echo.point) at = put_at(at, static_cast<float>(x));
    for (const double x : echo.normal) at = put_at(at, static_cast<float>(x));
    at = put_at(put_at(at, static_cast<float>(echo.intensity)), echo.object);
  }
  return bytes;
}

Bytes pcd_of(const ScanOutput& output) {
  return points_of(
      output.scan,
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
      "FIELDS x y z normal_x normal_y normal_z intensity object\nSIZE 4 4 4 4 4 4 4 4\n"
      "TYPE F F F F F F F I\nCOUNT 1 1 1 1 1 1 1 1\nWIDTH @\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS @\nDATA binary\n",
      "@");
}

Bytes ply_of(const ScanOutput& output) {
  return points_of(output.scan,
                   "ply\nformat binary_little_endian 1.0\nelement vertex @\nproperty float x\n"
                   "property float y\nproperty float z\nproperty float nx\nproperty float ny\n"
                   "property float nz\nproperty float intensity\nproperty int object\nend_header\n",
                   "@");
}

/// Image of the first echo of each pixel.
template <class Of>
auto plane_of(const ScanOutput& output, const Of& of) {
  std::vector<decltype(of(output.scan.echoes[0]))> values;
  values.reserve(output.rays.rays.size());
  for (std::size_t i = 0; i < output.rays.rays.size(); ++i)
    values.push_back(of(output.scan.echoes[i * static_cast<std::size_t>(output.returns)]));
  return values;
}

Bytes exr_of(const ScanOutput& output) {
  ExrImage image;
  image.display = image.window = {0, 0, output.rays.width, output.rays.height};
  const auto add = [&](const std::string& name, const auto& of) {
    image.planes.push_back({name, plane_of(output, of), output.has_halfs});
  };
  add("t", [](const Echo& e) { return static_cast<float>(e.t); });
  add("distance", [](const Echo& e) { return static_cast<float>(e.distance); });
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter(1, "XYZ"[axis]);
    add("point." + letter, [axis](const Echo& e) { return static_cast<float>(e.point[axis]); });
    add("normal." + letter, [axis](const Echo& e) { return static_cast<float>(e.normal[axis]); });
  }
  add("incidence", [](const Echo& e) { return static_cast<float>(e.incidence); });
  add("intensity", [](const Echo& e) { return static_cast<float>(e.intensity); });
  add("object", [](const Echo& e) { return static_cast<std::uint32_t>(e.object + 1); });
  add("status", [](const Echo& e) { return std::uint32_t{e.status}; });
  return encode_exr(image);
}

Bytes png_of_depths(const ScanOutput& output) {
  const auto millimetres = plane_of(output, [](const Echo& e) {
    const double depth = std::round(1000 * e.t);
    return static_cast<std::uint16_t>(depth <= 65535 ? depth : 0);
  });
  return png_of_grey16(output.rays.width, output.rays.height, millimetres);
}

constexpr ScanFormat formats[] = {
    {".npy", false, npy_of}, {".csv", false, csv_of},       {".pcd", false, pcd_of},
    {".ply", false, ply_of}, {".las", false, las_of},       {".mcap", false, mcap_of},
    {".exr", true, exr_of},  {".png", true, png_of_depths}, {".json", true, coco_of},
};

}  // namespace

std::span<const ScanFormat> scan_formats() {
  return formats;
}

const ScanFormat& scan_format_of(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  for (const ScanFormat& format : formats)
    if (format.ending == ending) return format;
  throw WrongUsage("--output: must end in one of " + listed(formats, &ScanFormat::ending) +
                   " (got " + file + ")");
}

std::string id_table(const Scene& scene) {
  Json table = Json::array();
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    Json row;
    row["object"] = i;
    row["name"] = scene.objects[i].name;
    table.push_back(std::move(row));
  }
  std::size_t first = scene.objects.size();
  for (const ParticleSet& set : scene.particles) {
    Json row;
    row["object"] = first;
    row["name"] = set.name;
    row["count"] = set.size();
    table.push_back(std::move(row));
    first += set.size();
  }
  return table.dump(1) + "\n";
}

}  // namespace minkray
