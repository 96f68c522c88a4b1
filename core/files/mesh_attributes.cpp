// SPDX-License-Identifier: MIT
#include "core/files/mesh_attributes.h"

#include <algorithm>
#include <cmath>

namespace minkray {
namespace {

using Numbers = MeshAttributes::Numbers;
constexpr std::uint32_t none = MeshAttributes::none;

/// Omits triangles whose numbers are not all usable. Returns how many of these had any numbers.
template <class IsUsable>
std::size_t leave_out(std::vector<Numbers>& of, const IsUsable& is_usable) {
  std::size_t bad = 0, left = 0;
  for (Numbers& numbers : of) {
    if (std::ranges::all_of(numbers, is_usable)) {
      ++left;
    } else {
      bad += numbers == MeshAttributes::no_numbers ? 0 : 1;
      numbers = MeshAttributes::no_numbers;
    }
  }
  if (left == 0) of.clear();
  return bad;
}

/// Keeps the items that the triangles use, in their order, and renumbers them.
template <class Item>
void keep_some(const std::vector<Item>& all, const std::vector<Numbers>& of,
               std::span<const std::uint32_t> triangles, std::vector<Item>& kept,
               std::vector<Numbers>& kept_of) {
  if (of.empty()) return;
  std::vector<std::uint32_t> used;
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t i : of[t])
      if (i != none) used.push_back(i);
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  if (used.empty()) return;
  for (const std::uint32_t i : used) kept.push_back(all[i]);
  kept_of.reserve(triangles.size());
  for (const std::uint32_t t : triangles) {
    Numbers& numbers = kept_of.emplace_back(of[t]);
    for (std::uint32_t& i : numbers)
      if (i != none)
        i = static_cast<std::uint32_t>(std::ranges::lower_bound(used, i) - used.begin());
  }
}

template <class Item>
void append_some(std::vector<Item>& all, std::vector<Numbers>& of, std::size_t before,
                 const std::vector<Item>& more, const std::vector<Numbers>& more_of,
                 std::size_t count) {
  if (of.empty() && more_of.empty()) return;
  of.resize(before, MeshAttributes::no_numbers);
  const auto first = static_cast<std::uint32_t>(all.size());
  all.insert(all.end(), more.begin(), more.end());
  for (Numbers numbers : more_of) {
    for (std::uint32_t& i : numbers)
      if (i != none) i += first;
    of.push_back(numbers);
  }
  of.resize(before + count, MeshAttributes::no_numbers);
}

std::string unusable(std::size_t count, const char* what, const char* result) {
  return std::string(what) + " of " + std::to_string(count) +
         (count == 1 ? " triangle is" : " triangles are") +
         " unusable (missing, zero or not finite): " + result;
}

}  // namespace

Vec3<float> attribute_normal(const Vec3<double>& normal) {
  if (!normal.allFinite() || normal.isZero(0)) return Vec3<float>::Zero();
  return unit<double>(normal).cast<float>();
}

void settle(MeshAttributes& a) {
  a.bad_normals += leave_out(a.normal_of, [&](std::uint32_t i) {
    return i < a.normals.size() && !a.normals[i].isZero(0);
  });
  a.bad_uvs += leave_out(a.uv_of, [&](std::uint32_t i) {
    return i < a.uvs.size() && std::isfinite(a.uvs[i][0]) && std::isfinite(a.uvs[i][1]);
  });
  if (a.normal_of.empty()) a.normals.clear();
  if (a.uv_of.empty()) a.uvs.clear();
  if (std::ranges::all_of(a.material_of, [](std::uint32_t i) { return i == none; }))
    a.material_of.clear();
}

MeshAttributes attributes_of(const MeshAttributes& all, std::span<const std::uint32_t> triangles) {
  MeshAttributes some;
  keep_some(all.normals, all.normal_of, triangles, some.normals, some.normal_of);
  keep_some(all.uvs, all.uv_of, triangles, some.uvs, some.uv_of);
  if (!all.material_of.empty())
    for (const std::uint32_t t : triangles) some.material_of.push_back(all.material_of[t]);
  return some;
}

void append(MeshAttributes& all, std::size_t before, const MeshAttributes& more, std::size_t count,
            std::uint32_t first_material) {
  append_some(all.normals, all.normal_of, before, more.normals, more.normal_of, count);
  append_some(all.uvs, all.uv_of, before, more.uvs, more.uv_of, count);
  if (!all.material_of.empty() || !more.material_of.empty()) {
    all.material_of.resize(before, none);
    for (const std::uint32_t material : more.material_of)
      all.material_of.push_back(material == none ? none : material + first_material);
    all.material_of.resize(before + count, none);
  }
  all.bad_normals += more.bad_normals;
  all.bad_uvs += more.bad_uvs;
}

void map_normals(MeshAttributes& attributes, const Mat3<double>& inverse_transpose) {
  for (Vec3<float>& normal : attributes.normals)
    normal = attribute_normal(inverse_transpose * normal.cast<double>());
}

void swap_corners(MeshAttributes& attributes) {
  for (Numbers& numbers : attributes.normal_of) std::swap(numbers[1], numbers[2]);
  for (Numbers& numbers : attributes.uv_of) std::swap(numbers[1], numbers[2]);
}

std::vector<std::string> notes_of(const MeshAttributes& attributes) {
  std::vector<std::string> notes;
  if (attributes.bad_normals > 0)
    notes.push_back(unusable(attributes.bad_normals, "normals", "shaded flat"));
  if (attributes.bad_uvs > 0)
    notes.push_back(unusable(attributes.bad_uvs, "texture coordinates", "shown without texture"));
  return notes;
}

}  // namespace minkray
