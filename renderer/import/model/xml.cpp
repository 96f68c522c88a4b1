// SPDX-License-Identifier: MIT
#include "renderer/import/model/xml.h"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

#include "core/files/regular_file.h"
#include "core/files/text.h"
#include "renderer/base/hash.h"
#include "renderer/base/of_file.h"

namespace minkray {
namespace {

/// Limit of reported mistakes: a file with more has one mistake many times.
constexpr std::size_t most_reported = 100;

/// A piece of what was found, for messages.
constexpr std::size_t longest_quote = 60;

/// Attributes with names: many elements of a model may carry one of these that the file has once.
constexpr std::array<std::string_view, 4> multiplied_names = {"name", "class", "childclass",
                                                              "prefix"};

/// Sections in which quotes and angle brackets mean nothing; the last one is recognised after the
/// others.
struct Markup {
  std::string_view opens, closes;
};
constexpr std::array<Markup, 4> no_elements = {
    {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"<!", ">"}}};

/// The tag with the most attributes of a text.
struct LargestTag {
  std::size_t attributes = 0;
  std::size_t at = 0;  ///< begin
};

/// tinyxml2 compares each attribute of an element with all before it, so that these are counted
/// first: quotes that open in a tag. Tags are recognised as in tinyxml2. For text that is not XML
/// any number is right.
LargestTag largest_tag(std::string_view text) {
  LargestTag largest;
  std::size_t at = text.find('<');
  while (at < text.size()) {
    const std::string_view rest = text.substr(at);
    const auto other = std::ranges::find_if(
        no_elements, [&](const Markup& markup) { return rest.starts_with(markup.opens); });
    std::size_t end = at + 1;
    if (other != no_elements.end()) {
      end = text.find(other->closes, at + other->opens.size());
    } else {
      std::size_t here = 0;
      while ((end = text.find_first_of("\"'>", end)) < text.size() && text[end] != '>') {
        ++here;
        end = text.find(text[end], end + 1);
        if (end < text.size()) ++end;
      }
      if (here > largest.attributes) largest = {here, at};
    }
    at = text.find('<', end);
  }
  return largest;
}

XmlElement converted(const tinyxml2::XMLElement& from, std::uint32_t file) {
  XmlElement element;
  element.name = from.Name();
  element.line = from.GetLineNum();
  element.file = file;
  for (const auto* a = from.FirstAttribute(); a; a = a->Next())
    element.attributes.push_back({a->Name(), a->Value()});
  for (const auto* node = from.FirstChild(); node; node = node->NextSibling()) {
    if (const auto* child = node->ToElement())
      element.children.push_back(converted(*child, file));
    else if (const auto* text = node->ToText())
      element.text += text->Value();
  }
  return element;
}

}  // namespace

const std::string* XmlElement::attribute(std::string_view key) const {
  for (const XmlAttribute& one : attributes)
    if (one.name == key) return &one.value;
  return nullptr;
}

std::string XmlElement::attribute_or(std::string_view key, std::string_view otherwise) const {
  const std::string* value = attribute(key);
  return value ? *value : std::string(otherwise);
}

const XmlElement* XmlElement::child(std::string_view key) const {
  for (const XmlElement& one : children)
    if (one.name == key) return &one;
  return nullptr;
}

void XmlFiles::missing_mesh(MissingMesh mesh) {
  if (complaints_) return wrong(mesh.element, mesh.complaint);
  for (MissingMesh& known : missing_meshes_)
    if (known.complaint == mesh.complaint) {
      known.is_seen |= mesh.is_seen;
      known.collides |= mesh.collides;
      return;
    }
  mesh.element.children.clear();
  missing_meshes_.push_back(std::move(mesh));
}

void drop_vendor_prefixes(XmlElement& root) {
  static const std::set<std::string, std::less<>> known = {
      "a",     "axis",     "b",         "box",    "c",      "capsule", "child",
      "cone",  "cylinder", "ellipsoid", "joint",  "length", "mesh",    "parent",
      "plane", "pose",     "radii",     "radius", "size",   "sphere",  "type"};
  const auto drop = [](std::string& name) {
    const std::size_t colon = name.find(':');
    if (colon == name.npos || name.starts_with("xacro:")) return;
    if (known.contains(std::string_view(name).substr(colon + 1))) name.erase(0, colon + 1);
  };
  drop(root.name);
  for (XmlAttribute& one : root.attributes) drop(one.name);
  for (XmlElement& child : root.children) drop_vendor_prefixes(child);
}

std::string name_of(const XmlElement& element) {
  std::string text = "<" + element.name;
  for (const char* key : {"name", "class", "file", "filename"})
    if (const std::string* value = element.attribute(key)) {
      text += std::string(" ") + key + "=\"" + printable(*value, longest_quote) + "\"";
      break;
    }
  return text + ">";
}

std::optional<std::string> complaint_of_length(std::string_view name) {
  if (name.size() <= longest_xml_name) return std::nullopt;
  return "must have at most " + std::to_string(longest_xml_name) + " bytes (got " +
         std::to_string(name.size()) + ")";
}

std::optional<XmlElement> XmlFiles::read(const std::filesystem::path& file,
                                         std::size_t most_bytes) {
  try {
    return parse(read_regular_file(file, most_bytes), file);
  } catch (const std::exception& error) {
    mistakes_.add((files_.empty() ? "" : printable(file.string(), 200) + ": ") + what_of(error));
    return std::nullopt;
  }
}

