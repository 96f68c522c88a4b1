// SPDX-License-Identifier: MIT
#include "renderer/scene_json/material_names.h"

#include "renderer/json/object_reader.h"
#include "renderer/json/values.h"
#include "renderer/member_json/read_paint.h"

namespace minkray {
namespace {

/// Longer ones are those of textures.
constexpr std::size_t longest_colour = 60;

}  // namespace

bool MaterialNames::add(Material material, const JsonPath& path, Mistakes& mistakes) {
  const auto index = static_cast<std::uint32_t>(scene_.materials.size());
  if (!index_.emplace(material.name, index).second) {
    mistakes.add(path / "name",
                 "duplicate material (got \"" + printable(material.name, 60) + "\" again)");
    return false;
  }
  scene_.materials.push_back(std::move(material));
  return true;
}

std::uint32_t MaterialNames::named(const Json& json, const JsonPath& path,
                                   Mistakes& mistakes) const {
  const auto name = read_string(json, path, mistakes);
  if (!name) return 0;
  const auto material = index_.find(*name);
  if (material != index_.end()) return material->second;
  std::vector<std::string> names;
  for (const auto& [known, index] : index_) {
    names.resize(std::max<std::size_t>(names.size(), index + 1));
    names[index] = printable(known, 60);
  }
  mistakes.add(path, "must be the name of a material (" + found(json) + "; " +
                         suggestion(*name, names) + ")");
  return 0;
}

std::uint32_t MaterialNames::of_colour(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                       MeshFiles& files, const std::string& file) {
  const std::string written = json.is_string() ? json.text() : json.dump();
  const std::string key = json.is_object() ? file + '\n' + written : written;
  if (const auto known = of_colours_.find(key); known != of_colours_.end()) return known->second;
  const auto paint = read_paint(json, path, mistakes, Range::zero_to_one, files);
  if (!paint) return 0;
  return of_colours_[key] = add_made(
             "color " + (written.size() > longest_colour ? std::to_string(of_colours_.size() + 1)
                                                         : written),
             *paint);
}

std::uint32_t MaterialNames::of_file(const std::string& name, const void* file,
                                     const Paint& paint) {
  const auto [at, is_new] = of_files_.emplace(std::pair(file, name), 0);
  if (is_new) at->second = add_made(printable(name, 60), paint);
  return at->second;
}

std::uint32_t MaterialNames::default_one() {
  const auto [at, is_new] = of_colours_.emplace("", 0);
  if (is_new) at->second = add_made("default", default_colour);
  return at->second;
}

std::uint32_t MaterialNames::add_made(const std::string& name, const Paint& paint) {
  const auto index = static_cast<std::uint32_t>(scene_.materials.size());
  std::string free = name;
  while (!index_.emplace(free, index).second) free += "'";
  scene_.materials.push_back({free, LambertMaterial{paint}});
  return index;
}

}  // namespace minkray
