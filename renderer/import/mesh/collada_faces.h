// SPDX-License-Identifier: MIT
// Polygons of a COLLADA mesh as triangles, with their normals, texture coordinates and materials.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/files/mesh_attributes.h"
#include "renderer/import/model/xml.h"

namespace minkray {

/// Positions of vectors in an array of numbers.
struct ColladaVectors {
  const std::vector<double>* numbers;
  std::size_t begin, stride, count;

  const double* at(std::size_t i) const { return numbers->data() + begin + i * stride; }
};

/// Finds the vectors of `width` numbers that an <input> names; nothing if there are none.
using ColladaSource =
    std::function<std::optional<ColladaVectors>(const XmlElement& input, std::size_t width)>;

/// Larger numbers of vertices are refused.
inline constexpr std::size_t most_collada_vertices = 20'000'000;

struct ColladaFaces {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::size_t corners_end = 0;  ///< beyond all vertices that they name
  MeshAttributes attributes;    ///< settled; materials by the numbers of the symbols
  std::vector<std::string> symbols;
};

/// Polygons are fans of triangles. Throws std::runtime_error where one names no vertex.
ColladaFaces read_collada_faces(const XmlElement& mesh, XmlFiles& files, bool with_attributes,
                                const ColladaSource& source);

}  // namespace minkray
