// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/gltf_looks.h"

#include <algorithm>
#include <cmath>

#include "renderer/image/colour.h"
#include "renderer/import/mesh/gltf_vertex_colours.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

const Json* object_in(const Json* json, std::string_view key) {
  const Json* found = json && json->is_object() ? json->find(key) : nullptr;
  return found && found->is_object() ? found : nullptr;
}

}  // namespace

void GltfLooks::read_picture(const Json& info, const JsonPath& path, GltfLook& look) {
  if (const Json* set = info.find("texCoord"))
    if (const auto number = read_integer(*set, path / "texCoord", document_.mistakes(), 0, 64))
      look.uv_set = static_cast<std::size_t>(*number);
  if (const Json* transform = object_in(object_in(&info, "extensions"), "KHR_texture_transform")) {
    const JsonPath at = path / "extensions" / "KHR_texture_transform";
    const auto pair = [&](const char* key, std::array<double, 2>& member) {
      const Json* written = transform->find(key);
      if (!written) return;
      if (const auto v = read_numbers(*written, at / key, document_.mistakes(), 2))
        member = {(*v)[0], (*v)[1]};
    };
    pair("offset", look.offset);
    pair("scale", look.scale);
    if (const Json* turn = transform->find("rotation"))
      look.rotation = read_number(*turn, at / "rotation", document_.mistakes()).value_or(0);
    if (const Json* set = transform->find("texCoord"))
      if (const auto number = read_integer(*set, at / "texCoord", document_.mistakes(), 0, 64))
        look.uv_set = static_cast<std::size_t>(*number);
  }
  const auto texture = document_.index(info, path, "index", "textures");
  if (!texture) return;
  const auto image = document_.index(document_.item("textures", *texture),
                                     JsonPath() / "textures" / *texture, "source", "images");
  // Without a source the picture is of a format that an extension names.
  if (!image) return;
  if (auto file = document_.image_file(*image)) {
    look.material.file = *file;
  } else {
    auto& bytes = bytes_[*image];
    if (!bytes)
      if (auto read = document_.image_bytes(*image))
        bytes = std::make_shared<const std::string>(std::move(*read));
    look.material.bytes = bytes;
  }
}

GltfLook GltfLooks::look_of(std::size_t number) {
  GltfLook look;
  const JsonPath path = JsonPath() / "materials" / number / "pbrMetallicRoughness";
  const Json* surface = object_in(&document_.item("materials", number), "pbrMetallicRoughness");
  if (!surface) return look;
  if (const Json* factor = surface->find("baseColorFactor"))
    if (const auto linear = read_numbers(*factor, path / "baseColorFactor", document_.mistakes(), 4,
                                         Range::zero_to_one)) {
      for (std::size_t i = 0; i < 3; ++i) look.material.rgba[i] = to_srgb((*linear)[i]);
      look.material.rgba[3] = (*linear)[3];
    }
  if (const Json* info = object_in(surface, "baseColorTexture"))
    read_picture(*info, path / "baseColorTexture", look);
  return look;
}

const std::vector<GltfLook>& GltfLooks::all() {
  if (!is_read_) {
    is_read_ = true;
    for (std::size_t i = 0; i < document_.count("materials"); ++i)
      all_.push_back(document_.item("materials", i).is_object() ? look_of(i) : GltfLook());
  }
  return all_;
}

std::vector<MeshMaterial> GltfLooks::materials() {
  std::vector<MeshMaterial> materials;
  for (const GltfLook& look : all()) materials.push_back(look.material);
  materials.insert(materials.end(), of_colours_.begin(), of_colours_.end());
  return materials;
}

