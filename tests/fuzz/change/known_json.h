// SPDX-License-Identifier: MIT
// Possible contents of JSON documents of a kind: values by their keys, and keys by the object that
// holds them. Learned from documents, and from the schema that the readers' own descriptions make.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/fuzz/change/choice.h"

namespace minkray::fuzz {

using JsonValue = nlohmann::ordered_json;

class KnownJson {
 public:
  /// `words` are what readers compare keys and values with.
  explicit KnownJson(std::vector<std::string> words) : words_(std::move(words)) {}

  /// Learns what a document holds; `under` is the key that holds it.
  void learn(const JsonValue& value, const std::string& under = "");
  /// Learns an example of each property that a JSON Schema describes.
  void learn_schema(const JsonValue& schema);

  /// A key for an object that `under` holds, mostly one that was seen there.
  std::string key(const std::string& under, Choice& choice) const;
  /// A value for a key: one that was seen there, or a number, or a word.
  JsonValue value(const std::string& key, Choice& choice) const;
  std::string word(Choice& choice) const;

 private:
  void keep(const std::string& key, const JsonValue& value);
  void learn_properties(const JsonValue& schema, const JsonValue& definitions);

  std::vector<std::string> words_;
  std::vector<std::string> keys_;
  std::map<std::string, std::vector<std::string>> keys_under_;
  std::map<std::string, std::vector<JsonValue>> values_;
};

}  // namespace minkray::fuzz
