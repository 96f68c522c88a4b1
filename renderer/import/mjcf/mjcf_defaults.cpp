// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf/mjcf_defaults.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace minkray {
namespace {

constexpr const char* main_class = "main";
constexpr int deepest_include = 32;

/// Each file is nested a hundred deep at most (tinyxml2), which those that are included add to.
/// Each level is one of the stack when bodies are read.
constexpr int deepest_nesting = 500;

/// Limit of an element's attributes from its classes, names with values: few lines can request
/// them again and again.
constexpr std::size_t most_default_bytes = 10'000;

/// Limit of all classes together, each with its inherited attributes. Robots' files have a
/// hundredth.
constexpr std::size_t most_bytes_of_classes = std::size_t{64} << 20;

class Includes {
 public:
  Includes(XmlFiles& files, const std::filesystem::path& first)
      : files_(files), folder_(first.parent_path()) {
    seen_.insert(whole(first));
  }

  /// `nesting`: how many elements there are around its children.
  void expand(XmlElement& element, int depth, int nesting) {
    if (nesting > deepest_nesting) {
      files_.wrong(element, "elements must be nested at most " + std::to_string(deepest_nesting) +
                                " deep, including included files");
      element.children.clear();
    }
    std::vector<XmlElement> children;
    for (XmlElement& child : element.children) {
      if (child.name != "include") {
        expand(child, depth, nesting + 1);
        children.push_back(std::move(child));
        continue;
      }
      const std::string* name = child.attribute("file");
      if (!name) {
        files_.wrong(child, "file: missing");
        continue;
      }
      // Next to the first file, or next to the one that includes it.
      std::filesystem::path file = folder_ / *name;
      const std::filesystem::path beside = files_.files()[child.file].parent_path() / *name;
      std::error_code error;
      if (!std::filesystem::exists(file, error) && std::filesystem::exists(beside, error))
        file = beside;
      if (depth >= deepest_include || !seen_.insert(whole(file)).second) {
        files_.wrong(child, "the file must not be included twice or include itself");
        continue;
      }
      std::optional<XmlElement> root = files_.read(file);
      if (!root) continue;  // already reported
      expand(*root, depth + 1, nesting);
      for (XmlElement& included : root->children) children.push_back(std::move(included));
    }
    element.children = std::move(children);
  }

 private:
  static std::string whole(const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::weakly_canonical(file, error).string();
  }

  XmlFiles& files_;
  std::filesystem::path folder_;
  std::set<std::string> seen_;
};

constexpr std::string_view blanks = " \t\r\n";

/// Takes the blanks off that a text begins with.
void take_blanks(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
}

/// Takes its first word off, of a text that begins with one.
void take_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_of(blanks), text.size()));
}

/// The words of `own`, and behind them those of `other` that it has not.
std::string filled_up(const std::string& own, const std::string& other) {
  std::string_view given = own, rest = other;
  take_blanks(given);
  take_blanks(rest);
  for (; !given.empty() && !rest.empty(); take_blanks(given), take_blanks(rest)) {
    take_word(given);
    take_word(rest);
  }
  return rest.empty() ? own : own + " " + std::string(rest);
}

/// Attributes that replace each other: an element's own one is not joined by another one of its
/// class.
bool is_orientation(const std::string& name) {
  return name == "quat" || name == "axisangle" || name == "xyaxes" || name == "zaxis" ||
         name == "euler";
}

void merge(std::vector<XmlAttribute>& own, const std::vector<XmlAttribute>& defaults) {
  bool has_orientation = false;
  for (const XmlAttribute& attribute : own) has_orientation |= is_orientation(attribute.name);
  // The names of the defaults are distinct, so additions need not be checked again.
  const std::size_t written = own.size();
  for (const XmlAttribute& given : defaults) {
    if (given.name == "class" || (has_orientation && is_orientation(given.name))) continue;
    const auto end = own.begin() + static_cast<std::ptrdiff_t>(written);
    const auto known = std::find_if(
        own.begin(), end, [&](const XmlAttribute& one) { return one.name == given.name; });
    if (known == end)
      own.push_back(given);
    else if (given.name == "size")
      known->value = filled_up(known->value, given.value);
  }
}