/// Makes a material of a primitive's own, if its vertices have colours, which multiply that of its
/// material.
void GltfLooks::add_colours(const Json& primitive, const JsonPath& path, std::size_t count,
                            std::span<const std::uint32_t> used,
                            const std::vector<MeshAttributes::Numbers>& triangles,
                            const GltfLook& look, MeshAttributes& made) {
  const JsonPath at = path / "attributes";
  const auto accessor = document_.index(primitive.at("attributes"), at, "COLOR_0", "accessors");
  const auto all_colours = accessor ? document_.colours(*accessor) : std::nullopt;
  if (!all_colours || triangles.empty()) return;
  if (all_colours->size() != count)
    return document_.mistakes().add(at / "COLOR_0", "must have as many items as POSITION, " +
                                                        std::to_string(count) + " (got " +
                                                        std::to_string(all_colours->size()) + ")");
  if (look.material.has_picture()) {
    ++colours_left_out_["the material's texture is shown alone"];
    return;
  }
  std::vector<Vec3<float>> colours;
  for (const std::uint32_t i : used) colours.push_back((*all_colours)[i]);
  MeshMaterial material;
  material.rgba = look.material.rgba;
  if (std::ranges::all_of(colours, [&](const auto& c) { return c == colours.front(); })) {
    if (colours.front() == Vec3<float>::Ones()) return;
    for (std::size_t i = 0; i < 3; ++i)
      material.rgba[i] =
          to_srgb(from_srgb(material.rgba[i]) * double{colours.front()[static_cast<int>(i)]});
  } else if (triangles_of_colours_ + triangles.size() > most_triangles_of_colours) {
    ++colours_left_out_["at most " + std::to_string(most_triangles_of_colours) +
                        " triangles are shown with them"];
    return;
  } else {
    triangles_of_colours_ += triangles.size();
    material.picture.image = picture_of_colours(colours, triangles);
    made.uvs.clear();
    made.uv_of.clear();
    add_colour_coordinates(triangles.size(), made);
  }
  made.material_of.assign(triangles.size(),
                          static_cast<std::uint32_t>(all().size() + of_colours_.size()));
  of_colours_.push_back(std::move(material));
}

std::optional<Rgba> GltfLooks::colour_of(const Json& primitive, const JsonPath& path) {
  const auto material = document_.index(primitive, path, "material", "materials");
  const Json* attributes = object_in(&primitive, "attributes");
  const auto accessor =
      attributes ? document_.index(*attributes, path / "attributes", "COLOR_0", "accessors")
                 : std::nullopt;
  if (!material && !accessor) return std::nullopt;
  const MeshMaterial look = material ? all()[*material].material : MeshMaterial();
  Rgba rgba = look.rgba;
  if (!accessor || look.has_picture()) return rgba;
  const auto [mean, is_new] = means_.try_emplace(*accessor, Vec3<double>::Ones());
  if (is_new)
    if (const auto colours = document_.colours(*accessor)) {
      mean->second.setZero();
      for (const Vec3<float>& colour : *colours)
        mean->second += colour.cast<double>() / static_cast<double>(colours->size());
    }
  for (std::size_t i = 0; i < 3; ++i)
    rgba[i] = to_srgb(from_srgb(rgba[i]) * mean->second[static_cast<int>(i)]);
  return rgba;
}

MeshAttributes GltfLooks::attributes_of(const Json& primitive, const JsonPath& path,
                                        std::size_t count, std::span<const std::uint32_t> used,
                                        std::span<const MeshAttributes::Numbers> triangles) {
  MeshAttributes made;
  const Json& attributes = primitive.at("attributes");
  const JsonPath at = path / "attributes";
  const auto has_count = [&](const std::string& key, std::size_t its) {
    if (its != count)
      document_.mistakes().add(at / key, "must have as many items as POSITION, " +
                                             std::to_string(count) + " (got " +
                                             std::to_string(its) + ")");
    return its == count;
  };
  const std::vector<MeshAttributes::Numbers> numbers(triangles.begin(), triangles.end());
  if (const auto accessor = document_.index(attributes, at, "NORMAL", "accessors")) {
    const auto normals = document_.points(*accessor);
    if (normals && has_count("NORMAL", normals->size())) {
      for (const std::uint32_t i : used) made.normals.push_back(attribute_normal((*normals)[i]));
      made.normal_of = numbers;
    }
  }
  const auto material = document_.index(primitive, path, "material", "materials");
  if (material) made.material_of.assign(triangles.size(), static_cast<std::uint32_t>(*material));
  const GltfLook look = material ? all()[*material] : GltfLook();
  const std::string key = "TEXCOORD_" + std::to_string(look.uv_set);
  if (look.material.has_picture() || attributes.contains(key)) {
    const auto accessor = document_.index(attributes, at, key, "accessors");
    const auto uvs = accessor ? document_.pairs(*accessor) : std::nullopt;
    if (uvs && has_count(key, uvs->size())) {
      const double c = std::cos(look.rotation), s = std::sin(look.rotation);
      for (const std::uint32_t i : used) {
        const double u = look.scale[0] * (*uvs)[i][0], v = look.scale[1] * (*uvs)[i][1];
        made.uvs.push_back({static_cast<float>(c * u + s * v + look.offset[0]),
                            static_cast<float>(c * v - s * u + look.offset[1])});
      }
      made.uv_of = numbers;
    }
  }
  add_colours(primitive, path, count, used, numbers, look, made);
  settle(made);
  return made;
}

}  // namespace minkray
