// SPDX-License-Identifier: MIT
// Changes of JSON documents that leave them JSON: what bytes changed by chance seldom are.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tests/fuzz/change/known_json.h"

namespace minkray::fuzz {

class JsonChanges {
 public:
  explicit JsonChanges(KnownJson known) : known_(std::move(known)) {}

  /// The document changed at one to three places; of several documents in lines, one of them is
  /// changed, doubled or left out; of a binary glTF file, the JSON in it. Nothing if that is none.
  std::optional<std::string> change(std::string_view bytes, Choice& choice);

 private:
  struct Place;

  std::optional<std::string> change_document(std::string_view text, Choice& choice);
  std::optional<std::string> change_line(std::string_view bytes, Choice& choice);
  std::optional<std::string> change_binary(std::string_view bytes, Choice& choice);
  void change_at(const Place& place, std::vector<Place>& places, Choice& choice) const;
  void change_list(const Place& place, Choice& choice) const;
  void change_object(const Place& place, Choice& choice) const;

  KnownJson known_;
};

}  // namespace minkray::fuzz
