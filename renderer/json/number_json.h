// SPDX-License-Identifier: MIT
// Numbers in results: the fewest digits that read back as the same float or double, and null if not
// finite.
#pragma once

#include <charconv>
#include <cmath>

#include "core/math/vec.h"
#include "renderer/json/json.h"

namespace minkray {

inline Json number_json(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// Uses its shortest decimal, so that 0.1f is written 0.1.
inline Json number_json(float value) {
  if (!std::isfinite(value)) return nullptr;
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double shortest = 0;
  std::from_chars(text, end, shortest);
  return shortest;
}

template <class T, int Dim>
Json point_json(const Eigen::Matrix<T, Dim, 1>& point) {
  Json list = Json::array();
  for (int i = 0; i < Dim; ++i) list.push_back(number_json(point[i]));
  return list;
}

}  // namespace minkray
