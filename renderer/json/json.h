// SPDX-License-Identifier: MIT
// JSON value, compiled once, so users need no library's templates. Only this folder includes
// nlohmann-json, which reads and writes the text of numbers and strings.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace minkray {

/// A JSON value: null, true or false, a number, a string, a list or an object, whose keys stay in
/// the order in which they were added. A braced list makes an object if each of its items is a
/// pair that begins with a string, and a list otherwise; `Json::array` always makes a list.
/// Reading a value as another type throws std::logic_error.
class Json {
 public:
  struct Member;
  using List = std::vector<Json>;
  using Members = std::vector<Member>;
  enum class Kind { null, boolean, integer, natural, real, string, list, object };

  Json() noexcept;  ///< null
  Json(std::nullptr_t) noexcept;
  template <std::integral I>  // a template, so that no pointer is taken for true
  Json(I value) noexcept {
    if constexpr (std::same_as<I, bool>)
      value_ = value;
    else if constexpr (std::signed_integral<I>)
      value_ = std::int64_t{value};
    else
      value_ = std::uint64_t{value};
  }
  Json(double value) noexcept;
  Json(float value) noexcept;
  Json(std::string value);
  Json(std::string_view value);
  Json(const char* value);
  Json(const std::vector<double>& list);
  Json(const std::vector<std::string>& list);
  Json(const std::vector<Json>& list);
  Json(std::initializer_list<Json> items);
  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(Json other) noexcept;
  ~Json();

  static Json array();
  static Json array(std::initializer_list<Json> items);
  static Json object();

  /// Parses the value of a text; throws std::invalid_argument with all mistakes of the text.
  static Json parse(std::string_view text);

  /// The value as text: in one line, or with each item in a line of its own, indented by `indent`
  /// blanks per level. Throws std::logic_error if a string is not valid UTF-8.
  std::string dump(int indent = -1) const;

  Kind kind() const;
  bool is_null() const { return kind() == Kind::null; }
  bool is_boolean() const { return kind() == Kind::boolean; }
  bool is_number() const;
  bool is_number_unsigned() const { return kind() == Kind::natural; }
  bool is_string() const { return kind() == Kind::string; }
  bool is_array() const { return kind() == Kind::list; }
  bool is_object() const { return kind() == Kind::object; }

  /// The value as one of double, int, std::uint64_t, bool and std::string; numbers are cast.
  template <class T>
  T get() const;
  /// The characters of a string.
  const std::string& text() const;

  /// Number of items of a list or an object; 0 for null, 1 for anything else.
  std::size_t size() const;
  bool empty() const { return size() == 0; }

  /// The items of a list; no items for what is none.
  const Json* begin() const;
  const Json* end() const;
  const Json& operator[](std::size_t index) const;
  const Json& operator[](int index) const { return (*this)[static_cast<std::size_t>(index)]; }
  /// Adds an item to a list; null becomes a list first.
  void push_back(Json item);

  /// The members of an object.
  const Members& members() const;
  /// The value of a key, or null if the object does not have it or this is no object.
  const Json* find(std::string_view key) const;
  bool contains(std::string_view key) const { return find(key) != nullptr; }
  /// The value of a key that must be there.
  const Json& at(std::string_view key) const;
  const Json& operator[](std::string_view key) const { return at(key); }
  const Json& operator[](const char* key) const { return at(key); }
  /// The value of a key, which is added, as null, if it is not there; null becomes an object first.
  Json& operator[](std::string_view key);
  Json& operator[](const char* key) { return (*this)[std::string_view(key)]; }
  /// Takes a key and its value away, if it is there.
  void erase(std::string_view key);
  /// Adds a member whose key is known not to be there.
  void add_new_member(std::string key, Json value);

  /// True if two values are equal; objects also in the order of their keys, numbers by value.
  bool operator==(const Json& other) const;

 private:
  std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double,
               std::unique_ptr<std::string>, std::unique_ptr<List>, std::unique_ptr<Members>>
      value_;
};

struct Json::Member {
  std::string key;
  Json value;
};

template <>
double Json::get<double>() const;
template <>
int Json::get<int>() const;
template <>
std::uint64_t Json::get<std::uint64_t>() const;
template <>
bool Json::get<bool>() const;
template <>
std::string Json::get<std::string>() const;

std::ostream& operator<<(std::ostream& out, const Json& json);

}  // namespace minkray
