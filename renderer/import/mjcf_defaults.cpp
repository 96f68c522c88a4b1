// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf_defaults.h"

#include <set>
#include <sstream>

namespace minkray {
namespace {

constexpr const char* main_class = "main";
constexpr int deepest_include = 32;

class Includes {
 public:
  explicit Includes(XmlFiles& files) : files_(files) {
    const std::filesystem::path& first = files.files().front();
    folder_ = first.parent_path();
    seen_.insert(whole(first));
  }

  void expand(XmlElement& element, int depth) {
    std::vector<XmlElement> children;
    for (XmlElement& child : element.children) {
      if (child.name != "include") {
        expand(child, depth);
        children.push_back(std::move(child));
        continue;
      }
      const std::string* name = child.attribute("file");
      if (!name) {
        files_.wrong(child, "file: must be there");
        continue;
      }
      const std::filesystem::path file = folder_ / *name;
      if (depth >= deepest_include || !seen_.insert(whole(file)).second) {
        files_.wrong(child, "the file must not be included twice, nor include itself");
        continue;
      }
      std::optional<XmlElement> root = files_.read(file);
      if (!root) {
        files_.wrong(child, "includes a file that cannot be read");
        continue;
      }
      expand(*root, depth + 1);
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

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// The words of `own`, and behind them those of `other` that it has not.
std::string filled_up(const std::string& own, const std::string& other) {
  const std::vector<std::string> given = words_of(own), rest = words_of(other);
  std::string text = own;
  for (std::size_t i = given.size(); i < rest.size(); ++i) text += " " + rest[i];
  return text;
}

/// Attributes of which any one says the same thing as the others: an element's own one is not
/// joined by another one of its class.
bool is_orientation(const std::string& name) {
  return name == "quat" || name == "axisangle" || name == "xyaxes" || name == "zaxis" ||
         name == "euler";
}

void merge(std::vector<XmlAttribute>& own, const std::vector<XmlAttribute>& defaults) {
  bool has_orientation = false;
  for (const XmlAttribute& attribute : own) has_orientation |= is_orientation(attribute.name);
  for (const XmlAttribute& given : defaults) {
    if (given.name == "class" || (has_orientation && is_orientation(given.name))) continue;
    XmlAttribute* known = nullptr;
    for (XmlAttribute& attribute : own)
      if (attribute.name == given.name) known = &attribute;
    if (!known)
      own.push_back(given);
    else if (given.name == "size")
      known->value = filled_up(known->value, given.value);
  }
}

}  // namespace

void expand_includes(XmlElement& root, XmlFiles& files) {
  Includes(files).expand(root, 0);
}

void MjcfDefaults::read(const XmlElement& element, XmlFiles& files, const std::string& parent) {
  std::string name = element.attribute_or("class");
  if (name.empty()) {
    if (!parent.empty()) files.wrong(element, "class: must be there");
    name = main_class;
  }
  if (!classes_.contains(name)) {
    if (parent.empty())
      classes_.emplace(name, Class());
    else
      classes_.emplace(name, Class(classes_[parent]));
  }
  if (parent.empty() && name != main_class && !classes_.contains(main_class))
    classes_.emplace(main_class, Class());
  for (const XmlElement& child : element.children) {
    if (child.name == "default") continue;
    std::vector<XmlAttribute> attributes = child.attributes;
    std::vector<XmlAttribute>& known = classes_[name][child.name];
    merge(attributes, known);
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
    files.wrong(element,
                "class: there are no defaults of the class \"" + printable(name, 60) + "\"");
  if (name.empty()) name = child_class.empty() ? main_class : child_class;
  const auto found = classes_.find(name);
  if (found == classes_.end()) return merged;
  const auto defaults = found->second.find(element.name);
  if (defaults != found->second.end()) merge(merged.attributes, defaults->second);
  return merged;
}

}  // namespace minkray