std::size_t bytes_of(const std::vector<XmlAttribute>& attributes) {
  std::size_t bytes = 0;
  for (const XmlAttribute& one : attributes) bytes += one.name.size() + one.value.size();
  return bytes;
}

/// In memory, about.
std::size_t memory_of(const std::vector<XmlAttribute>& attributes) {
  return sizeof attributes + attributes.size() * sizeof(XmlAttribute) + bytes_of(attributes);
}

}  // namespace

void expand_includes(XmlElement& root, XmlFiles& files) {
  Includes(files, std::filesystem::path(files.files()[root.file])).expand(root, 0, 1);
}

bool MjcfDefaults::takes(std::size_t bytes, const XmlElement& element, XmlFiles& files) {
  if (bytes_ <= most_bytes_of_classes && bytes_ + bytes > most_bytes_of_classes)
    files.wrong(element, "all classes must hold at most " + std::to_string(most_bytes_of_classes) +
                             " bytes, including inherited ones (got " +
                             std::to_string(bytes_ + bytes) + " up to here)");
  bytes_ += bytes;
  return bytes_ <= most_bytes_of_classes;
}

void MjcfDefaults::read(const XmlElement& element, XmlFiles& files, const std::string& parent) {
  std::string name = element.attribute_or("class");
  if (name.empty()) {
    if (!parent.empty()) files.wrong(element, "class: missing");
    name = main_class;
  }
  if (!classes_.contains(name)) {
    const auto outer = classes_.find(parent);
    std::size_t bytes = 0;
    if (outer != classes_.end())
      for (const auto& [kind, attributes] : outer->second) bytes += memory_of(attributes);
    if (!takes(bytes, element, files)) return;
    classes_.emplace(name, outer != classes_.end() ? outer->second : Class());
  }
  if (parent.empty() && name != main_class && !classes_.contains(main_class))
    classes_.emplace(main_class, Class());
  for (const XmlElement& child : element.children) {
    if (child.name == "default") continue;
    std::vector<XmlAttribute> attributes = child.attributes;
    std::vector<XmlAttribute>& known = classes_[name][child.name];
    merge(attributes, known);
    const std::size_t bytes = bytes_of(attributes);
    if (attributes.size() > most_xml_attributes || bytes > most_default_bytes) {
      files.wrong(
          child, "must have at most " + std::to_string(most_xml_attributes) + " attributes of " +
                     std::to_string(most_default_bytes) + " bytes, including inherited ones (got " +
                     std::to_string(attributes.size()) + " of " + std::to_string(bytes) + ")");
      continue;
    }
    if (!takes(memory_of(attributes), child, files)) return;
    known = std::move(attributes);
  }
  for (const XmlElement& child : element.children)
    if (child.name == "default") read(child, files, name);
}

XmlElement MjcfDefaults::with_defaults(const XmlElement& element, const std::string& child_class,
                                       XmlFiles& files) const {
  XmlElement merged;
  merged.name = element.name;
  merged.attributes = element.attributes;
  merged.line = element.line;
  merged.file = element.file;
  std::string name = element.attribute_or("class");
  if (!name.empty() && !classes_.contains(name) && name != main_class)
    files.wrong(element, "class: no defaults for class \"" + printable(name, 60) + "\"");
  if (name.empty()) name = child_class.empty() ? main_class : child_class;
  const auto found = classes_.find(name);
  if (found == classes_.end()) return merged;
  const auto defaults = found->second.find(element.name);
  if (defaults != found->second.end()) merge(merged.attributes, defaults->second);
  return merged;
}

}  // namespace minkray
