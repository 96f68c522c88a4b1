// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/gltf_shapes.h"

#include "renderer/import/mesh/geometry_common.h"
#include "renderer/json/object_reader.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

/// Brings z to y.
Affine<double> z_to_y() {
  Affine<double> pose;
  pose.linear << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return pose;
}

class Sizes {
 public:
  Sizes(const Json& json, const JsonPath& path, Mistakes& mistakes)
      : reader_(json, path, mistakes) {}

  double number(std::string_view key, double otherwise, Range range = Range::positive) {
    const Json* written = reader_.find(key);
    if (!written) return otherwise;
    return read_number(*written, reader_.path(key), reader_.mistakes(), range).value_or(otherwise);
  }
  Vec3<double> vector(std::string_view key, const Vec3<double>& otherwise) {
    const Json* written = reader_.find(key);
    if (!written) return otherwise;
    return read_vector(*written, reader_.path(key), reader_.mistakes(), Range::positive)
        .value_or(otherwise);
  }
  /// The radii at the bottom and the top; one of them may be zero.
  std::array<double, 2> radii() {
    const std::array radii = {number("radiusBottom", 0.25, Range::not_negative),
                              number("radiusTop", 0.25, Range::not_negative)};
    if (radii[0] == 0 && radii[1] == 0)
      reader_.mistakes().add(reader_.path(), "must have a radius > 0");
    return radii;
  }
  bool has(std::string_view key) { return reader_.find(key) != nullptr; }

 private:
  ObjectReader reader_;
};

GltfShape upright(std::string kind, Shape shape) {
  return {std::move(kind), std::move(shape), z_to_y()};
}

}  // namespace

std::optional<GltfShape> gltf_shape(GltfDocument& document, const Json& number,
                                    const JsonPath& asks) {
  Mistakes& mistakes = document.mistakes();
  const Json* extensions = document.root()->find("extensions");
  const Json* extension =
      extensions && extensions->is_object() ? extensions->find("KHR_implicit_shapes") : nullptr;
  const Json* shapes = extension && extension->is_object() ? extension->find("shapes") : nullptr;
  const std::size_t count = shapes && shapes->is_array() ? shapes->size() : 0;
  if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= count) {
    mistakes.add(asks, "must be the number of one of the " + std::to_string(count) +
                           " shapes of KHR_implicit_shapes (" + found(number) + ")");
    return std::nullopt;
  }
  const auto index = static_cast<std::size_t>(number.get<std::uint64_t>());
  const JsonPath path = JsonPath() / "extensions" / "KHR_implicit_shapes" / "shapes" / index;
  const Json& json = (*shapes)[index];
  ObjectReader object(json, path, mistakes);
  const Json* type = object.require("type", "a shape's type");
  const auto kind = type ? read_string(*type, object.path("type"), mistakes) : std::nullopt;
  if (!kind) return std::nullopt;
  const std::size_t before = mistakes.messages().size();
  const Json* written = object.find(*kind);
  const Json none = Json::object();
  Sizes sizes(written ? *written : none, path / *kind, mistakes);
  GltfShape shape;
  if (*kind == "sphere") {
    shape = {"sphere", sphere_of(sizes.number("radius", 0.5)), {}};
  } else if (*kind == "box") {
    shape = {"box", box_of(sizes.vector("size", Vec3<double>::Ones()) / 2), {}};
  } else if (*kind == "capsule") {
    const double half = sizes.number("height", 0.5) / 2;
    const auto radii = sizes.radii();
    shape = upright("capsule", radii[0] == radii[1] ? capsule_of(radii[0], half)
                                                    : Shape(TaperedCapsule{radii, half}));
  } else if (*kind == "cylinder") {
    const double half = sizes.number("height", 0.5) / 2;
    const auto radii = sizes.radii();
    shape = upright("cylinder", radii[0] == radii[1] ? cylinder_of(radii[0], half)
                                                     : Shape(Frustum{radii, half}));
  } else if (*kind == "plane") {
    if (sizes.has("sizeX") || sizes.has("sizeZ")) {
      mistakes.add(path / *kind, "planes of finite size are not supported");
      return std::nullopt;
    }
    shape = {"plane", std::nullopt, z_to_y()};
  } else {
    mistakes.add(path / "type",
                 "must be one of sphere, box, capsule, cylinder and plane (" + found(*type) + ")");
    return std::nullopt;
  }
  if (mistakes.messages().size() != before) return std::nullopt;
  return shape;
}

}  // namespace minkray
