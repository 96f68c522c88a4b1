// SPDX-License-Identifier: MIT
#include "tests/fuzz/change/known_json.h"

#include <algorithm>

namespace minkray::fuzz {
namespace {

constexpr std::size_t most_keys = 2000, most_values_of_a_key = 40, longest_value = 1000;

constexpr std::size_t most_items = 16;

/// Schemas refer to themselves: shapes are made of shapes.
constexpr int deepest_example = 4;

/// Examples allowed by a schema: for alternatives one of each, as far as `depth` allows more than
/// one.
std::vector<JsonValue> examples_of(const JsonValue& schema, const JsonValue& definitions,
                                   int depth) {
  if (const auto at = schema.find("$ref"); at != schema.end()) {
    const std::string name = at->get<std::string>();
    const auto definition = definitions.find(name.substr(name.rfind('/') + 1));
    if (definition == definitions.end() || depth >= deepest_example) return {};
    return examples_of(*definition, definitions, depth + 1);
  }
  if (const auto at = schema.find("const"); at != schema.end()) return {*at};
  if (const auto at = schema.find("enum"); at != schema.end()) return {at->begin(), at->end()};
  for (const char* of : {"oneOf", "anyOf"})
    if (const auto at = schema.find(of); at != schema.end() && !schema.contains("type")) {
      std::vector<JsonValue> all;
      for (const JsonValue& alternative : *at) {
        for (JsonValue& example : examples_of(alternative, definitions, depth))
          all.push_back(std::move(example));
        if (depth > 1 && !all.empty()) break;
      }
      return all;
    }
  const std::string type = schema.value("type", "");
  if (type == "number") return {0.5};
  if (type == "integer") return {2};
  if (type == "boolean") return {true};
  if (type == "string") return {"m"};
  if (type == "array") {
    JsonValue list = JsonValue::array();
    const auto items = schema.find("items");
    const auto item = items == schema.end() ? std::vector<JsonValue>()
                                            : examples_of(*items, definitions, depth + 1);
    const std::size_t count =
        std::clamp(schema.value("minItems", std::size_t{1}), std::size_t{1}, most_items);
    for (std::size_t i = 0; i < count && !item.empty(); ++i) list.push_back(item[i % item.size()]);
    return {list};
  }
  if (schema.contains("properties")) {
    JsonValue object = JsonValue::object();
    for (const auto& [key, property] : schema["properties"].items())
      if (const auto all = examples_of(property, definitions, depth + 1); !all.empty())
        object[key] = all.front();
    return {object};
  }
  return {};
}

}  // namespace

void KnownJson::keep(const std::string& key, const JsonValue& value) {
  if (!values_.contains(key) && values_.size() >= most_keys) return;
  std::vector<JsonValue>& kept = values_[key];
  if (kept.empty()) keys_.push_back(key);
  if (kept.size() >= most_values_of_a_key || std::ranges::find(kept, value) != kept.end()) return;
  const auto replace = JsonValue::error_handler_t::replace;
  if (value.dump(-1, ' ', false, replace).size() <= longest_value) kept.push_back(value);
}

void KnownJson::learn(const JsonValue& value, const std::string& under) {
  if (value.is_array())
    for (const JsonValue& item : value) learn(item, under);
  if (!value.is_object()) return;
  for (const auto& [key, member] : value.items()) {
    keep(key, member);
    if (std::vector<std::string>& keys = keys_under_[under];
        keys.size() < most_keys && std::ranges::find(keys, key) == keys.end())
      keys.push_back(key);
    learn(member, key);
  }
}

void KnownJson::learn_schema(const JsonValue& schema) {
  learn_properties(schema, schema.value("$defs", JsonValue::object()));
}

void KnownJson::learn_properties(const JsonValue& schema, const JsonValue& definitions) {
  if (const auto at = schema.is_object() ? schema.find("properties") : schema.end();
      at != schema.end())
    for (const auto& [key, property] : at->items())
      for (const JsonValue& example : examples_of(property, definitions, 0)) {
        keep(key, example);
        learn(example, key);
      }
  if (schema.is_structured())
    for (const JsonValue& part : schema) learn_properties(part, definitions);
}

std::string KnownJson::word(Choice& choice) const {
  if (words_.empty()) return "m";
  return choice.of(words_);
}

std::string KnownJson::key(const std::string& under, Choice& choice) const {
  const auto at = keys_under_.find(under);
  if (at != keys_under_.end() && !choice.one_in(4)) return choice.of(at->second);
  if (!keys_.empty() && choice.one_in(2)) return choice.of(keys_);
  return word(choice);
}

JsonValue KnownJson::value(const std::string& key, Choice& choice) const {
  const auto at = values_.find(key);
  if (at != values_.end() && !at->second.empty() && !choice.one_in(8)) return choice.of(at->second);
  switch (choice.below(6)) {
    case 0:
      return word(choice);
    case 1:
      return nullptr;
    case 2:
      return choice.one_in(2);
    case 3:
      return JsonValue::array();
    case 4:
      return JsonValue::object();
    default:
      return changed_number(1, choice);
  }
}

}  // namespace minkray::fuzz
