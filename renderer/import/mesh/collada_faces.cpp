// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/collada_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace minkray {
namespace {

using FaceCorners = std::array<std::uint32_t, 3>;
constexpr std::uint32_t none = MeshAttributes::none;

/// An <input> of faces, or of the vertices that they name.
struct Input {
  const XmlElement* element = nullptr;
  std::size_t offset = 0;
};

/// The triangles of `count` corners, by the corners' places.
std::vector<FaceCorners> triangles_of(const std::string& kind, const std::vector<double>& counts,
                                      std::size_t count) {
  std::vector<FaceCorners> triangles;
  std::size_t begin = 0;
  const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
    triangles.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                         static_cast<std::uint32_t>(c)});
  };
  const auto add = [&](std::size_t corners) {
    const std::size_t end = std::min(begin + corners, count);
    for (std::size_t i = begin + 2; i < end; ++i) triangle(begin, i - 1, i);
    begin = end;
  };
  if (kind == "polylist") {
    for (const double corners : counts)
      add(static_cast<std::size_t>(std::clamp(corners, 0.0, 1e9)));
  } else if (kind == "triangles") {
    while (begin < count) add(3);
  } else if (kind == "tristrips") {
    for (std::size_t i = 0; i + 2 < count; ++i) triangle(i, i + 1 + i % 2, i + 2 - i % 2);
  } else {
    add(count);  // one polygon or fan
  }
  return triangles;
}

class FacesReader {
 public:
  FacesReader(const XmlElement& mesh, XmlFiles& files, bool with_attributes,
              const ColladaSource& source)
      : mesh_(mesh), files_(files), with_attributes_(with_attributes), source_(source) {}

  ColladaFaces read() {
    for (const XmlElement& faces : mesh_.children) read_list(faces);
    settle(made_.attributes);
    return std::move(made_);
  }

 private:
  void read_list(const XmlElement& faces) {
    std::size_t stride = 1;
    Input vertex, normal, uv;
    double lowest_set = 1e9;
    for (const XmlElement& input : faces.children) {
      if (input.name != "input") continue;
      const double at = std::clamp(files_.number(input, "offset").value_or(0), 0.0, 1000.0);
      const auto offset = static_cast<std::size_t>(at);
      stride = std::max(stride, offset + 1);
      const std::string semantic = input.attribute_or("semantic");
      if (semantic == "VERTEX") vertex = {&input, offset};
      if (!with_attributes_) continue;
      if (semantic == "NORMAL") normal = {&input, offset};
      // The first of several sets of coordinates is that of colours.
      if (semantic == "TEXCOORD") {
        const double set = files_.number(input, "set").value_or(0);
        if (set >= lowest_set) continue;
        lowest_set = set;
        uv = {&input, offset};
      }
    }
    if (!vertex.element) return;
    if (with_attributes_) find_at_vertices(vertex.offset, normal, uv);
    const std::uint32_t first_normal = normal.element ? add_normals(*normal.element) : none;
    const std::uint32_t first_uv = uv.element ? add_uvs(*uv.element) : none;
    const std::uint32_t material =
        with_attributes_ ? number_of(faces.attribute_or("material")) : none;
    std::vector<double> counts;
    if (const XmlElement* vcount = faces.child("vcount"))
      counts = files_.numbers_in(*vcount, vcount->text, "vcount", 0, most_collada_vertices)
                   .value_or(std::vector<double>());
    for (const XmlElement& list : faces.children) {
      if (list.name != "p") continue;
      const auto p = files_.numbers_in(list, list.text, "p", 0, 16 * most_collada_vertices);
      if (!p) continue;
      const std::vector<std::uint32_t> corners = corners_of(*p, vertex.offset, stride);
      const auto item = [&](std::uint32_t corner, std::uint32_t first, std::size_t count,
                            std::size_t offset) {
        const std::size_t place = corner * stride + offset;
        // A number that is wrong is one that no item has: settle() counts it.
        const bool is_good =
            place < p->size() && (*p)[place] >= 0 && (*p)[place] < static_cast<double>(count);
        return is_good ? first + static_cast<std::uint32_t>((*p)[place]) : none - 1;
      };
      for (const FaceCorners& places : triangles_of(faces.name, counts, corners.size())) {
        FaceCorners triangle, normals = MeshAttributes::no_numbers,
                              uvs = MeshAttributes::no_numbers;
        for (std::size_t k = 0; k < 3; ++k) {
          triangle[k] = corners[places[k]];
          if (first_normal != none)
            normals[k] = item(places[k], first_normal,
                              made_.attributes.normals.size() - first_normal, normal.offset);
          if (first_uv != none)
            uvs[k] = item(places[k], first_uv, made_.attributes.uvs.size() - first_uv, uv.offset);
        }
        made_.triangles.push_back(triangle);
        if (!with_attributes_) continue;
        made_.attributes.normal_of.push_back(normals);
        made_.attributes.uv_of.push_back(uvs);
        made_.attributes.material_of.push_back(material);
      }
    }
  }

