// SPDX-License-Identifier: MIT
#include "core/files/mesh_file.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

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

/// Editors on Windows begin UTF-8 with a mark.
std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  if (text.starts_with(mark)) text.remove_prefix(mark.size());
  return text;
}

/// Cuts the next line off the front of the text. Lines end by \n, \r\n, or as on old Macs by \r.
std::string_view next_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  text.remove_prefix(line.size());
  text.remove_prefix(std::min<std::size_t>(text.starts_with("\r\n") ? 2 : 1, text.size()));
  return line;
}

/// Cuts the next word off the front of the line.
std::string_view next_word(std::string_view& line) {
  const std::string_view blanks = " \t";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

std::string place(std::size_t line_number) {
  return "line " + std::to_string(line_number) + ": ";
}

/// True if the whole word is a number, which may have a plus sign.
template <class Number>
bool read_number(std::string_view word, Number& number) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.begin(), word.end(), number);
  return error == std::errc() && end == word.end();
}

/// The three coordinates at the front of the line.
Vec3<double> coordinates(std::string_view line, std::size_t line_number) {
  Vec3<double> vertex;
  for (double& coordinate : vertex) {
    if (!read_number(next_word(line), coordinate) || !std::isfinite(coordinate)) {
      throw std::runtime_error(place(line_number) + "a vertex must be three finite numbers");
    }
  }
  return vertex;
}

/// Makes triangles of faces that are given corner by corner; none if no triangles are wanted.
class TriangleFans {
 public:
  explicit TriangleFans(MeshTriangles* triangles) : triangles_(triangles) {}

  bool are_wanted() const { return triangles_ != nullptr; }

  /// The faces from here on are in this group.
  void begin_group(std::uint32_t group) { group_ = group; }

  void add_corner(std::size_t vertex) {
    // No file is large enough for a vertex beyond 32 bits: an OBJ that names one is refused.
    const auto corner = static_cast<std::uint32_t>(vertex);
    if (count_ == 0) first_ = corner;
    if (count_ >= 2) add_triangle(corner);
    last_ = corner;
    ++count_;
  }

  void end_face() {
    if (count_ == 1 || count_ == 2) add_triangle(last_);
    count_ = 0;
  }

 private:
  void add_triangle(std::uint32_t corner) {
    if (!are_wanted()) return;
    triangles_->corners.push_back({first_, last_, corner});
    triangles_->groups.push_back(group_);
  }

  MeshTriangles* triangles_;
  std::uint32_t group_ = 0;
  std::size_t count_ = 0;  // corners of the face so far
  std::uint32_t first_ = 0, last_ = 0;
};

/// Numbers the groups of an OBJ, one for each pair of an object's and a group's name. Faces above
/// the first name have none, as do the faces below a "g" alone.
class ObjGroups {
 public:
  ObjGroups() { number(); }

  /// The number of what is below the keyword, "o" or "g", and its name on the rest of the line,
  /// which may be several words. An object begins without a group.
  std::uint32_t below(std::string_view keyword, std::string_view line) {
    if (keyword == "o") object_.clear();
    group_.clear();
    std::string& name = keyword == "o" ? object_ : group_;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      if (!name.empty()) name += ' ';
      name += word;
    }
    return number();
  }

 private:
  std::uint32_t number() {
    const auto next = static_cast<std::uint32_t>(numbers_.size());
    return numbers_.emplace(std::pair(object_, group_), next).first->second;
  }

  std::string object_, group_;
  std::map<std::pair<std::string, std::string>, std::uint32_t> numbers_;
};

/// The vertices that the faces of an OBJ name. Vertices may follow the faces: only at the end is
/// it known which are missing.
class ObjFaces {
 public:
  explicit ObjFaces(TriangleFans& fans) : fans_(&fans) {}

  /// Takes the words of a face ("7", "7/1", "7//2" or "-1/2/3"), with `count` vertices above it.
  void add(std::string_view line, std::size_t count, std::size_t line_number) {
    for (;;) {
      const std::string_view word = next_word(line);
      if (word.empty()) break;
      long long index = 0;
      if (!read_number(word.substr(0, word.find('/')), index) || index == 0) {
        throw std::runtime_error(place(line_number) +
                                 "a face must name its vertices by whole numbers, from 1 or -1 on");
      }
      if (index < 0 && count < std::size_t{0} - static_cast<std::size_t>(index)) {
        throw std::runtime_error(place(line_number) + "a face names vertex " +
                                 std::to_string(index) + ", but there are " +
                                 std::to_string(count) + " vertices above it");
      }
      if (index > largest_) {
        largest_ = index;
        line_of_largest_ = line_number;
      }
      const auto offset = static_cast<std::size_t>(index);
      fans_->add_corner(index < 0 ? count + offset : offset - 1);
    }
    fans_->end_face();
  }

  /// All faces must find theirs among `count` vertices.
  void check(std::size_t count) const {
    if (largest_ == 0 || static_cast<std::size_t>(largest_) <= count) return;
    throw std::runtime_error(place(line_of_largest_) + "a face names vertex " +
                             std::to_string(largest_) + ", but the file has " +
                             std::to_string(count) + " vertices (is it cut off?)");
  }

