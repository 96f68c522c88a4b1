// SPDX-License-Identifier: MIT
#include "core/files/obj_file.h"

#include <limits>
#include <map>
#include <utility>

#include "core/files/text.h"

namespace minkray {
namespace {

/// Numbers the groups of an OBJ file: one per pair of an object's and a group's name. Faces above
/// the first name have no group, nor do faces below a "g" without a name.
class ObjGroups {
 public:
  ObjGroups() { number(); }

  /// Returns the number of the group that a line begins. `keyword` is "o" or "g"; the name is the
  /// rest of the line, and may have several words. An object begins without a group.
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

/// Reads the attributes of an OBJ file. Leaves invalid ones for settle() to count.
class ObjAttributes {
 public:
  explicit ObjAttributes(TriangleFans& fans) : fans_(&fans), all_(fans.attributes()) {}

  bool are_wanted() const { return all_ != nullptr; }
  static bool is_keyword(std::string_view word) { return word == "vn" || word == "vt"; }

  void add(std::string_view keyword, std::string_view line) {
    if (keyword == "vn") {
      Vec3<double> normal = Vec3<double>::Zero();
      bool is_good = true;
      for (double& x : normal) is_good = is_good && read_number(bare_number(next_word(line)), x);
      all_->normals.push_back(is_good ? attribute_normal(normal) : Vec3<float>::Zero());
    } else {
      std::array<float, 2> uv = {0, 0};
      constexpr float bad = std::numeric_limits<float>::quiet_NaN();
      if (!read_number(bare_number(next_word(line)), uv[0])) uv[0] = bad;
      const std::string_view v = next_word(line);
      if (!v.empty() && !read_number(bare_number(v), uv[1])) uv[1] = bad;
      all_->uvs.push_back({uv[0], 1 - uv[1]});
    }
  }

  /// Reads "/1/2" after a corner's vertex.
  void read(std::string_view rest, FaceCorner& corner) const {
    if (!rest.starts_with('/')) return;
    rest.remove_prefix(1);
    const std::size_t end = std::min(rest.find('/'), rest.size());
    corner.uv = number(rest.substr(0, end), all_->uvs.size());
    rest.remove_prefix(std::min(end + 1, rest.size()));
    corner.normal = number(rest.substr(0, rest.find('/')), all_->normals.size());
  }

  /// Reads "usemtl NAME" and "mtllib NAME".
  void take_name(std::string_view keyword, std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const std::string name(line);
    if (keyword == "mtllib") {
      all_->libraries.push_back(name);
      return;
    }
    const auto next = static_cast<std::uint32_t>(materials_.size());
    const auto [at, is_new] = materials_.emplace(name, next);
    if (is_new) all_->materials.push_back(name);
    fans_->begin_material(at->second);
  }

 private:
  /// Returns an index from 0. An invalid number gives an index that no item has, and that is not
  /// `none`.
  static std::uint32_t number(std::string_view word, std::size_t count) {
    constexpr std::uint32_t wrong = MeshAttributes::none - 1;
    if (word.empty()) return MeshAttributes::none;
    long long index = 0;
    if (!read_number(bare_number(word), index) || index == 0) return wrong;
    if (index < 0) index += static_cast<long long>(count) + 1;
    return index > 0 && index < static_cast<long long>(wrong)
               ? static_cast<std::uint32_t>(index - 1)
               : wrong;
  }

  TriangleFans* fans_;
  MeshAttributes* all_;
  std::map<std::string, std::uint32_t> materials_;
};

/// The vertices that the faces of an OBJ file name. Vertices may follow the faces, so missing
/// vertices are known only at the end.
class ObjFaces {
 public:
  ObjFaces(TriangleFans& fans, const ObjAttributes& attributes)
      : fans_(&fans), attributes_(&attributes) {}