std::optional<XmlElement> XmlFiles::parse(const std::string& text,
                                          const std::filesystem::path& file) {
  const auto index = static_cast<std::uint32_t>(files_.size());
  const std::string where = index == 0 ? "" : "in " + printable(file.string(), 200) + ", ";
  files_.push_back(file);
  Hash hash;
  hash.add(text);
  hash_text_ += hash.text();
  elements_ += static_cast<std::size_t>(std::ranges::count(text, '<'));
  if (elements_ > most_xml_elements) {
    mistakes_.add(where + "must have at most " + std::to_string(most_xml_elements) +
                  " elements, including included files");
    return std::nullopt;
  }
  bytes_ += text.size();
  if (bytes_ > most_collada_bytes) {
    mistakes_.add(where + "must have at most " + std::to_string(most_collada_bytes) +
                  " bytes, including included files");
    return std::nullopt;
  }
  if (text.find("<!ENTITY") != text.npos) {
    mistakes_.add(where + "declares entities (<!ENTITY), which are not supported");
    return std::nullopt;
  }
  if (const LargestTag largest = largest_tag(text); largest.attributes > most_xml_attributes) {
    const auto begin = text.begin(), tag = begin + static_cast<std::ptrdiff_t>(largest.at);
    mistakes_.add(where + "line " + std::to_string(1 + std::count(begin, tag, '\n')) +
                  ": an element must have at most " + std::to_string(most_xml_attributes) +
                  " attributes (got " + std::to_string(largest.attributes) + ")");
    return std::nullopt;
  }
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    const bool is_deep = document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED;
    mistakes_.add(where + "line " + std::to_string(document.ErrorLineNum()) +
                  (is_deep
                       ? ": elements are nested too deeply (at most " +
                             std::to_string(TINYXML2_MAX_ELEMENT_DEPTH) + ")"
                       : ": not valid XML (" +
                             std::string(tinyxml2::XMLDocument::ErrorIDToName(document.ErrorID())) +
                             ")"));
    return std::nullopt;
  }
  if (!document.RootElement()) {
    mistakes_.add(where + "has no element");
    return std::nullopt;
  }
  if (const auto* other = document.RootElement()->NextSiblingElement()) {
    mistakes_.add(where + "line " + std::to_string(other->GetLineNum()) +
                  ": must have one root element (got <" + printable(other->Name(), 40) +
                  "> behind <" + printable(document.RootElement()->Name(), 40) + ">)");
    return std::nullopt;
  }
  XmlElement root = converted(*document.RootElement(), index);
  if (tell_long_names(root)) return std::nullopt;
  return root;
}

/// Returns true if there are any.
bool XmlFiles::tell_long_names(const XmlElement& element) {
  bool any = false;
  for (const XmlAttribute& one : element.attributes) {
    if (std::ranges::find(multiplied_names, one.name) == multiplied_names.end()) continue;
    if (const auto complaint = complaint_of_length(one.value)) {
      wrong(element, one.name + ": " + *complaint);
      any = true;
    }
  }
  for (const XmlElement& child : element.children) any |= tell_long_names(child);
  return any;
}

std::vector<std::string> XmlFiles::complaints_of(const std::function<void()>& read) {
  std::vector<std::string> complaints;
  std::vector<std::string>* const outer = std::exchange(complaints_, &complaints);
  read();
  complaints_ = outer;
  return complaints;
}

void XmlFiles::wrong(const XmlElement& element, std::string_view message) {
  if (complaints_) {
    complaints_->push_back("<" + printable(element.name, longest_quote) +
                           ">: " + std::string(message));
    return;
  }
  // Elements that are shown again and again have one mistake.
  std::string key = std::to_string(element.file) + ":" + std::to_string(element.line) + ":";
  if (!told_.insert(key.append(message)).second) return;
  if (++reported_ > most_reported) {
    if (reported_ == most_reported + 1) mistakes_.add("further errors omitted");
    return;
  }
  const std::string where =
      element.file == 0 ? "" : "in " + printable(files_[element.file].string(), 200) + ", ";
  mistakes_.add(where + "line " + std::to_string(element.line) + ": " + name_of(element) + ": " +
                std::string(message));
}

std::optional<std::vector<double>> XmlFiles::numbers_in(const XmlElement& element,
                                                        std::string_view text,
                                                        std::string_view what, std::size_t least,
                                                        std::size_t most) {
  std::vector<double> values;
  bool is_good = true;
  std::string_view rest = text;
  for (std::string_view word = next_word(rest); is_good && !word.empty(); word = next_word(rest)) {
    const auto value = finite_number(bare_number(word));
    is_good = value && values.size() < most;
    if (is_good) values.push_back(*value);
  }
  if (is_good && values.size() >= least) return values;
  const std::string count = least == most ? std::to_string(least)
                            : most > 1000 ? "at least " + std::to_string(least)
                                          : std::to_string(least) + " to " + std::to_string(most);
  wrong(element, std::string(what) + ": must be " + count + " finite number" +
                     (count == "1" ? "" : "s") + " (got \"" +
                     printable(text.substr(0, 200), longest_quote) + "\")");
  return std::nullopt;
}

std::optional<std::vector<double>> XmlFiles::numbers(const XmlElement& element,
                                                     std::string_view key, std::size_t least,
                                                     std::size_t most) {
  const std::string* text = element.attribute(key);
  if (!text) return std::nullopt;
  return numbers_in(element, *text, key, least, most);
}

std::optional<double> XmlFiles::number(const XmlElement& element, std::string_view key) {
  const auto values = numbers(element, key, 1, 1);
  return values ? std::optional((*values)[0]) : std::nullopt;
}

std::optional<Vec3<double>> XmlFiles::vector(const XmlElement& element, std::string_view key) {
  const auto values = numbers(element, key, 3, 3);
  return values ? std::optional(Vec3<double>((*values)[0], (*values)[1], (*values)[2]))
                : std::nullopt;
}

}  // namespace minkray
