// SPDX-License-Identifier: MIT
#include "renderer/member_json/read_paint.h"

#include "renderer/member_json/member_codec.h"
#include "renderer/member_json/read_colour.h"
#include "renderer/member_json/tagged_json.h"

namespace minkray {

std::optional<Paint> read_paint(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                Range range, MeshFiles& files) {
  if (!json.is_object()) {
    const auto colour = read_colour(json, path, mistakes, range);
    return colour ? std::optional<Paint>(*colour) : std::nullopt;
  }
  ObjectReader object(json, path, mistakes);
  auto texture = read_tagged<TextureKind>(
      object, "a texture", [&](auto& kind) { return read_members(object, kind, files); });
  if (!texture) return std::nullopt;
  const auto* gradient = std::get_if<GradientTexture>(&*texture);
  if (gradient && gradient->direction.isZero(0)) {
    mistakes.add(path / "direction", "must not be zero");
    return std::nullopt;
  }
  return Paint(std::move(*texture));
}

Json write_paint(const Paint& paint) {
  if (!paint.texture()) return to_json(paint.colour());
  // Pictures inside a robot's file have no name. Their mean colour is used.
  if (const auto* image = std::get_if<ImageTexture>(paint.texture());
      image && image->picture.file.empty())
    return to_json(paint.colour());
  return std::visit(
      []<class T>(const T& kind) {
        Json json = {{"type", std::string(T::name)}};
        write_members(json, kind);
        return json;
      },
      *paint.texture());
}

}  // namespace minkray
