// SPDX-License-Identifier: MIT
// XML as a tree, read by tinyxml2: elements with line and file, and their numeric attributes. All
// errors are reported together, each with its line and file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/vec.h"
#include "renderer/json/mistakes.h"

namespace minkray {

struct XmlAttribute {
  std::string name, value;
};

struct XmlElement {
  std::string name;
  std::vector<XmlAttribute> attributes;
  std::string text;  ///< of the element itself, not of its children
  std::vector<XmlElement> children;
  int line = 0;
  std::uint32_t file = 0;  ///< into XmlFiles

  /// Attribute of that name, or null.
  const std::string* attribute(std::string_view key) const;
  /// Attribute of that name, or `otherwise`.
  std::string attribute_or(std::string_view key, std::string_view otherwise = {}) const;
  /// The first child of that name, or null.
  const XmlElement* child(std::string_view key) const;
};

/// Robots' files are some 10 MiB at most; meshes as XML are mostly numbers.
inline constexpr std::size_t most_xml_bytes = std::size_t{32} << 20;
inline constexpr std::size_t most_collada_bytes = std::size_t{256} << 20;
inline constexpr std::size_t most_xml_elements = 2'000'000;

/// Robots' formats have some fifty per element. Code that visits each of them, or compares each
/// with each, relies on there being few.
inline constexpr std::size_t most_xml_attributes = 200;

/// Longest name, class or prefix in bytes: few lines can make each body carry it.
inline constexpr std::size_t longest_xml_name = 1000;

/// Takes the prefix off names that a vendor has added to a format for what it could as well have:
/// <drake:capsule>, <drake:joint>, drake:type="planar".
void drop_vendor_prefixes(XmlElement& root);

/// The files that one model was read from, and what is wrong with them.
class XmlFiles {
 public:
  explicit XmlFiles(Mistakes& mistakes) : mistakes_(mistakes) {}

  /// Runs `read`. Returns what is wrong with what it reads; empty: nothing. The caller leaves that
  /// out, and so this is no mistake of the file.
  std::vector<std::string> complaints_of(const std::function<void()>& read);

  /// The root element of a file. Nothing, and a mistake, if it is no XML, too large, declares
  /// entities of its own, or has an element of too many attributes or too long a name.
  std::optional<XmlElement> read(const std::filesystem::path& file,
                                 std::size_t most_bytes = most_xml_bytes);

  /// Parses a text, for tests and fuzzing.
  std::optional<XmlElement> parse(const std::string& text, const std::filesystem::path& file);

  /// A mistake at an element: "line 12: <geom name="x">: size: must be ...". After many of them no
  /// more are kept.
  void wrong(const XmlElement& element, std::string_view message);

  /// A mesh that an element names and that is missing: whether it matters is known when all is
  /// read.
  struct MissingMesh {
    XmlElement element;
    std::string complaint;
    bool is_seen = false, collides = false;
  };
  void missing_mesh(MissingMesh mesh);
  std::vector<MissingMesh> take_missing_meshes() { return std::move(missing_meshes_); }

  const std::vector<std::filesystem::path>& files() const { return files_; }
  /// All text that was read.
  const std::string& hash_text() const { return hash_text_; }
  Mistakes& mistakes() { return mistakes_; }

  /// Finite numbers between blanks, at least `least` and at most `most` of them; nothing if the
  /// attribute is not there, or is wrong (a mistake).
  std::optional<std::vector<double>> numbers(const XmlElement& element, std::string_view key,
                                             std::size_t least, std::size_t most);
  /// The text is in an element; `what` names it in the mistake.
  std::optional<std::vector<double>> numbers_in(const XmlElement& element, std::string_view text,
                                                std::string_view what, std::size_t least,
                                                std::size_t most);
  std::optional<double> number(const XmlElement& element, std::string_view key);
  std::optional<Vec3<double>> vector(const XmlElement& element, std::string_view key);

 private:
  bool tell_long_names(const XmlElement& element);

  Mistakes& mistakes_;
  std::vector<std::string>* complaints_ = nullptr;  ///< get what is wrong, if they are collected
  std::set<std::string> told_;
  std::vector<MissingMesh> missing_meshes_;
  std::vector<std::filesystem::path> files_;
  std::string hash_text_;
  std::size_t reported_ = 0, elements_ = 0, bytes_ = 0;
};

/// Message for a name that is too long: "must have at most 1000 bytes (got 5000)"; nothing if it
/// is not.
std::optional<std::string> complaint_of_length(std::string_view name);

/// "<geom name="x">": an element as messages name it.
std::string name_of(const XmlElement& element);

}  // namespace minkray
