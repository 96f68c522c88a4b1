// SPDX-License-Identifier: MIT
// Rays in arrays, for the C interface.
#pragma once

#include <limits>
#include <vector>

#include "renderer/library/python/arrays.h"

namespace minkray_python {

/// Rays (N, 6) and their ends: a number, or (N,).
struct RayRows {
  Rows rows;
  Doubles t_max;
  minkray_ray_arrays arrays = {};

  RayRows(const py::object& rays, const py::object& ends) : rows(rows_of(rays, 6, "rays")) {
    arrays = {
        sizeof arrays, rows.first, rows.stride, rows.first ? rows.first + 3 : nullptr, rows.stride,
        nullptr,       0};
    if (ends.is_none()) return;
    t_max = Doubles::ensure(ends);
    if (!t_max) PyErr_Clear();
    const bool is_one = t_max && t_max.ndim() == 0;
    if (!t_max || (!is_one && static_cast<std::size_t>(t_max.size()) != rows.count))
      throw py::value_error("t_max: must be a number, or one per ray");
    arrays.t_max = t_max.data();
    arrays.t_max_stride = is_one ? 0 : static_cast<std::ptrdiff_t>(sizeof(double));
  }

  /// The rays as structs.
  std::vector<minkray_ray> plain() const {
    std::vector<minkray_ray> plain(rows.count);
    for (std::size_t i = 0; i < rows.count; ++i) {
      const auto* row = reinterpret_cast<const double*>(reinterpret_cast<const char*>(rows.first) +
                                                        rows.stride * static_cast<py::ssize_t>(i));
      for (int k = 0; k < 3; ++k) {
        plain[i].origin[k] = row[k];
        plain[i].direction[k] = row[3 + k];
      }
      plain[i].t_max = !arrays.t_max              ? std::numeric_limits<double>::infinity()
                       : arrays.t_max_stride == 0 ? *arrays.t_max
                                                  : arrays.t_max[i];
      // In a struct a zero is no end. Nothing lies between it and the next number.
      if (plain[i].t_max == 0) plain[i].t_max = std::numeric_limits<double>::denorm_min();
    }
    return plain;
  }
};

}  // namespace minkray_python
