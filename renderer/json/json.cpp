// SPDX-License-Identifier: MIT
#include "renderer/json/json.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace minkray {
namespace {

/// Makes the error for reading a value as another type.
std::logic_error is_not(const Json& json, const std::string& expected) {
  constexpr std::array<const char*, 8> names = {"null",           "true or false", "a whole number",
                                                "a whole number", "a number",      "a string",
                                                "a list",         "an object"};
  return std::logic_error("JSON: " + std::string(names[static_cast<std::size_t>(json.kind())]) +
                          " is not " + expected);
}

bool is_pair_with_key(const Json& json) {
  return json.is_array() && json.size() == 2 && json[0].is_string();
}

}  // namespace

Json::Json() noexcept : value_(nullptr) {}
Json::Json(std::nullptr_t) noexcept : value_(nullptr) {}
Json::Json(double value) noexcept : value_(value) {}
Json::Json(float value) noexcept : value_(double{value}) {}
Json::Json(std::string value) : value_(std::make_unique<std::string>(std::move(value))) {}
Json::Json(std::string_view value) : Json(std::string(value)) {}
Json::Json(const char* value) : Json(std::string(value)) {}
Json::Json(const std::vector<double>& list)
    : value_(std::make_unique<List>(list.begin(), list.end())) {}
Json::Json(const std::vector<std::string>& list)
    : value_(std::make_unique<List>(list.begin(), list.end())) {}

Json::Json(const std::vector<Json>& list) : value_(std::make_unique<List>(list)) {}

Json::Json(std::initializer_list<Json> items) {
  if (!std::all_of(items.begin(), items.end(), is_pair_with_key)) {
    *this = array(items);
    return;
  }
  *this = object();
  for (const Json& item : items) (*this)[item[0].text()] = item[1];
}

Json::Json(const Json& other) {
  std::visit(
      [&]<class V>(const V& value) {
        if constexpr (requires { *value; })
          value_ = std::make_unique<typename V::element_type>(*value);
        else
          value_ = value;
      },
      other.value_);
}

Json::Json(Json&& other) noexcept : value_(std::exchange(other.value_, nullptr)) {}
Json& Json::operator=(Json other) noexcept {
  value_ = std::move(other.value_);
  return *this;
}
Json::~Json() = default;

Json Json::array() {
  return array({});
}

Json Json::array(std::initializer_list<Json> items) {
  Json json;
  json.value_ = std::make_unique<List>(items);
  return json;
}

Json Json::object() {
  Json json;
  json.value_ = std::make_unique<Members>();
  return json;
}

Json::Kind Json::kind() const {
  return static_cast<Kind>(value_.index());
}

bool Json::is_number() const {
  return kind() == Kind::integer || kind() == Kind::natural || kind() == Kind::real;
}

namespace {

/// Casts whichever of the three kinds of numbers it is.
template <class T, class Value>
T number(const Json& json, const Value& value) {
  return std::visit(
      [&]<class V>(const V& v) -> T {
        if constexpr (std::is_arithmetic_v<V> && !std::is_same_v<V, bool>)
          return static_cast<T>(v);
        else
          throw is_not(json, "a number");
      },
      value);
}

}  // namespace

template <>
double Json::get<double>() const {
  return number<double>(*this, value_);
}
template <>
int Json::get<int>() const {
  return number<int>(*this, value_);
}
template <>
std::uint64_t Json::get<std::uint64_t>() const {
  return number<std::uint64_t>(*this, value_);
}
template <>
bool Json::get<bool>() const {
  if (!is_boolean()) throw is_not(*this, "true or false");
  return std::get<bool>(value_);
}
template <>
std::string Json::get<std::string>() const {
  return text();
}

const std::string& Json::text() const {
  if (!is_string()) throw is_not(*this, "a string");
  return *std::get<std::unique_ptr<std::string>>(value_);
}

std::size_t Json::size() const {
  if (is_array()) return std::get<std::unique_ptr<List>>(value_)->size();
  if (is_object()) return members().size();
  return is_null() ? 0 : 1;
}

const Json* Json::begin() const {
  return is_array() ? std::get<std::unique_ptr<List>>(value_)->data() : nullptr;
}
const Json* Json::end() const {
  return is_array() ? begin() + size() : nullptr;
}

const Json& Json::operator[](std::size_t index) const {
  if (!is_array()) throw is_not(*this, "a list");
  return std::get<std::unique_ptr<List>>(value_)->at(index);
}

void Json::push_back(Json item) {
  if (is_null()) *this = array();
  if (!is_array()) throw is_not(*this, "a list");
  std::get<std::unique_ptr<List>>(value_)->push_back(std::move(item));
}

const Json::Members& Json::members() const {
  if (!is_object()) throw is_not(*this, "an object");
  return *std::get<std::unique_ptr<Members>>(value_);
}

const Json* Json::find(std::string_view key) const {
  if (!is_object()) return nullptr;
  for (const Member& member : members()) {
    if (member.key == key) return &member.value;
  }
  return nullptr;
}

const Json& Json::at(std::string_view key) const {
  if (const Json* value = find(key)) return *value;
  throw is_not(*this, "an object with the key \"" + std::string(key) + "\"");
}

Json& Json::operator[](std::string_view key) {
  if (is_null()) *this = object();
  members();  // throws if it is something else
  Members& members = *std::get<std::unique_ptr<Members>>(value_);
  for (Member& member : members) {
    if (member.key == key) return member.value;
  }
  return members.emplace_back(Member{std::string(key), Json()}).value;
}

void Json::add_new_member(std::string key, Json value) {
  if (is_null()) *this = object();
  members();  // throws if it is something else
  std::get<std::unique_ptr<Members>>(value_)->push_back({std::move(key), std::move(value)});
}

void Json::erase(std::string_view key) {
  members();  // throws if it is something else
  std::erase_if(*std::get<std::unique_ptr<Members>>(value_),
                [&](const Member& member) { return member.key == key; });
}

bool Json::operator==(const Json& other) const {
  if (is_number() && other.is_number()) {
    if (kind() == other.kind()) return value_ == other.value_;
    return get<double>() == other.get<double>();
  }
  if (kind() != other.kind()) return false;
  if (is_string()) return text() == other.text();
  if (is_array()) return std::equal(begin(), end(), other.begin(), other.end());
  if (is_object()) {
    return std::equal(
        members().begin(), members().end(), other.members().begin(), other.members().end(),
        [](const Member& a, const Member& b) { return a.key == b.key && a.value == b.value; });
  }
  return value_ == other.value_;
}

}  // namespace minkray
