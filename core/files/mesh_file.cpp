// SPDX-License-Identifier: MIT
#include "core/files/mesh_file.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/files/obj_file.h"
#include "core/files/regular_file.h"
#include "core/files/text.h"
#include "core/files/triangle_fans.h"

namespace minkray {
namespace {

using Vertices = std::vector<Vec3<double>>;

/// Binary STL: a header, the number of triangles, then for each a normal, three corners, and an
/// attribute.
constexpr std::size_t stl_header_bytes = 80;
constexpr std::size_t stl_triangle_bytes = 50;
constexpr std::size_t stl_corners_offset = 12;

/// Limit of file sizes, larger than any mesh worth a convex hull. Vertices take about twice this
/// memory.
constexpr std::size_t most_bytes = std::size_t{512} << 20;

/// True if the word is the keyword in lower or upper case. `keyword` is in lower case.
bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char a, char b) { return (a | 0x20) == b; });
}

constexpr std::string_view solid = "solid";
constexpr std::string_view endsolid = "endsolid";

/// True if the words begin with "facet normal".
bool begins_facet(std::string_view line) {
  return is_keyword(next_word(line), "facet") && is_keyword(next_word(line), "normal");
}

/// True if the words begin with "endsolid" or "end solid". A zero or a Ctrl-Z may be attached.
bool begins_endsolid(std::string_view line) {
  const std::string_view word = next_word(line);
  return is_keyword(word.substr(0, endsolid.size()), endsolid) ||
         (is_keyword(word, "end") && is_keyword(next_word(line).substr(0, solid.size()), solid));
}

/// Returns the facets after a solid's name on the same line, if any. A name may contain keywords
/// and #, but not the words "facet normal".
std::string_view behind_name(std::string_view line) {
  while (!line.empty() && !begins_facet(line)) next_word(line);
  return line;
}

/// Reads one or more solids, each from its "solid" to its "endsolid". The first line that is
/// neither blank nor a comment must begin with "solid". Between and after solids, anything but
/// facets may follow. The corners of a facet are those before the next facet, or before its own
/// end.
Vertices vertices_of_text_stl(std::string_view text, TriangleFans fans) {
  Vertices vertices;
  std::uint32_t solids_read = 0;
  std::size_t line_of_solid = 0;  // 0 outside of solids
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    std::string_view line = next_line(text);
    if (line_of_solid == 0) {
      if (begins_facet(line)) {
        throw std::runtime_error(place_of_line(line_number) +
                                 "a facet must be between \"solid\" and \"endsolid\"");
      }
      // At the end of the file, even "sol" begins a solid: a truncated one.
      const std::string_view word = next_word(line);
      const std::size_t length = text.empty() && line.empty() ? word.size() : solid.size();
      if (word.empty() || !is_keyword(word.substr(0, solid.size()), solid.substr(0, length)))
        continue;
      line_of_solid = line_number;
      line = behind_name(line);
    }
    // Reads word by word, since some files are a single line.
    while (line_of_solid != 0) {
      const bool ends = begins_endsolid(line);
      const std::string_view word = next_word(line);
      if (word.empty() || word[0] == '#') break;
      if (is_keyword(word, "vertex")) {
        fans.add_corner({.vertex = static_cast<std::uint32_t>(vertices.size())});
        vertices.push_back(coordinates(line, line_number));
      }
      if (ends || is_keyword(word, "facet") || is_keyword(word, "endfacet")) fans.end_face();
      if (!ends) continue;
      fans.begin_group(++solids_read);
      // Facets on the line of an "endsolid" belong to the next solid.
      line = behind_name(line);
      line_of_solid = line.empty() ? 0 : line_number;
    }
  }
  if (line_of_solid != 0) {
    throw std::runtime_error("is cut off: the solid of line " + std::to_string(line_of_solid) +
                             " has no \"endsolid\"");
  }
  return vertices;
}

