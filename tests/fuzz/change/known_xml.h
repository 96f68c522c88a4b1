// SPDX-License-Identifier: MIT
// Possible contents of XML documents of a kind, learned from documents: the elements within each
// element, and their attributes and texts.
#pragma once

#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "tests/fuzz/change/choice.h"

namespace minkray::fuzz {

class KnownXml {
 public:
  /// `words` are what readers compare names and values with.
  explicit KnownXml(std::vector<std::string> words) : words_(std::move(words)) {}

  /// Learns what an element holds, and its parent of it.
  void learn(const tinyxml2::XMLElement& element);

  /// All of an element, as text, that the parent may hold.
  std::string child(const std::string& parent, Choice& choice) const;
  /// The name of an attribute that the element may have.
  std::string attribute(const std::string& element, Choice& choice) const;
  std::string value(const std::string& attribute, Choice& choice) const;
  std::string text(const std::string& element, Choice& choice) const;
  std::string word(Choice& choice) const;

 private:
  using Lists = std::map<std::string, std::vector<std::string>>;

  static void keep(Lists& lists, const std::string& key, const std::string& value);
  std::string one_of(const Lists& lists, const std::string& key, Choice& choice) const;

  std::vector<std::string> words_;
  Lists children_, attributes_, values_, texts_;
};

/// The element as text, without needless blanks.
std::string xml_text(const tinyxml2::XMLNode& node);

}  // namespace minkray::fuzz