  /// Takes the words of a face ("7", "7/1", "7//2" or "-1/2/3"). `count` is the number of vertices
  /// above.
  void add(std::string_view line, std::size_t count, std::size_t line_number) {
    for (;;) {
      const std::string_view word = next_word(line);
      if (word.empty()) break;
      long long index = 0;
      if (!read_number(bare_number(word.substr(0, word.find('/'))), index) || index == 0) {
        throw std::runtime_error(place_of_line(line_number) +
                                 "a face must name its vertices by whole numbers, from 1 or -1 on");
      }
      if (index < 0 && count < std::size_t{0} - static_cast<std::size_t>(index)) {
        throw std::runtime_error(place_of_line(line_number) + "a face names vertex " +
                                 std::to_string(index) + ", but there are " +
                                 std::to_string(count) + " vertices above it");
      }
      if (index > largest_) {
        largest_ = index;
        line_of_largest_ = line_number;
      }
      const auto offset = static_cast<std::size_t>(index);
      // No file can have this many vertices: check() rejects numbers beyond 32 bits.
      FaceCorner corner{.vertex =
                            static_cast<std::uint32_t>(index < 0 ? count + offset : offset - 1)};
      if (attributes_->are_wanted())
        attributes_->read(word.substr(std::min(word.find('/'), word.size())), corner);
      fans_->add_corner(corner);
    }
    fans_->end_face();
  }

  /// Checks that all faces name vertices among the first `count`.
  void check(std::size_t count) const {
    if (largest_ == 0 || static_cast<std::size_t>(largest_) <= count) return;
    throw std::runtime_error(place_of_line(line_of_largest_) + "a face names vertex " +
                             std::to_string(largest_) + ", but the file has " +
                             std::to_string(count) + " vertices (is it cut off?)");
  }

 private:
  TriangleFans* fans_;
  const ObjAttributes* attributes_;
  long long largest_ = 0;
  std::size_t line_of_largest_ = 0;
};

/// Returns the next line of an OBJ file without its comment and the blanks at its end.
std::string_view next_obj_line(std::string_view& text) {
  std::string_view line = next_line(text);
  line = line.substr(0, line.find('#'));
  return line.substr(0, line.find_last_not_of(" \t") + 1);
}

}  // namespace

std::vector<Vec3<double>> vertices_of_obj(std::string_view text, TriangleFans fans) {
  std::vector<Vec3<double>> vertices;
  ObjAttributes attributes(fans);
  ObjFaces faces(fans, attributes);
  ObjGroups groups;
  std::string whole_line;
  text = without_byte_order_mark(text);
  for (std::size_t lines_read = 0; !text.empty();) {
    const std::size_t line_number = ++lines_read;
    std::string_view line = next_obj_line(text);
    std::string_view word = next_word(line);
    if (fans.are_wanted() && (word == "o" || word == "g"))
      fans.begin_group(groups.below(word, line));
    if (attributes.are_wanted() && (word == "usemtl" || word == "mtllib"))
      attributes.take_name(word, line);
    // A backslash at the end of a line joins the next line, also if the line is only a keyword. For
    // other keywords it does not: the path in "mtllib C:\a\" ends with a backslash.
    if (line.empty() && (word == "v\\" || word == "f\\")) {
      line = word.substr(1);
      word.remove_suffix(1);
    }
    const bool is_attribute = attributes.are_wanted() && ObjAttributes::is_keyword(word);
    if (word != "v" && word != "f" && !is_attribute) continue;

    whole_line = line;
    for (; whole_line.ends_with('\\') && !text.empty(); ++lines_read) {
      whole_line.back() = ' ';
      whole_line += next_obj_line(text);
    }
    if (whole_line.ends_with('\\')) {
      throw std::runtime_error(place_of_line(line_number) +
                               "is cut off: no line follows its \"\\\"");
    }
    if (word == "v") vertices.push_back(coordinates(whole_line, line_number));
    if (is_attribute) attributes.add(word, whole_line);
    if (word == "f") faces.add(whole_line, vertices.size(), line_number);
  }
  if (!vertices.empty()) faces.check(vertices.size());
  return vertices;
}

}  // namespace minkray
