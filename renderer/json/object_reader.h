// SPDX-License-Identifier: MIT
// Reads the keys of one JSON object and records which were requested, so that all others can be
// reported as errors.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

/// Refers to the JSON and the mistakes it is made with.
class ObjectReader {
 public:
  /// JSON that is no object is a mistake and reads as an object without keys.
  ObjectReader(const Json& json, JsonPath path, Mistakes& mistakes);

  /// True if the JSON is an object.
  bool is_object() const { return is_object_; }

  /// The value of a key; null if it is not there. The key counts as known from now on.
  const Json* find(std::string_view key);

  /// Does as find, but a missing key is a mistake: "missing: must be <expected>".
  const Json* require(std::string_view key, std::string_view expected);

  /// Names keys that are valid without being read.
  void allow(std::initializer_list<std::string_view> keys);

  /// Adds a mistake for each key that was not read; returns true if there is none. Call it last.
  bool finish();

  const JsonPath& path() const { return path_; }
  JsonPath path(std::string_view key) const { return path_ / key; }
  Mistakes& mistakes() const { return mistakes_; }

 private:
  /// Suggests the known key that was likely meant by an unknown one.
  std::string key_meant(std::string_view written) const;

  const Json& json_;
  JsonPath path_;
  Mistakes& mistakes_;
  bool is_object_;
  std::vector<std::string> known_;
};

/// "did you mean \"radius\"?" if one of the names is close to what was written, else "known are
/// ..." with all of them.
std::string suggestion(std::string_view written, const std::vector<std::string>& names);

}  // namespace minkray
