// SPDX-License-Identifier: MIT
// Changes of XML documents that leave them XML: what bytes changed by chance seldom are.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tests/fuzz/change/known_xml.h"

namespace minkray::fuzz {

class XmlChanges {
 public:
  explicit XmlChanges(KnownXml known) : known_(std::move(known)) {}

  /// The document, or elements that follow each other, changed at one to three places. Nothing if
  /// it is no XML.
  std::optional<std::string> change(std::string_view bytes, Choice& choice);

 private:
  void change_element(tinyxml2::XMLElement& element,
                      const std::vector<tinyxml2::XMLElement*>& elements, Choice& choice) const;
  void change_attribute(tinyxml2::XMLElement& element, Choice& choice) const;
  void change_text(tinyxml2::XMLElement& element, Choice& choice) const;
  void add_child(tinyxml2::XMLElement& element, Choice& choice) const;

  KnownXml known_;
};

/// A text of words between blanks with one of them changed: a number to another, or to what readers
/// must refuse; a word left out, or there twice.
std::string changed_words(const std::string& text, Choice& choice);

}  // namespace minkray::fuzz
