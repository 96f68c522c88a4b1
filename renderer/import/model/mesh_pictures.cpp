// SPDX-License-Identifier: MIT
#include "renderer/import/model/mesh_pictures.h"

#include <exception>

#include "renderer/base/of_file.h"
#include "renderer/io/read_image.h"
#include "renderer/json/mistakes.h"

namespace minkray {

MeshPictures::Read MeshPictures::read(const MeshMaterial& material) {
  try {
    const std::int64_t most = most_image_pixels - pixels_;
    auto image = std::make_shared<const Image>(
        material.bytes ? read_image_bytes(*material.bytes, most) : read_image(material.file, most));
    pixels_ += static_cast<std::int64_t>(image->pixels.size());
    if (material.bytes) return {{"", std::move(image)}, ""};
    files_.push_back(material.file);
    return {
        {std::filesystem::absolute(material.file).lexically_normal().string(), std::move(image)},
        ""};
  } catch (const std::exception& error) {
    const std::string name =
        material.bytes ? "in the file" : printable(material.file.filename().string(), 100);
    return {{}, "its picture " + name + " is not shown: " + what_of(error)};
  }
}

void MeshPictures::read(MeshMaterial& material, std::vector<std::string>& notes) {
  if (!material.has_picture()) return;
  Read* found = nullptr;
  bool is_new = false;
  const auto look_up = [&](auto& known, const auto& key) {
    const auto [at, added] = known.try_emplace(key);
    found = &at->second;
    is_new = added;
  };
  if (material.bytes)
    look_up(of_bytes_, material.bytes);
  else
    look_up(of_files_, material.file);
  if (is_new) {
    *found = read(material);
    if (!found->complaint.empty()) notes.push_back(found->complaint);
  }
  material.picture = found->picture;
  if (!material.picture.image && material.without_picture)
    material.rgba = *material.without_picture;
}

}  // namespace minkray
