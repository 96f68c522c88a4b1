// SPDX-License-Identifier: MIT
#include "renderer/import/xml.h"

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>

#include "core/files/regular_file.h"
#include "renderer/base/hash.h"

namespace minkray {
namespace {

/// Whoever has more has one mistake many times.
constexpr std::size_t most_reported = 100;

/// A piece of what was found, for messages.
constexpr std::size_t longest_quote = 60;

/// tinyxml2 compares each attribute of an element with all before it.
constexpr std::size_t most_attributes = 10'000;

/// How many attributes an element has at most: values in quotes behind an equals sign.
std::size_t attributes_at_once(std::string_view text) {
  std::size_t most = 0, here = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '<' || text[i] == '>') here = 0;
    if ((text[i] == '"' || text[i] == '\'') && i > 0 && text[i - 1] == '=')
      most = std::max(most, ++here);
  }
  return most;
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

std::string name_of(const XmlElement& element) {
  std::string text = "<" + element.name;
  for (const char* key : {"name", "class", "file", "filename"})
    if (const std::string* value = element.attribute(key)) {
      text += std::string(" ") + key + "=\"" + printable(*value, longest_quote) + "\"";
      break;
    }
  return text + ">";
}

std::optional<XmlElement> XmlFiles::read(const std::filesystem::path& file,
                                         std::size_t most_bytes) {
  try {
    return parse(read_regular_file(file, most_bytes), file);
  } catch (const std::exception& error) {
    mistakes_.add((files_.empty() ? "" : printable(file.string(), 200) + ": ") + error.what());
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
                  " elements, with all files that are included");
    return std::nullopt;
  }
  bytes_ += text.size();
  if (bytes_ > most_collada_bytes) {
    mistakes_.add(where + "must have at most " + std::to_string(most_collada_bytes) +
                  " bytes, with all files that are included");
    return std::nullopt;
  }
  if (text.find("<!ENTITY") != text.npos) {
    mistakes_.add(where + "declares entities (<!ENTITY), which are not read");
    return std::nullopt;
  }
  if (attributes_at_once(text) > most_attributes) {
    mistakes_.add(where + "has an element of more than " + std::to_string(most_attributes) +
                  " attributes");
    return std::nullopt;
  }
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    const bool is_deep = document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED;
    mistakes_.add(where + "line " + std::to_string(document.ErrorLineNum()) +
                  (is_deep
                       ? ": elements are nested too deeply (at most " +
                             std::to_string(TINYXML2_MAX_ELEMENT_DEPTH) + ")"
                       : ": is no XML that can be read (" +
                             std::string(tinyxml2::XMLDocument::ErrorIDToName(document.ErrorID())) +
                             ")"));
    return std::nullopt;
  }
  if (!document.RootElement()) {
    mistakes_.add(where + "has no element");
    return std::nullopt;
  }
  return converted(*document.RootElement(), index);
}

void XmlFiles::wrong(const XmlElement& element, std::string_view message) {
  if (++reported_ > most_reported) {
    if (reported_ == most_reported + 1) mistakes_.add("and more mistakes, which are not told");
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
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  bool is_good = true;
  for (;;) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) break;
    if (*at == '+' && end - at > 1 && at[1] != '-') ++at;
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value) || (next != end && !is_blank(*next)) ||
        values.size() >= most) {
      is_good = false;
      break;
    }
    values.push_back(value);
    at = next;
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
