// SPDX-License-Identifier: MIT
// Numbers of glTF accessors: any component type, strided, normalized or sparse.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "renderer/import/mesh/gltf_document.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

constexpr std::size_t most_numbers = 100'000'000;
/// Sparse accessors may omit the unchanged items: zeros that take no bytes of the file.
constexpr std::size_t most_zeros = 100'000;
constexpr std::size_t most_numbers_read = 400'000'000;

/// The component types' numbers in the file are OpenGL's.
enum ComponentType : int {
  component_int8 = 5120,
  component_uint8,
  component_int16,
  component_uint16,
  component_uint32 = 5125,
  component_float32
};

std::size_t bytes_of(int type) {
  switch (type) {
    case component_int8:
    case component_uint8:
      return 1;
    case component_int16:
    case component_uint16:
      return 2;
    case component_uint32:
    case component_float32:
      return 4;
    default:
      return 0;
  }
}

template <class Number>
double read_as(const char* at, double unit) {
  Number number;
  std::memcpy(&number, at, sizeof number);
  return std::max(static_cast<double>(number) / unit, -1.0);
}

/// Normalized integers represent numbers from -1 or 0 to 1.
double number_at(const char* at, int type, bool normalized) {
  if (type == component_float32) {
    float number;
    std::memcpy(&number, at, sizeof number);
    return static_cast<double>(number);
  }
  if (normalized) {
    switch (type) {
      case component_int8:
        return read_as<std::int8_t>(at, 127);
      case component_uint8:
        return read_as<std::uint8_t>(at, 255);
      case component_int16:
        return read_as<std::int16_t>(at, 32767);
      case component_uint16:
        return read_as<std::uint16_t>(at, 65535);
      default:
        return read_as<std::uint32_t>(at, 4294967295.0);
    }
  }
  const auto plain = [&]<class Number>(Number number) {
    std::memcpy(&number, at, sizeof number);
    return static_cast<double>(number);
  };
  switch (type) {
    case component_int8:
      return plain(std::int8_t());
    case component_uint8:
      return plain(std::uint8_t());
    case component_int16:
      return plain(std::int16_t());
    case component_uint16:
      return plain(std::uint16_t());
    default:
      return plain(std::uint32_t());
  }
}

}  // namespace

/// Location of numbers: each item is `stride` bytes behind the one before.
struct GltfDocument::Source {
  const char* data = nullptr;
  std::size_t stride = 0;
};

/// The bufferView and byteOffset of an object, checked to hold `count` items.
bool GltfDocument::find(const Json& object, const JsonPath& path, std::size_t components,
                        std::size_t count, int type, Source& source) {
  const auto view_index = index(object, path, "bufferView", "bufferViews");
  if (!view_index) {
    if (!object.contains("bufferView"))
      mistakes_.add(path, "must have a \"bufferView\" (compressed meshes are not supported)");
    return false;
  }
  const Json& view = item("bufferViews", *view_index);
  const JsonPath view_path = JsonPath() / "bufferViews" / *view_index;
  const auto buffer_index = index(view, view_path, "buffer", "buffers");
  if (!buffer_index) {
    if (!view.contains("buffer")) mistakes_.add(view_path, "must have a \"buffer\"");
    return false;
  }
  const std::string* bytes = buffer(*buffer_index);
  if (!bytes) return false;
  const std::size_t size = bytes_of(type) * components;
  const std::size_t begin = natural(view, view_path, "byteOffset", 0);
  const std::size_t length = natural(view, view_path, "byteLength", 0);
  const std::size_t offset = natural(object, path, "byteOffset", 0);
  source.stride = std::max(natural(view, view_path, "byteStride", size), size);
  if (begin + length > bytes->size()) {
    mistakes_.add(view_path, "must lie in its buffer of " + std::to_string(bytes->size()) +
                                 " bytes (got " + std::to_string(length) + " from " +
                                 std::to_string(begin) + ")");
    return false;
  }
  // The items' bytes, without overflow: strides are at most most_natural, counts most_numbers.
  if (count > 0 && (offset > length || length - offset < size ||
                    (length - offset - size) / source.stride < count - 1)) {
    mistakes_.add(path, "must lie in its bufferView of " + std::to_string(length) + " bytes");
    return false;
  }
  source.data = bytes->data() + begin + offset;
  return true;
}

