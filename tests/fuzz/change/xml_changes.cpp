// SPDX-License-Identifier: MIT
#include "tests/fuzz/change/xml_changes.h"

#include <array>
#include <charconv>
#include <sstream>

namespace minkray::fuzz {
namespace {

using tinyxml2::XMLElement;

/// One of this many documents is learned from.
constexpr std::size_t one_of_xml_learned = 4;

std::string text_of_number(double x) {
  std::array<char, 40> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
  return {text.data(), end};
}

void collect(XMLElement& element, std::vector<XMLElement*>& elements) {
  elements.push_back(&element);
  for (XMLElement* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
    collect(*child, elements);
}

bool holds(const XMLElement& outer, const tinyxml2::XMLNode* node) {
  for (; node; node = node->Parent())
    if (node == &outer) return true;
  return false;
}

}  // namespace

std::string changed_words(const std::string& text, Choice& choice) {
  static constexpr std::array odd = {"nan",    "inf", "-inf", "1e999", "1e-999", "0x10",
                                     "1,5",    "-",   "+1",   "1.",    ".5",     "1e",
                                     "000001", "1f",  "١",    "true",  "1e308",  "99999999999"};
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  if (words.empty()) return choice.of(odd);
  const std::size_t at = choice.below(words.size());
  const auto place = words.begin() + static_cast<std::ptrdiff_t>(at);
  switch (choice.below(8)) {
    case 0:
      words.erase(place);
      break;
    case 1:
      words.insert(place, std::string(words[at]));
      break;
    case 2:
      words[at] = choice.of(odd);
      break;
    default: {
      double x = 0;
      const char* end = words[at].data() + words[at].size();
      const bool is_number = std::from_chars(words[at].data(), end, x).ptr == end;
      words[at] = text_of_number(changed_number(is_number ? x : 1, choice));
      break;
    }
  }
  std::string changed;
  for (const std::string& word : words) changed += (changed.empty() ? "" : " ") + word;
  return changed;
}

void XmlChanges::change_attribute(XMLElement& element, Choice& choice) const {
  const auto add = [&] {
    const std::string name = known_.attribute(element.Name(), choice);
    element.SetAttribute(name.c_str(), known_.value(name, choice).c_str());
  };
  std::vector<std::string> names;
  for (const auto* at = element.FirstAttribute(); at; at = at->Next()) names.push_back(at->Name());
  if (names.empty() || choice.one_in(4)) return add();
  const std::string name = choice.of(names);
  const std::string value = element.Attribute(name.c_str());
  switch (choice.below(6)) {
    case 0:
      element.DeleteAttribute(name.c_str());
      break;
    case 1:  // another name for it
      element.DeleteAttribute(name.c_str());
      element.SetAttribute(known_.attribute(element.Name(), choice).c_str(), value.c_str());
      break;
    case 2:
      element.SetAttribute(name.c_str(), known_.value(name, choice).c_str());
      break;
    case 3:
      element.SetAttribute(name.c_str(), known_.word(choice).c_str());
      break;
    default:
      element.SetAttribute(name.c_str(), changed_words(value, choice).c_str());
      break;
  }
}

void XmlChanges::change_text(XMLElement& element, Choice& choice) const {
  const char* text = element.GetText();
  if (text && !choice.one_in(4))
    element.SetText(changed_words(text, choice).c_str());
  else
    element.SetText(known_.text(element.Name(), choice).c_str());
}

void XmlChanges::add_child(XMLElement& element, Choice& choice) const {
  tinyxml2::XMLDocument read;
  const std::string text = known_.child(element.Name(), choice);
  if (read.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS || !read.RootElement()) return;
  tinyxml2::XMLNode* added = read.RootElement()->DeepClone(element.GetDocument());
  if (choice.one_in(2))
    element.InsertFirstChild(added);
  else
    element.InsertEndChild(added);
}

void XmlChanges::change_element(XMLElement& element, const std::vector<XMLElement*>& elements,
                                Choice& choice) const {
  tinyxml2::XMLNode* parent = element.Parent();
  XMLElement& other = *choice.of(elements);
  switch (choice.below(6)) {
    case 0:
      parent->DeleteChild(&element);
      break;
    case 1:
      parent->InsertAfterChild(&element, element.DeepClone(element.GetDocument()));
      break;
    case 2:  // to another place
      if (!holds(element, &other)) other.InsertEndChild(&element);
      break;
    case 3:  // there as well
      other.InsertEndChild(element.DeepClone(element.GetDocument()));
      break;
    case 4:
      // Not InsertAfterChild, by which tinyxml2 9 loses its way where the element is the last one.
      if (other.Parent() == parent)
        parent->InsertFirstChild(&element);
      else
        element.SetName(choice.one_in(2) ? other.Name() : known_.word(choice).c_str());
      break;
    default:
      element.SetName(known_.word(choice).c_str());
      break;
  }
}

std::optional<std::string> XmlChanges::change(std::string_view bytes, Choice& choice) {
  tinyxml2::XMLDocument document;
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS) return std::nullopt;
  const bool learns = choice.one_in(one_of_xml_learned);
  for (std::size_t count = 1 + choice.below(3); count > 0; --count) {
    std::vector<XMLElement*> elements;
    for (XMLElement* e = document.FirstChildElement(); e; e = e->NextSiblingElement()) {
      if (learns) known_.learn(*e);
      collect(*e, elements);
    }
    if (elements.empty()) return std::nullopt;
    XMLElement& element = *choice.of(elements);
    switch (choice.below(8)) {
      case 0:
      case 1:
        change_element(element, elements, choice);
        break;
      case 2:
      case 3:
        add_child(element, choice);
        break;
      case 4:
        change_text(element, choice);
        break;
      default:
        change_attribute(element, choice);
        break;
    }
  }
  return xml_text(document);
}

}  // namespace minkray::fuzz