std::uint32_t little_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// True if an STL file is text. The word "solid" at the beginning decides nothing, since binary
/// files may have it, too. But in binary files the highest byte of the number of triangles is zero,
/// since larger files are not read. Text with a facet has no zero byte that early.
bool is_text_stl(std::string_view bytes) {
  constexpr std::size_t highest_byte = stl_header_bytes + 3;
  if (bytes.size() > highest_byte && bytes[highest_byte] == '\0') return false;
  static_assert(most_bytes / stl_triangle_bytes < std::size_t{1} << 24);
  for (std::string_view text = without_byte_order_mark(bytes); !text.empty();) {
    std::string_view line = next_line(text);
    const std::string_view word = next_word(line);
    if (!word.empty() && word[0] != '#') return is_keyword(word.substr(0, solid.size()), solid);
  }
  return false;
}

Vertices vertices_of_binary_stl(std::string_view bytes, TriangleFans fans) {
  constexpr std::size_t least_bytes = stl_header_bytes + 4;
  const std::string got = " (got " + std::to_string(bytes.size());
  const std::size_t triangles =
      bytes.size() < least_bytes ? 0 : little_endian(bytes.substr(stl_header_bytes));
  if (bytes.size() < least_bytes) {
    throw std::runtime_error("must begin with \"solid\", or be a binary STL of at least " +
                             std::to_string(least_bytes) + " bytes" + got + ")");
  }
  if (triangles > most_bytes / stl_triangle_bytes) {
    throw std::runtime_error(
        "must begin with \"solid\", or be a binary STL: its triangle count must be at most " +
        std::to_string(most_bytes / stl_triangle_bytes) + " (got " + std::to_string(triangles) +
        ", in a file that has room for " +
        std::to_string((bytes.size() - least_bytes) / stl_triangle_bytes) + ")");
  }
  const std::size_t expected = least_bytes + stl_triangle_bytes * triangles;
  if (bytes.size() < expected) {
    throw std::runtime_error("a binary STL of " + std::to_string(triangles) +
                             " triangles must have at least " + std::to_string(expected) +
                             " bytes" + got + ")");
  }
  // Some programs append data after the triangles.
  Vertices vertices;
  for (std::size_t triangle = least_bytes; triangle < expected; triangle += stl_triangle_bytes) {
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3<double> corner;
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t offset =
            triangle + stl_corners_offset + 12 * i + 4 * static_cast<std::size_t>(axis);
        corner[axis] = std::bit_cast<float>(little_endian(bytes.substr(offset)));
      }
      if (!corner.allFinite()) {
        throw std::runtime_error("triangle " + std::to_string(vertices.size() / 3 + 1) +
                                 ": a vertex must be three finite numbers");
      }
      fans.add_corner({.vertex = static_cast<std::uint32_t>(vertices.size())});
      vertices.push_back(corner);
    }
    fans.end_face();
  }
  return vertices;
}

}  // namespace

Vertices read_mesh_vertices(const std::filesystem::path& path, MeshTriangles* triangles,
                            MeshAttributes* attributes) {
  const std::string extension = lower_ending(path);
  if (extension != ".obj" && extension != ".stl") {
    throw std::runtime_error("must be a mesh file that ends in .obj or .stl");
  }
  return mesh_vertices(read_regular_file(path, most_bytes),
                       extension == ".obj" ? MeshFormat::obj : MeshFormat::stl, triangles,
                       attributes);
}

Vertices mesh_vertices(std::string_view contents, MeshFormat format, MeshTriangles* triangles,
                       MeshAttributes* attributes) {
  const TriangleFans fans(triangles, format == MeshFormat::obj ? attributes : nullptr);
  Vertices vertices = format == MeshFormat::obj ? vertices_of_obj(contents, fans)
                      : is_text_stl(contents)
                          ? vertices_of_text_stl(without_byte_order_mark(contents), fans)
                          : vertices_of_binary_stl(contents, fans);
  if (vertices.empty()) throw std::runtime_error("has no vertices");
  return vertices;
}

}  // namespace minkray
