// SPDX-License-Identifier: MIT
// Values of an enum with their names, in one table per enum: the command line, files, help and
// messages read the same rows. Tables whose rows have more members are searched as well.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/text.h"

namespace minkray {

template <class E>
struct NamedKind {
  E kind;
  std::string_view name, doc;
};

/// Returns the name of a value; `names` has one per value, in order.
template <class E>
constexpr std::string_view name_at(std::initializer_list<std::string_view> names, E kind) {
  const auto i = static_cast<std::size_t>(kind);
  return i < names.size() ? names.begin()[i] : "unknown";
}

/// Returns the row with this name, or null if the table has no such row.
template <class Table>
constexpr auto row_named(const Table& table, std::string_view name) {
  const auto row = std::ranges::find_if(table, [&](const auto& one) { return one.name == name; });
  return row == std::end(table) ? nullptr : &*row;
}

/// Returns the name of a value, which the table must have.
template <class Table, class E>
constexpr std::string_view name_in(const Table& table, E kind) {
  return std::ranges::find_if(table, [&](const auto& one) { return one.kind == kind; })->name;
}

template <class Table>
std::vector<std::string> names_in(const Table& table) {
  std::vector<std::string> names;
  for (const auto& row : table) names.emplace_back(row.name);
  return names;
}

/// Returns the value with this name. If the table does not have it, throws std::invalid_argument
/// with the known names.
template <class Table>
auto kind_named(const Table& table, std::string_view name) {
  if (const auto row = row_named(table, name)) return row->kind;
  throw std::invalid_argument("must be one of " + listed(names_in(table)) + " (got " +
                              std::string(name) + ")");
}

/// Returns one line of help per row, each after a line break: "\npath: path tracing".
template <class Table>
std::string lines_of_help(const Table& table) {
  std::string lines;
  for (const auto& row : table) lines += "\n" + std::string(row.name) + ": " + std::string(row.doc);
  return lines;
}

}  // namespace minkray
