// SPDX-License-Identifier: MIT
// Columns of results for Python: arrays that the C interface fills, and members of its structs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>

#include "renderer/library/python/arrays.h"

namespace minkray_python {

/// Adds an array of n rows to a dict, of `width` numbers each unless that is 0, and returns its
/// first number, to be filled.
template <class T>
T* add_column(py::dict& to, const char* name, py::ssize_t n, py::ssize_t width = 0) {
  py::array_t<T> array = width == 0 ? py::array_t<T>(n) : py::array_t<T>({n, width});
  to[name] = array;
  return array.mutable_data();
}

/// Adds a member of each row, which may be an array of numbers, converted to T.
template <class T, class Row, class M>
void add_column(py::dict& to, const char* name, std::span<const Row> rows, M Row::*member) {
  constexpr std::size_t width = std::extent_v<M>;
  T* next = add_column<T>(to, name, static_cast<py::ssize_t>(rows.size()), width);
  for (const Row& row : rows) {
    if constexpr (width == 0)
      *next++ = static_cast<T>(row.*member);
    else
      next = std::copy_n(row.*member, width, next);
  }
}

/// Adds it as it is.
template <class Row, class M>
void add_column(py::dict& to, const char* name, std::span<const Row> rows, M Row::*member) {
  add_column<std::remove_extent_t<M>>(to, name, rows, member);
}

}  // namespace minkray_python
