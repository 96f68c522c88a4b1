// SPDX-License-Identifier: MIT
#include "renderer/json/object_reader.h"

#include <algorithm>
#include <numeric>

#include "renderer/json/values.h"

namespace minkray {
namespace {

/// Longer words are not compared: nobody mistypes those.
constexpr std::size_t longest_word = 64;
/// The beginning is told of longer lists.
constexpr std::size_t most_names = 40;

/// How many letters must be added, removed, changed or swapped with their neighbour to turn one
/// word into the other (optimal string alignment, Damerau 1964).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  std::iota(d[0].begin(), d[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string suggestion(std::string_view written, const std::vector<std::string>& names) {
  if (names.empty()) return "none is known here";
  if (written.size() <= longest_word) {
    std::vector<std::size_t> distances;
    for (const std::string& name : names) distances.push_back(edit_distance(written, name));
    const auto least = std::ranges::min_element(distances);
    const std::string& closest = names[static_cast<std::size_t>(least - distances.begin())];
    // A third of the letters may be wrong.
    if (*least * 3 <= std::max<std::size_t>(closest.size(), 3)) {
      return "did you mean \"" + closest + "\"?";
    }
  }
  std::string text = "known here:";
  for (std::size_t i = 0; i < std::min(names.size(), most_names); ++i)
    text += (i == 0 ? " " : ", ") + names[i];
  if (names.size() > most_names)
    text += " and " + std::to_string(names.size() - most_names) + " more";
  return text;
}

ObjectReader::ObjectReader(const Json& json, JsonPath path, Mistakes& mistakes)
    : json_(json), path_(std::move(path)), mistakes_(mistakes), is_object_(json.is_object()) {
  if (!is_object_) mistakes_.add(path_, "must be an object (" + found(json) + ")");
}

const Json* ObjectReader::find(std::string_view key) {
  allow({key});
  if (!is_object_) return nullptr;
  return json_.find(key);
}

const Json* ObjectReader::require(std::string_view key, std::string_view expected) {
  const Json* value = find(key);
  if (!value && is_object_) {
    mistakes_.add(path_ / key, "missing: must be " + std::string(expected));
  }
  return value;
}

void ObjectReader::allow(std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  }
}

bool ObjectReader::finish() {
  if (!is_object_) return false;
  bool all_known = true;
  for (const Json::Member& member : json_.members()) {
    if (std::find(known_.begin(), known_.end(), member.key) == known_.end()) {
      mistakes_.add(path_ / member.key, "unknown key (" + suggestion(member.key, known_) + ")");
      all_known = false;
    }
  }
  return all_known;
}

}  // namespace minkray