 private:
  TriangleFans* fans_;
  long long largest_ = 0;
  std::size_t line_of_largest_ = 0;
};

/// The next line of an OBJ without its comment and the blanks at its end.
std::string_view next_obj_line(std::string_view& text) {
  std::string_view line = next_line(text);
  line = line.substr(0, line.find('#'));
  return line.substr(0, line.find_last_not_of(" \t") + 1);
}

Vertices vertices_of_obj(std::string_view text, TriangleFans fans) {
  Vertices vertices;
  ObjFaces faces(fans);
  ObjGroups groups;
  std::string whole_line;
  text = without_byte_order_mark(text);
  for (std::size_t lines_read = 0; !text.empty();) {
    const std::size_t line_number = ++lines_read;
    std::string_view line = next_obj_line(text);
    std::string_view word = next_word(line);
    if (fans.are_wanted() && (word == "o" || word == "g"))
      fans.begin_group(groups.below(word, line));
    // A backslash at its end joins the next line, to the keyword alone, too. Only here: the path in
    // "mtllib C:\a\" does not.
    if (line.empty() && (word == "v\\" || word == "f\\")) {
      line = word.substr(1);
      word.remove_suffix(1);
    }
    if (word != "v" && word != "f") continue;

    whole_line = line;
    for (; whole_line.ends_with('\\') && !text.empty(); ++lines_read) {
      whole_line.back() = ' ';
      whole_line += next_obj_line(text);
    }
    if (whole_line.ends_with('\\')) {
      throw std::runtime_error(place(line_number) + "is cut off: no line follows its \"\\\"");
    }
    if (word == "v") vertices.push_back(coordinates(whole_line, line_number));
    if (word == "f") faces.add(whole_line, vertices.size(), line_number);
  }
  if (!vertices.empty()) faces.check(vertices.size());
  return vertices;
}

/// True if the word is the keyword, given in small letters: "VERTEX" is "vertex", too.
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

/// The facets behind a solid's name on the same line, if any. A name may be any words but "facet
/// normal", keywords and # too.
std::string_view behind_name(std::string_view line) {
  while (!line.empty() && !begins_facet(line)) next_word(line);
  return line;
}

/// There may be several solids, each from its "solid" to its "endsolid". The first line that is
/// neither blank nor a comment must begin with "solid"; anything but facets may follow between and
/// behind solids. The corners of a facet are those before the next facet, or before the end of
/// this one.
Vertices vertices_of_text_stl(std::string_view text, TriangleFans fans) {
  Vertices vertices;
  std::uint32_t solids_read = 0;
  std::size_t line_of_solid = 0;  // 0 outside of solids
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    std::string_view line = next_line(text);
    if (line_of_solid == 0) {
      if (begins_facet(line)) {
        throw std::runtime_error(place(line_number) +
                                 "a facet must be between \"solid\" and \"endsolid\"");
      }
      // At the end of the file even "sol" begins a solid: one that is cut off.
      const std::string_view word = next_word(line);
      const std::size_t length = text.empty() && line.empty() ? word.size() : solid.size();
      if (word.empty() || !is_keyword(word.substr(0, solid.size()), solid.substr(0, length)))
        continue;
      line_of_solid = line_number;
      line = behind_name(line);
    }
    // Word by word, for some files are a single line.
    while (line_of_solid != 0) {
      const bool ends = begins_endsolid(line);
      const std::string_view word = next_word(line);
      if (word.empty() || word[0] == '#') break;
      if (is_keyword(word, "vertex")) {
        fans.add_corner(vertices.size());
        vertices.push_back(coordinates(line, line_number));
      }
      if (ends || is_keyword(word, "facet") || is_keyword(word, "endfacet")) fans.end_face();
      if (!ends) continue;
      fans.begin_group(++solids_read);
      // Facets on the line of an "endsolid" are the next solid's.
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

/// True if an STL is text. Beginning with "solid" is no test: binary files do so, too. But the
/// highest byte of their number of triangles is zero, since larger ones are not read, and text
/// with a facet has no zero that early.
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
  // Some programs fill up the file behind the triangles.
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
      fans.add_corner(vertices.size());
      vertices.push_back(corner);
    }
    fans.end_face();
  }
  return vertices;
}

}  // namespace

Vertices read_mesh_vertices(const std::filesystem::path& path, MeshTriangles* triangles) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension != ".obj" && extension != ".stl") {
    throw std::runtime_error("must be a mesh file that ends in .obj or .stl");
  }
  return mesh_vertices(read_regular_file(path, most_bytes),
                       extension == ".obj" ? MeshFormat::obj : MeshFormat::stl, triangles);
}

Vertices mesh_vertices(std::string_view contents, MeshFormat format, MeshTriangles* triangles) {
  const TriangleFans fans(triangles);
  Vertices vertices = format == MeshFormat::obj ? vertices_of_obj(contents, fans)
                      : is_text_stl(contents)
                          ? vertices_of_text_stl(without_byte_order_mark(contents), fans)
                          : vertices_of_binary_stl(contents, fans);
  if (vertices.empty()) throw std::runtime_error("has no vertices");
  return vertices;
}

}  // namespace minkray