  std::vector<std::uint32_t> corners_of(const std::vector<double>& p, std::size_t offset,
                                        std::size_t stride) {
    std::vector<std::uint32_t> corners;
    for (std::size_t i = offset; i < p.size(); i += stride) {
      if (!(p[i] >= 0 && p[i] < static_cast<double>(most_collada_vertices)))
        throw std::runtime_error("a <p> refers to a missing vertex");
      corners.push_back(static_cast<std::uint32_t>(p[i]));
      made_.corners_end = std::max<std::size_t>(made_.corners_end, corners.back() + 1);
    }
    return corners;
  }

  /// Attributes may be inputs of the vertices instead, with their numbers.
  void find_at_vertices(std::size_t offset, Input& normal, Input& uv) const {
    const XmlElement* vertices = mesh_.child("vertices");
    if (!vertices) return;
    for (const XmlElement& input : vertices->children) {
      if (input.name != "input") continue;
      const std::string semantic = input.attribute_or("semantic");
      if (semantic == "NORMAL" && !normal.element) normal = {&input, offset};
      if (semantic == "TEXCOORD" && !uv.element) uv = {&input, offset};
    }
  }

  /// Adds an input's vectors, once for each of its sources; returns the first one's number.
  std::uint32_t add_normals(const XmlElement& input) {
    const auto [at, is_new] = first_normals_.emplace(input.attribute_or("source"), none);
    if (!is_new) return at->second;
    const auto vectors = source_(input, 3);
    if (!vectors) return none;
    at->second = static_cast<std::uint32_t>(made_.attributes.normals.size());
    for (std::size_t i = 0; i < vectors->count; ++i) {
      const double* v = vectors->at(i);
      made_.attributes.normals.push_back(attribute_normal({v[0], v[1], v[2]}));
    }
    return at->second;
  }
  std::uint32_t add_uvs(const XmlElement& input) {
    const auto [at, is_new] = first_uvs_.emplace(input.attribute_or("source"), none);
    if (!is_new) return at->second;
    const auto vectors = source_(input, 2);
    if (!vectors) return none;
    at->second = static_cast<std::uint32_t>(made_.attributes.uvs.size());
    for (std::size_t i = 0; i < vectors->count; ++i) {
      const double* v = vectors->at(i);
      made_.attributes.uvs.push_back({static_cast<float>(v[0]), static_cast<float>(1 - v[1])});
    }
    return at->second;
  }

  std::uint32_t number_of(const std::string& symbol) {
    if (symbol.empty()) return none;
    const auto at = std::ranges::find(made_.symbols, symbol);
    const auto number = static_cast<std::uint32_t>(at - made_.symbols.begin());
    if (at == made_.symbols.end()) made_.symbols.push_back(symbol);
    return number;
  }

  const XmlElement& mesh_;
  XmlFiles& files_;
  bool with_attributes_;
  const ColladaSource& source_;
  ColladaFaces made_;
  std::map<std::string, std::uint32_t> first_normals_, first_uvs_;
};

}  // namespace

ColladaFaces read_collada_faces(const XmlElement& mesh, XmlFiles& files, bool with_attributes,
                                const ColladaSource& source) {
  return FacesReader(mesh, files, with_attributes, source).read();
}

}  // namespace minkray