std::optional<std::vector<double>> GltfDocument::numbers(std::size_t accessor,
                                                         std::size_t components) {
  const Json& json = item("accessors", accessor);
  const JsonPath path = JsonPath() / "accessors" / accessor;
  const char* const wanted = components == 4   ? "VEC4"
                             : components == 3 ? "VEC3"
                             : components == 2 ? "VEC2"
                                               : "SCALAR";
  const Json* shape = json.find("type");
  if (!shape || !shape->is_string() || shape->text() != wanted) {
    mistakes_.add(path / "type", "must be \"" + std::string(wanted) + "\"");
    return std::nullopt;
  }
  const int type = static_cast<int>(
      std::min<std::size_t>(natural(json, path, "componentType", 0), std::size_t{1} << 20));
  if (bytes_of(type) == 0) {
    mistakes_.add(path / "componentType", "must be one of 5120 to 5123, 5125 and 5126");
    return std::nullopt;
  }
  const std::size_t count = natural(json, path, "count", 0);
  if (count == 0 || count > most_numbers / components) {
    mistakes_.add(path / "count", "must be a whole number > 0, and not too large");
    return std::nullopt;
  }
  numbers_read_ += count * components;
  if (numbers_read_ > most_numbers_read) {
    mistakes_.add("reads more than " + std::to_string(most_numbers_read) + " numbers");
    return std::nullopt;
  }
  const Json* flag = json.find("normalized");
  const bool normalized = flag && flag->is_boolean() && flag->get<bool>();
  const bool is_sparse = json.contains("sparse");
  if (!json.contains("bufferView") && count > most_zeros) {
    mistakes_.add(path, "must have a \"bufferView\" for this many numbers");
    return std::nullopt;
  }
  Source source;
  if (!(is_sparse && !json.contains("bufferView")) &&
      !find(json, path, components, count, type, source))
    return std::nullopt;
  std::vector<double> values;
  if (source.data) {
    values.reserve(count * components);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < components; ++k)
        values.push_back(
            number_at(source.data + i * source.stride + k * bytes_of(type), type, normalized));
  } else {
    values.resize(count * components);  // of a sparse accessor without others, zeros
  }
  if (is_sparse && !replace_sparse(json, path, components, count, type, normalized, values))
    return std::nullopt;
  return values;
}

bool GltfDocument::replace_sparse(const Json& accessor, const JsonPath& path,
                                  std::size_t components, std::size_t count, int type,
                                  bool normalized, std::vector<double>& values) {
  const Json& sparse = accessor.at("sparse");
  const JsonPath at = path / "sparse";
  const Json* places = sparse.is_object() ? sparse.find("indices") : nullptr;
  const Json* given = sparse.is_object() ? sparse.find("values") : nullptr;
  if (!places || !places->is_object() || !given || !given->is_object()) {
    mistakes_.add(at, "must have \"count\", \"indices\" and \"values\"");
    return false;
  }
  const std::size_t some = natural(sparse, at, "count", 0);
  const int index_type = static_cast<int>(std::min<std::size_t>(
      natural(*places, at / "indices", "componentType", 0), std::size_t{1} << 20));
  if (some == 0 || some > count || bytes_of(index_type) == 0 || index_type == component_float32) {
    mistakes_.add(at, "must have a count from 1 to the accessor's, and whole indices");
    return false;
  }
  Source from, to;
  if (!find(*places, at / "indices", 1, some, index_type, from) ||
      !find(*given, at / "values", components, some, type, to))
    return false;
  for (std::size_t i = 0; i < some; ++i) {
    const double place = number_at(from.data + i * from.stride, index_type, false);
    if (!(place >= 0 && place < static_cast<double>(count))) {
      mistakes_.add(at / "indices", "must be less than the accessor's count");
      return false;
    }
    for (std::size_t k = 0; k < components; ++k)
      values[static_cast<std::size_t>(place) * components + k] =
          number_at(to.data + i * to.stride + k * bytes_of(type), type, normalized);
  }
  return true;
}

