// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/msh.h"

#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "core/files/regular_file.h"

namespace minkray {
namespace {

constexpr std::size_t most_msh_bytes = std::size_t{512} << 20;

std::uint32_t word(std::string_view bytes, std::size_t i) {
  std::uint32_t value = 0;
  for (std::size_t k = 4; k-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[4 * i + k]);
  return value;
}

}  // namespace

MeshParts read_msh(const std::filesystem::path& file, MeshSplit split, MeshDetail detail) {
  const std::string bytes = read_regular_file(file, most_msh_bytes);
  if (bytes.size() < 16) throw std::runtime_error("a .msh must have at least 16 bytes");
  std::array<std::uint64_t, 4> counts;
  for (std::size_t i = 0; i < 4; ++i) counts[i] = word(bytes, i);
  const auto [vertices, normals, texture, faces] = counts;
  for (const std::uint64_t count : counts)
    if (count > most_msh_bytes / 4) throw std::runtime_error("a .msh with a count out of range");
  const std::uint64_t expected = 4 * (4 + 3 * vertices + 3 * normals + 2 * texture + 3 * faces);
  if (vertices == 0 || bytes.size() != expected)
    throw std::runtime_error("a .msh of " + std::to_string(vertices) + " vertices and " +
                             std::to_string(faces) + " faces must have " +
                             std::to_string(expected) + " bytes (got " +
                             std::to_string(bytes.size()) + ")");
  MeshParts mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    Vec3<double> vertex;
    for (std::size_t axis = 0; axis < 3; ++axis)
      vertex[static_cast<int>(axis)] = std::bit_cast<float>(word(bytes, 4 + 3 * i + axis));
    if (!vertex.allFinite())
      throw std::runtime_error("vertex " + std::to_string(i) + ": must be three finite numbers");
    mesh.vertices.push_back(vertex);
  }
  if (split == MeshSplit::components || detail != MeshDetail::vertices) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const std::size_t first = 4 + 3 * vertices + 3 * normals + 2 * texture;
    for (std::size_t i = 0; i < faces; ++i) {
      std::array<std::uint32_t, 3> triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        triangle[k] = word(bytes, first + 3 * i + k);
        if (triangle[k] >= vertices)
          throw std::runtime_error("face " + std::to_string(i) + " refers to a missing vertex");
      }
      triangles.push_back(triangle);
    }
    if (split == MeshSplit::components) mesh.parts = components_of(mesh.vertices, triangles);
    if (detail == MeshDetail::attributes) {
      const std::size_t first_normal = 4 + 3 * vertices, first_uv = first_normal + 3 * normals;
      const auto number = [&](std::size_t i) { return std::bit_cast<float>(word(bytes, i)); };
      MeshAttributes& made = mesh.attributes;
      for (std::size_t i = 0; i < normals; ++i) {
        const std::size_t at = first_normal + 3 * i;
        made.normals.push_back(attribute_normal(
            Vec3<float>(number(at), number(at + 1), number(at + 2)).cast<double>()));
      }
      for (std::size_t i = 0; i < texture; ++i)
        made.uvs.push_back({number(first_uv + 2 * i), 1 - number(first_uv + 2 * i + 1)});
      // One of each for each vertex; other counts leave numbers out of range, which are counted.
      if (normals > 0) made.normal_of = triangles;
      if (texture > 0) made.uv_of = triangles;
      settle(made);
    }
    if (detail != MeshDetail::vertices) mesh.triangles = std::move(triangles);
  }
  return mesh;
}

}  // namespace minkray
