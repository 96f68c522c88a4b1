// SPDX-License-Identifier: MIT
#include "tests/fuzz/change/known_xml.h"

#include <algorithm>

namespace minkray::fuzz {
namespace {

constexpr std::size_t most_lists = 2000, most_of_a_list = 48, longest = 1200;

}  // namespace

std::string xml_text(const tinyxml2::XMLNode& node) {
  constexpr bool compact = true;
  tinyxml2::XMLPrinter printer(nullptr, compact);
  node.Accept(&printer);
  return printer.CStr();
}

void KnownXml::keep(Lists& lists, const std::string& key, const std::string& value) {
  if (value.size() > longest || (lists.size() >= most_lists && !lists.contains(key))) return;
  std::vector<std::string>& list = lists[key];
  if (list.size() < most_of_a_list && std::ranges::find(list, value) == list.end())
    list.push_back(value);
}

void KnownXml::learn(const tinyxml2::XMLElement& element) {
  const std::string name = element.Name();
  const tinyxml2::XMLNode* parent = element.Parent();
  const tinyxml2::XMLElement* holder = parent ? parent->ToElement() : nullptr;
  keep(children_, holder ? holder->Name() : "", xml_text(element));
  for (const auto* at = element.FirstAttribute(); at; at = at->Next()) {
    keep(attributes_, name, at->Name());
    keep(values_, at->Name(), at->Value());
  }
  if (const char* text = element.GetText()) keep(texts_, name, text);
  for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
    learn(*child);
}

std::string KnownXml::word(Choice& choice) const {
  if (words_.empty()) return "m";
  return choice.of(words_);
}

/// Mostly one of the key's own list, else one of any.
std::string KnownXml::one_of(const Lists& lists, const std::string& key, Choice& choice) const {
  if (lists.empty()) return "";
  auto at = lists.find(key);
  if (at == lists.end() || choice.one_in(6))
    at = std::next(lists.begin(), static_cast<std::ptrdiff_t>(choice.below(lists.size())));
  return at->second.empty() ? "" : choice.of(at->second);
}

std::string KnownXml::child(const std::string& parent, Choice& choice) const {
  // A reader supports more names of elements than any document has.
  if (choice.one_in(4)) return "<" + word(choice) + "/>";
  return one_of(children_, parent, choice);
}

std::string KnownXml::attribute(const std::string& element, Choice& choice) const {
  if (choice.one_in(3)) return word(choice);
  const std::string seen = one_of(attributes_, element, choice);
  return seen.empty() ? word(choice) : seen;
}

std::string KnownXml::value(const std::string& attribute, Choice& choice) const {
  switch (choice.below(6)) {
    case 0:
      return word(choice);
    case 1: {
      std::string numbers;
      for (std::size_t left = 1 + choice.below(6); left > 0; --left)
        numbers += (numbers.empty() ? "" : " ") + std::to_string(choice.below(5));
      return numbers;
    }
    default:
      return one_of(values_, attribute, choice);
  }
}

std::string KnownXml::text(const std::string& element, Choice& choice) const {
  return choice.one_in(6) ? word(choice) : one_of(texts_, element, choice);
}

}  // namespace minkray::fuzz
