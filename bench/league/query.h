// SPDX-License-Identifier: MIT
// Shared by the sources of the adapters' library.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/league/adapter.h"

namespace league {

struct Unsupported {
  std::string why;
};

inline double dot(const Vec& u, const Vec& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

inline Vec mapped(const Rows& rows, const Vec& p) {
  return {dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)};
}

/// The query of a line; throws Unsupported for shapes that no adapter could have.
Query read_query(const nlohmann::json& json);

}  // namespace league