std::optional<std::vector<Vec3<double>>> GltfDocument::points(std::size_t accessor) {
  const auto values = numbers(accessor, 3);
  if (!values) return std::nullopt;
  std::vector<Vec3<double>> points;
  points.reserve(values->size() / 3);
  for (std::size_t i = 0; i + 2 < values->size(); i += 3) {
    points.emplace_back((*values)[i], (*values)[i + 1], (*values)[i + 2]);
    if (points.back().allFinite()) continue;
    mistakes_.add(JsonPath() / "accessors" / accessor,
                  "point " + std::to_string(i / 3) + " must be three finite numbers");
    return std::nullopt;
  }
  return points;
}

std::optional<std::vector<Vec3<float>>> GltfDocument::colours(std::size_t accessor) {
  const Json* shape = item("accessors", accessor).find("type");
  const std::size_t components = shape && *shape == "VEC4" ? 4 : 3;
  const auto values = numbers(accessor, components);
  if (!values) return std::nullopt;
  std::vector<Vec3<float>> colours;
  colours.reserve(values->size() / components);
  for (std::size_t i = 0; i + components <= values->size(); i += components) {
    const Vec3<double> colour((*values)[i], (*values)[i + 1], (*values)[i + 2]);
    if (!colour.allFinite()) {
      mistakes_.add(JsonPath() / "accessors" / accessor,
                    "colour " + std::to_string(i / components) + " must be finite numbers");
      return std::nullopt;
    }
    colours.push_back(colour.cwiseMax(0.0).cwiseMin(1.0).cast<float>());
  }
  return colours;
}

std::optional<std::vector<std::array<double, 2>>> GltfDocument::pairs(std::size_t accessor) {
  const auto values = numbers(accessor, 2);
  if (!values) return std::nullopt;
  std::vector<std::array<double, 2>> pairs;
  pairs.reserve(values->size() / 2);
  for (std::size_t i = 0; i + 1 < values->size(); i += 2)
    pairs.push_back({(*values)[i], (*values)[i + 1]});
  return pairs;
}

std::optional<std::vector<std::array<double, 4>>> GltfDocument::quaternions(std::size_t accessor) {
  const auto values = numbers(accessor, 4);
  if (!values) return std::nullopt;
  std::vector<std::array<double, 4>> quaternions;
  for (std::size_t i = 0; i + 3 < values->size(); i += 4) {
    quaternions.push_back({(*values)[i], (*values)[i + 1], (*values)[i + 2], (*values)[i + 3]});
    const std::array<double, 4>& q = quaternions.back();
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (square > 0 && std::isfinite(square)) continue;
    mistakes_.add(JsonPath() / "accessors" / accessor,
                  "rotation " + std::to_string(i / 4) + " must be finite and not zero");
    return std::nullopt;
  }
  return quaternions;
}

std::optional<std::vector<std::uint32_t>> GltfDocument::indices(std::size_t accessor,
                                                                std::size_t limit) {
  const auto values = numbers(accessor, 1);
  if (!values) return std::nullopt;
  std::vector<std::uint32_t> indices;
  indices.reserve(values->size());
  for (const double value : *values) {
    if (!(value >= 0 && value < static_cast<double>(limit) && value == std::floor(value))) {
      mistakes_.add(JsonPath() / "accessors" / accessor,
                    "must hold whole numbers less than " + std::to_string(limit));
      return std::nullopt;
    }
    indices.push_back(static_cast<std::uint32_t>(value));
  }
  return indices;
}

}  // namespace minkray
