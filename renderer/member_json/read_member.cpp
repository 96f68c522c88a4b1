// SPDX-License-Identifier: MIT
#include "renderer/member_json/read_member.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "renderer/json/values.h"
#include "renderer/member_json/read_colour.h"
#include "renderer/member_json/read_paint.h"
#include "renderer/member_json/shape_json.h"

namespace minkray {
namespace {

/// "radius, its radius, > 0": what a missing key should have held.
std::string expectation(const Parameter& parameter) {
  std::string text(parameter.doc);
  if (!constraint(parameter.range).empty()) {
    text += ", " + std::string(constraint(parameter.range));
  }
  return text;
}

/// Finds the key and, if it is there, assigns what `read(json, path)` returns.
template <class M, class Read>
bool read_key(ObjectReader& object, const Parameter& parameter, M& member, Read&& read) {
  const Json* json = object.find(parameter.name);
  if (!json && parameter.optional) return true;
  if (!json) {
    object.require(parameter.name, expectation(parameter));
    return false;
  }
  auto value = read(*json, object.path(parameter.name));
  if (!value) return false;
  member = std::move(*value);
  return true;
}

template <std::size_t N>
bool read_fixed_points(ObjectReader& object, const Parameter& parameter,
                       std::array<Vec3<double>, N>& member) {
  return read_key(
      object, parameter, member,
      [&](const Json& json, const JsonPath& path) -> std::optional<std::array<Vec3<double>, N>> {
        const auto points = read_points(json, path, object.mistakes(), N, N);
        if (!points) return std::nullopt;
        std::array<Vec3<double>, N> fixed;
        std::copy(points->begin(), points->end(), fixed.begin());
        return fixed;
      });
}

}  // namespace

bool read_member(ObjectReader& object, const Parameter& parameter, double& member, MeshFiles&) {
  return read_key(object, parameter, member, [&](const Json& json, const JsonPath& path) {
    return read_number(json, path, object.mistakes(), parameter.range);
  });
}

bool read_member(ObjectReader& object, const Parameter& parameter, std::array<double, 2>& member,
                 MeshFiles&) {
  return read_key(
      object, parameter, member,
      [&](const Json& json, const JsonPath& path) -> std::optional<std::array<double, 2>> {
        const auto numbers = read_numbers(json, path, object.mistakes(), 2, parameter.range);
        if (!numbers) return std::nullopt;
        return std::array<double, 2>{(*numbers)[0], (*numbers)[1]};
      });
}

bool read_member(ObjectReader& object, const Parameter& parameter, Vec3<double>& member,
                 MeshFiles&) {
  return read_key(object, parameter, member, [&](const Json& json, const JsonPath& path) {
    return is_of_colours(parameter.range)
               ? read_colour(json, path, object.mistakes(), parameter.range)
               : read_vector(json, path, object.mistakes(), parameter.range);
  });
}

bool read_member(ObjectReader& object, const Parameter& parameter,
                 std::array<Vec3<double>, 2>& member, MeshFiles&) {
  return read_fixed_points(object, parameter, member);
}

bool read_member(ObjectReader& object, const Parameter& parameter,
                 std::array<Vec3<double>, 3>& member, MeshFiles&) {
  return read_fixed_points(object, parameter, member);
}

bool read_member(ObjectReader& object, const Parameter& parameter, PointCloud& member,
                 MeshFiles& meshes) {
  Mistakes& mistakes = object.mistakes();
  const Json* file = object.find("file");
  const Json* inline_points = object.find(parameter.name);
  if (!file) {
    return read_key(object, parameter, member,
                    [&](const Json& json, const JsonPath& path) -> std::optional<PointCloud> {
                      auto points = read_points(json, path, mistakes, 1,
                                                std::numeric_limits<std::size_t>::max());
                      if (!points) return std::nullopt;
                      try {
                        return PointCloud(std::move(*points));
                      } catch (const std::runtime_error& error) {
                        mistakes.add(path, error.what());
                        return std::nullopt;
                      }
                    });
  }
  if (inline_points) {
    mistakes.add(object.path(),
                 "must have either \"" + std::string(parameter.name) + "\" or \"file\" (got both)");
    return false;
  }
  const auto name = read_string(*file, object.path("file"), mistakes);
  if (!name) return false;
  auto points = meshes.read(*name, object.path("file"), mistakes);
  if (!points) return false;
  member = std::move(*points);
  return true;
}

bool read_member(ObjectReader& object, const Parameter& parameter, Nested& member,
                 MeshFiles& meshes) {
  return read_key(object, parameter, member, [&](const Json& json, const JsonPath& path) {
    return read_shape(json, path, object.mistakes(), meshes);
  });
}

bool read_member(ObjectReader& object, const Parameter& parameter, ShapeList& member,
                 MeshFiles& meshes) {
  // Two operands may be called a and b, too.
  const Json* a = object.find("a");
  const Json* b = object.find("b");
  if (a && b && !object.find(parameter.name)) {
    const auto shape_a = read_shape(*a, object.path("a"), object.mistakes(), meshes);
    const auto shape_b = read_shape(*b, object.path("b"), object.mistakes(), meshes);
    if (!shape_a || !shape_b) return false;
    member = {*shape_a, *shape_b};
    return true;
  }
  if (a || b) {
    object.mistakes().add(object.path(), "must have either \"" + std::string(parameter.name) +
                                             "\" or both \"a\" and \"b\"");
    return false;
  }
  return read_key(object, parameter, member, [&](const Json& json, const JsonPath& path) {
    return read_shapes(json, path, object.mistakes(), meshes, 1);
  });
}

bool read_member(ObjectReader& object, const Parameter&, AffineMap& member, MeshFiles&) {
  const auto map = read_affine(object);
  if (map) member = AffineMap(*map);
  return map.has_value();
}

bool read_member(ObjectReader& object, const Parameter& parameter, std::optional<double>& member,
                 MeshFiles&) {
  return read_key(object, parameter, member, [&](const Json& json, const JsonPath& path) {
    return read_number(json, path, object.mistakes(), parameter.range);
  });
}

bool read_member(ObjectReader& object, const Parameter& parameter, std::string& member,
                 MeshFiles&) {
  return read_key(object, parameter, member, [&](const Json& json, const JsonPath& path) {
    return read_string(json, path, object.mistakes());
  });
}

bool read_member(ObjectReader& object, const Parameter& parameter, Paint& member,
                 MeshFiles& files) {
  return read_key(object, parameter, member, [&](const Json& json, const JsonPath& path) {
    return read_paint(json, path, object.mistakes(), parameter.range, files);
  });
}

bool read_member(ObjectReader& object, const Parameter& parameter, PaintIfAny& member,
                 MeshFiles& files) {
  return read_key(object, parameter, member, [&](const Json& json, const JsonPath& path) {
    return read_paint(json, path, object.mistakes(), parameter.range, files);
  });
}

bool read_member(ObjectReader& object, const Parameter& parameter, PictureFile& member,
                 MeshFiles& files) {
  return read_key(object, parameter, member,
                  [&](const Json& json, const JsonPath& path) -> std::optional<PictureFile> {
                    const auto name = read_string(json, path, object.mistakes());
                    if (!name) return std::nullopt;
                    auto image = files.read_picture(*name, path, object.mistakes());
                    if (!image) return std::nullopt;
                    return PictureFile{files.from_scene(*name), std::move(image)};
                  });
}

bool read_member(ObjectReader& object, const Parameter& parameter, TwoMaterials& member,
                 MeshFiles&) {
  return read_key(
      object, parameter, member,
      [&](const Json& json, const JsonPath& path) -> std::optional<TwoMaterials> {
        if (!json.is_array() || json.size() != 2) {
          object.mistakes().add(path, "must be a list of 2 names (" + found(json) + ")");
          return std::nullopt;
        }
        const auto first = read_string(json[0], path / std::size_t{0}, object.mistakes());
        const auto second = read_string(json[1], path / std::size_t{1}, object.mistakes());
        if (!first || !second) return std::nullopt;
        return TwoMaterials{std::make_shared<const std::array<std::string, 2>>(
            std::array<std::string, 2>{*first, *second})};
      });
}

bool read_name(ObjectReader& object, const Parameter& parameter, std::string& member,
               std::span<const std::string_view> names, std::string_view what) {
  return read_key(object, parameter, member,
                  [&](const Json& json, const JsonPath& path) -> std::optional<std::string> {
                    const auto name = read_string(json, path, object.mistakes());
                    if (!name) return std::nullopt;
                    if (std::find(names.begin(), names.end(), *name) != names.end()) return *name;
                    object.mistakes().add(
                        path, "must be the name of " + std::string(what) + " (" + found(json) +
                                  "; " + suggestion(*name, {names.begin(), names.end()}) + ")");
                    return std::nullopt;
                  });
}

bool read_member(ObjectReader& object, const Parameter& parameter, Resolution& member, MeshFiles&) {
  return read_key(
      object, parameter, member,
      [&](const Json& json, const JsonPath& path) -> std::optional<Resolution> {
        if (!json.is_array() || json.size() != 2) {
          object.mistakes().add(
              path, "must be a list of 2 whole numbers: width and height (" + found(json) + ")");
          return std::nullopt;
        }
        const auto side = [&](std::size_t i) {
          return read_integer(json[i], path / i, object.mistakes(), 1, most_pixels_a_side);
        };
        const auto width = side(0);
        const auto height = side(1);
        if (!width || !height) return std::nullopt;
        return Resolution{*width, *height};
      });
}

}  // namespace minkray
