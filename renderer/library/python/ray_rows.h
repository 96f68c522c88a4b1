// SPDX-License-Identifier: MIT
// Rays in arrays, for the C interface.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "renderer/library/python/arrays.h"

namespace minkray_python {

/// Rays (N, 6) and their ends: a number, or (N,). Arrays of float64 and float32 are not copied if
/// the numbers of a row, or the ends, lie one behind the other.
class RayRows {
 public:
  RayRows(const py::object& rays, const py::object& ends) {
    arrays_.size = sizeof arrays_;
    if (py::isinstance<py::array_t<float>>(rays))
      take(rows_of<float>(rays, 6, "rays"), arrays_.float_origins, arrays_.float_directions);
    else
      take(rows_of<double>(rays, 6, "rays"), arrays_.origins, arrays_.directions);
    if (ends.is_none()) return;
    if (py::isinstance<py::array_t<float>>(ends))
      take_ends(ends, arrays_.float_t_max);
    else
      take_ends(ends, arrays_.t_max);
  }

  std::size_t size() const { return count_; }
  const minkray_ray_arrays* arrays() const { return &arrays_; }

  /// The rays as structs.
  std::vector<minkray_ray> plain() const {
    std::vector<minkray_ray> plain(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      if (arrays_.origins)
        put_row(arrays_.origins, i, plain[i]);
      else
        put_row(arrays_.float_origins, i, plain[i]);
      double& t_max = plain[i].t_max;
      t_max = arrays_.t_max         ? arrays_.t_max[i]
              : arrays_.float_t_max ? double{arrays_.float_t_max[i]}
                                    : std::numeric_limits<double>::infinity();
      // In a struct a zero is no end. Nothing lies between it and the next number.
      if (t_max == 0) t_max = std::numeric_limits<double>::denorm_min();
    }
    return plain;
  }

 private:
  template <class Number>
  void take(const Rows<Number>& rows, const Number*& origins, const Number*& directions) {
    rays_ = rows.array;
    count_ = rows.count;
    origins = rows.first;
    directions = rows.first ? rows.first + 3 : nullptr;
    arrays_.origin_stride = arrays_.direction_stride = rows.stride;
  }
  template <class Number>
  void take_ends(const py::object& ends, const Number*& to) {
    using Numbers = py::array_t<Number, py::array::c_style | py::array::forcecast>;
    Numbers given = Numbers::ensure(ends);
    if (!given) PyErr_Clear();
    if (given && given.ndim() == 0) {
      const Number one = *given.data();
      given = Numbers(static_cast<py::ssize_t>(count_));
      std::fill_n(given.mutable_data(), count_, one);
    }
    if (!given || static_cast<std::size_t>(given.size()) != count_)
      throw py::value_error("t_max: must be a number, or one per ray");
    to = given.data();
    ends_ = given;
  }
  template <class Number>
  void put_row(const Number* first, std::size_t i, minkray_ray& to) const {
    const auto* row =
        reinterpret_cast<const Number*>(reinterpret_cast<const char*>(first) +
                                        arrays_.origin_stride * static_cast<std::ptrdiff_t>(i));
    std::copy_n(row, 3, to.origin);
    std::copy_n(row + 3, 3, to.direction);
  }

  py::object rays_, ends_;  ///< for as long as they are read
  std::size_t count_ = 0;
  minkray_ray_arrays arrays_ = {};
};

}  // namespace minkray_python
