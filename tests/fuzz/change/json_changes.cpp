// SPDX-License-Identifier: MIT
#include "tests/fuzz/change/json_changes.h"

#include <algorithm>
#include <cstdint>

namespace minkray::fuzz {

/// A value of a document, and the key that holds it or the list that it is in.
struct JsonChanges::Place {
  JsonValue* value;
  std::string under;
};

namespace {

/// Deeper documents are left to changes of bytes: they are visited by recursion here.
constexpr int deepest = 200;

/// One of this many documents is learned from.
constexpr std::size_t one_learned = 4;

int depth_of(std::string_view text) {
  int depth = 0, most = 0;
  for (const char c : text) {
    depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
    most = std::max(most, depth);
  }
  return most;
}

template <class Place>
void collect(JsonValue& value, const std::string& under, std::vector<Place>& places) {
  places.push_back({&value, under});
  if (value.is_array())
    for (JsonValue& item : value) collect(item, under, places);
  if (value.is_object())
    for (auto it = value.begin(); it != value.end(); ++it) collect(it.value(), it.key(), places);
}

JsonValue changed(const JsonValue& number, Choice& choice) {
  const double x = changed_number(number.get<double>(), choice);
  constexpr double exact = 9007199254740992.0;
  if (number.is_number_integer() && x == std::floor(x) && std::abs(x) <= exact)
    return static_cast<std::int64_t>(x);
  return x;
}

}  // namespace

void JsonChanges::change_list(const Place& place, Choice& choice) const {
  JsonValue& list = *place.value;
  const auto some = [&] {
    return list.begin() + static_cast<std::ptrdiff_t>(choice.below(list.size()));
  };
  switch (choice.below(5)) {
    case 0:
      list.erase(some());
      break;
    case 1:
      std::iter_swap(some(), some());
      break;
    case 2: {
      JsonValue copy = *some();
      list.insert(some(), std::move(copy));
      break;
    }
    case 3: {
      const JsonValue seen = known_.value(place.under, choice);
      list.push_back(seen.is_array() && !seen.empty() ? seen[choice.below(seen.size())] : seen);
      break;
    }
    default:
      list = JsonValue(list[choice.below(list.size())]);
      break;
  }
}

void JsonChanges::change_object(const Place& place, Choice& choice) const {
  JsonValue& object = *place.value;
  const auto add = [&] {
    const std::string key = known_.key(place.under, choice);
    object[key] = known_.value(key, choice);
  };
  if (object.empty()) return add();
  auto some = object.begin();
  std::advance(some, static_cast<std::ptrdiff_t>(choice.below(object.size())));
  switch (choice.below(6)) {
    case 0:
      object.erase(some);
      break;
    case 1: {  // another name for it
      JsonValue value = some.value();
      object.erase(some);
      object[known_.key(place.under, choice)] = std::move(value);
      break;
    }
    case 2:
    case 3:
      some.value() = known_.value(some.key(), choice);
      break;
    default:
      add();
      break;
  }
}

void JsonChanges::change_at(const Place& place, std::vector<Place>& places, Choice& choice) const {
  JsonValue& value = *place.value;
  switch (choice.below(8)) {
    case 0: {  // by another value of the document
      JsonValue other = *choice.of(places).value;
      value = std::move(other);
      return;
    }
    case 1:
      value = known_.value(place.under, choice);
      return;
    case 2:
      if (choice.one_in(3)) {
        JsonValue inner = std::move(value);
        value = JsonValue::array({std::move(inner)});
        return;
      }
      break;
    default:
      break;
  }
  if (value.is_array() && !value.empty()) return change_list(place, choice);
  if (value.is_object()) return change_object(place, choice);
  if (value.is_number()) {
    value = changed(value, choice);
  } else if (value.is_string()) {
    // Names refer to each other: another text of the document is more than a word.
    std::vector<std::string> texts;
    for (const Place& other : places)
      if (other.value->is_string()) texts.push_back(other.value->get<std::string>());
    value = choice.one_in(2) ? choice.of(texts) : known_.word(choice);
  } else {
    value = known_.value(place.under, choice);
  }
}

std::optional<std::string> JsonChanges::change_document(std::string_view text, Choice& choice) {
  if (depth_of(text) > deepest) return std::nullopt;
  JsonValue document = JsonValue::parse(text, nullptr, false);
  if (document.is_discarded()) return std::nullopt;
  if (choice.one_in(one_learned)) known_.learn(document);
  for (std::size_t count = 1 + choice.below(3); count > 0; --count) {
    std::vector<Place> places;
    collect(document, "", places);
    // Numbers outnumber all else: what holds them gets its share.
    const auto structured = [](const Place& place) { return place.value->is_structured(); };
    if (choice.one_in(2)) {
      std::vector<Place> holders;
      std::ranges::copy_if(places, std::back_inserter(holders), structured);
      if (!holders.empty()) {
        change_at(choice.of(holders), places, choice);
        continue;
      }
    }
    change_at(choice.of(places), places, choice);
  }
  return document.dump(-1, ' ', false, JsonValue::error_handler_t::replace);
}

std::optional<std::string> JsonChanges::change_line(std::string_view bytes, Choice& choice) {
  std::vector<std::string> lines;
  while (!bytes.empty()) {
    lines.emplace_back(bytes.substr(0, bytes.find('\n')));
    bytes.remove_prefix(std::min(lines.back().size() + 1, bytes.size()));
  }
  if (lines.size() < 2) return std::nullopt;
  const std::size_t at = choice.below(lines.size());
  const auto place = lines.begin() + static_cast<std::ptrdiff_t>(at);
  if (choice.one_in(8)) {
    lines.erase(place);
  } else if (choice.one_in(8)) {
    lines.insert(place, std::string(lines[at]));
  } else {
    const auto changed_line = change_document(lines[at], choice);
    if (!changed_line) return std::nullopt;
    lines[at] = *changed_line;
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// A header of 12 bytes, the second number of whose is the file's length; then the length of the
/// JSON, its kind, and the JSON itself, which blanks make a multiple of 4 bytes long.
std::optional<std::string> JsonChanges::change_binary(std::string_view bytes, Choice& choice) {
  constexpr std::size_t length_at = 8, json_length_at = 12, json_at = 20;
  const auto number_at = [&](std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = 4; i-- > 0;)
      number = number * 256 + static_cast<unsigned char>(bytes[at + i]);
    return number;
  };
  if (bytes.size() < json_at || number_at(json_length_at) > bytes.size() - json_at)
    return std::nullopt;
  const std::size_t length = number_at(json_length_at);
  auto json = change_document(bytes.substr(json_at, length), choice);
  if (!json) return std::nullopt;
  json->resize((json->size() + 3) / 4 * 4, ' ');
  std::string file =
      std::string(bytes.substr(0, json_at)) + *json + std::string(bytes.substr(json_at + length));
  const auto put = [&](std::size_t at, std::size_t number) {
    for (std::size_t i = 0; i < 4; ++i) file[at + i] = static_cast<char>(number >> 8 * i & 255);
  };
  put(length_at, file.size());
  put(json_length_at, json->size());
  return file;
}

std::optional<std::string> JsonChanges::change(std::string_view bytes, Choice& choice) {
  if (bytes.starts_with("glTF")) return change_binary(bytes, choice);
  if (auto document = change_document(bytes, choice)) return document;
  return change_line(bytes, choice);
}

}  // namespace minkray::fuzz
