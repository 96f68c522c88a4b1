// SPDX-License-Identifier: MIT
// NumPy arrays for the C interface: rows of doubles, copied only where necessary.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>

#include "renderer/library/python/public_header.h"

namespace minkray_python {

namespace py = pybind11;

/// Any array of doubles, with any strides; others are converted.
using AnyDoubles = py::array_t<double, py::array::forcecast>;
/// Arrays that lie one row behind the other.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Rows of `width` numbers, each in one piece; others are copied.
template <class Number>
struct Rows {
  py::array_t<Number, py::array::forcecast> array;
  std::size_t count;
  const Number* first;
  py::ssize_t stride;  ///< bytes from row to row
};

/// Throws ValueError, which names the argument, unless it has the shape (N, width).
template <class Number>
Rows<Number> rows_of(const py::object& object, py::ssize_t width, const char* argument) {
  using Any = py::array_t<Number, py::array::forcecast>;
  Any array = Any::ensure(object);
  if (!array) {
    PyErr_Clear();
    throw py::value_error(std::string(argument) + ": must be an array of numbers");
  }
  if (array.ndim() != 2 || array.shape(1) != width) {
    std::string shape = "(";
    for (py::ssize_t i = 0; i < array.ndim(); ++i)
      shape += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
    throw py::value_error(std::string(argument) + ": must have the shape (N, " +
                          std::to_string(width) + ") (got " + shape + "))");
  }
  if (array.shape(0) > 0 && array.strides(1) != static_cast<py::ssize_t>(sizeof(Number)))
    array = py::array_t<Number, py::array::c_style | py::array::forcecast>(array);
  // Such as a part of a file that was read into memory.
  if (reinterpret_cast<std::uintptr_t>(array.data()) % alignof(Number) != 0 ||
      array.strides(0) % static_cast<py::ssize_t>(alignof(Number)) != 0)
    array = Any(array.attr("copy")());
  return {array, static_cast<std::size_t>(array.shape(0)), array.data(), array.strides(0)};
}

/// A (3, 4) or (4, 4) matrix; the identity for None. A last row must be (0, 0, 0, 1).
inline minkray::Pose pose_of(const py::object& object, const char* argument) {
  minkray::Pose pose = minkray::identity();
  if (object.is_none()) return pose;
  const Doubles matrix = Doubles::ensure(object);
  if (!matrix) PyErr_Clear();
  if (!matrix || matrix.ndim() != 2 || matrix.shape(1) != 4 ||
      (matrix.shape(0) != 3 && matrix.shape(0) != 4))
    throw py::value_error(std::string(argument) + ": must be a (4, 4) matrix");
  for (py::ssize_t i = 0; i < matrix.shape(0); ++i)
    for (py::ssize_t j = 0; j < 4; ++j) {
      if (i < 3)
        pose.rows[i][j] = matrix.at(i, j);
      else if (matrix.at(i, j) != (j == 3 ? 1 : 0))
        throw py::value_error(std::string(argument) + ": the last row must be (0, 0, 0, 1)");
    }
  return pose;
}

}  // namespace minkray_python
