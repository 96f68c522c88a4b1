// SPDX-License-Identifier: MIT
#include "core/shape/mesh_file.h"

#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "core/files/regular_file.h"

namespace minkray {
namespace {

using Vertices = std::vector<Vec3<double>>;

/// Binary STL: a header, the number of triangles, then for each a normal, three corners, and an
/// attribute.
constexpr std::size_t stl_header_bytes = 80;
constexpr std::size_t stl_triangle_bytes = 50;
constexpr std::size_t stl_corners_offset = 12;

/// More than any mesh worth a convex hull; its vertices take about twice as much memory.
constexpr std::size_t most_bytes = std::size_t{512} << 20;

/// Cuts the next word off the front of the line.
std::string_view next_word(std::string_view& line) {
  const std::string_view blanks = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

/// The three coordinates at the front of the line.
Vec3<double> coordinates(std::string_view line, std::size_t line_number) {
  Vec3<double> vertex;
  for (double& coordinate : vertex) {
    std::string_view word = next_word(line);
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.begin(), word.end(), coordinate);
    if (word.empty() || error != std::errc() || end != word.end() || !std::isfinite(coordinate)) {
      throw std::runtime_error("line " + std::to_string(line_number) +
                               ": a vertex must be three finite numbers");
    }
  }
  return vertex;
}

/// The vertices of all lines that begin with the keyword: "v" in OBJ, "vertex" in STL.
Vertices vertices_of_lines(std::string_view text, std::string_view keyword) {
  Vertices vertices;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (next_word(line) == keyword) vertices.push_back(coordinates(line, line_number));
  }
  return vertices;
}

std::uint32_t little_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// Whether the file is exactly as long as its number of triangles says. (Not whether it begins
/// with "solid": binary files do so, too.)
bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= stl_header_bytes + 4 &&
         bytes.size() == stl_header_bytes + 4 +
                             stl_triangle_bytes * little_endian(bytes.substr(stl_header_bytes));
}

Vertices vertices_of_binary_stl(std::string_view bytes) {
  Vertices vertices;
  for (std::size_t triangle = stl_header_bytes + 4; triangle < bytes.size();
       triangle += stl_triangle_bytes) {
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
      vertices.push_back(corner);
    }
  }
  return vertices;
}

}  // namespace

Vertices read_mesh_vertices(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension != ".obj" && extension != ".stl") {
    throw std::runtime_error("must be a mesh file that ends in .obj or .stl");
  }
  return mesh_vertices(read_regular_file(path, most_bytes),
                       extension == ".obj" ? MeshFormat::obj : MeshFormat::stl);
}

Vertices mesh_vertices(std::string_view text, MeshFormat format) {
  Vertices vertices = format == MeshFormat::obj ? vertices_of_lines(text, "v")
                      : is_binary_stl(text)     ? vertices_of_binary_stl(text)
                                                : vertices_of_lines(text, "vertex");
  if (vertices.empty()) throw std::runtime_error("has no vertices");
  return vertices;
}

}  // namespace minkray
