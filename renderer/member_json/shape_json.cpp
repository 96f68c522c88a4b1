// SPDX-License-Identifier: MIT
#include "renderer/member_json/shape_json.h"

#include "renderer/member_json/member_codec.h"
#include "renderer/member_json/tagged_json.h"

namespace minkray {
namespace {

/// Reads the operands of a shape that has nothing else from a list "shapes", in their order.
template <class S>
bool read_operands_from_list(ObjectReader& object, const Json& json, S& shape, MeshFiles& meshes) {
  constexpr std::size_t count = operand_count<S>();
  const JsonPath path = object.path("shapes");
  if (!json.is_array() || json.size() != count) {
    object.mistakes().add(
        path, "must be a list of " + std::to_string(count) + " shapes (" + found(json) + ")");
    return false;
  }
  const auto operands = read_shapes(json, path, object.mistakes(), meshes, count);
  if (!operands) return false;
  std::size_t i = 0;
  for_each_field<S>([&](const auto& field) { shape.*(field.member) = (*operands)[i++]; });
  return true;
}

/// True if the parameters fit each other.
bool fits(ObjectReader& object, const std::optional<Misfit>& misfit) {
  if (!misfit) return true;
  const Json* const json = object.find(misfit->parameter);
  object.mistakes().add(object.path(misfit->parameter), std::string(misfit->must_be) + " " +
                                                            Json(misfit->number).dump() + " (got " +
                                                            (json ? json->dump() : "none") + ")");
  return false;
}

}  // namespace

std::optional<Shape> read_shape(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                MeshFiles& meshes) {
  ObjectReader object(json, path, mistakes);
  auto kind = read_tagged<ShapeVariant>(object, "a shape", [&]<class S>(S& shape) {
    if constexpr (takes_list_of_operands<S>()) {
      if (const Json* list = object.find("shapes")) {
        return read_operands_from_list(object, *list, shape, meshes);
      }
    }
    if (!read_members(object, shape, meshes)) return false;
    if constexpr (requires { shape.misfit(); }) return fits(object, shape.misfit());
    return true;
  });
  if (!kind) return std::nullopt;
  return std::visit([](auto& shape) { return Shape(std::move(shape)); }, *kind);
}

std::optional<ShapeList> read_shapes(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                     MeshFiles& meshes, std::size_t least) {
  if (!json.is_array() || json.size() < least) {
    mistakes.add(path, "must be a list of shapes, at least " + std::to_string(least) + " (" +
                           found(json) + ")");
    return std::nullopt;
  }
  ShapeList shapes;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (const auto shape = read_shape(json[i], path / i, mistakes, meshes)) {
      shapes.push_back(*shape);
    }
  }
  if (shapes.size() != json.size()) return std::nullopt;
  return shapes;
}

Json write_shape(const Shape& shape) {
  return std::visit(
      []<class S>(const S& kind) {
        Json json = {{"type", S::name}};
        write_members(json, kind);
        return json;
      },
      shape.kind);
}

}  // namespace minkray
