// SPDX-License-Identifier: MIT
// Result of a cast: status, hit parameter, normal and cost.
#pragma once

#include <string_view>

#include "core/math/vec.h"
#include "core/support/named_kind.h"

namespace minkray {

enum class Status : unsigned char {
  hit,        ///< the ray enters the shape at t > 0
  miss,       ///< no point of the ray with 0 <= t <= t_max lies in the shape; proven by a plane
  inside,     ///< the ray's origin lies in the shape: t = 0
  exhausted,  ///< the solver did not converge; the ray may hit or miss
};

constexpr std::string_view name_of(Status status) {
  return name_at({"hit", "miss", "inside", "exhausted"}, status);
}

/// Stage of a cast that gave the result (docs/rays.md).
enum class Path : unsigned char {
  filter,  ///< a closed form with an error bound
  /// Bounding volumes, the first contact of a sum's operands, or a local model of the shape,
  /// confirmed by supporting planes.
  model,
  gjk,    ///< the GJK ray cast, which uses only the support mapping
  finer,  ///< a second cast with more digits, and a proof
};

inline constexpr std::size_t path_count = 4;

constexpr std::string_view name_of(Path path) {
  return name_at({"filter", "model", "gjk", "finer"}, path);
}

/// Result of every ray cast. All vectors are in the frame of the ray that was cast.
template <class T>
struct CastResult {
  Status status = Status::exhausted;
  Path path = Path::model;

  /// The hit parameter t is t_base + t_offset. t_base is the parameter of the ray's point closest
  /// to the shape's centre; t_offset is the rest. The two are stored separately since, for a far
  /// origin, their rounded sum no longer locates the hit on the shape.
  T t_base = T(0);
  T t_offset = T(0);

  /// Bounds of the hit parameter: t_base + offset_lo and t_base + offset_hi, for the shape at its
  /// prepared pose. On the path `filter` the bounds are the closed form's error bound. Otherwise
  /// the lower bound comes from a supporting plane, and the upper bound from support points that
  /// the ray passes between; both include rounding. The upper bound is infinite if no such points
  /// were found, for example if the ray passes within rounding of an edge, or if the caller chose a
  /// solver by name.
  T offset_lo = T(0);
  T offset_hi = std::numeric_limits<T>::infinity();

  /// Hit: the outward unit normal at the hit point (at an edge, one of the normals). Miss: the
  /// normal of a plane between ray and shape. Inside: zero.
  Vec3<T> normal = Vec3<T>::Zero();

  int iterations = 0;
  int supports = 0;  ///< support points of the search, not counting those for the upper bound

  T t() const { return t_base + t_offset; }
  bool found() const { return status == Status::hit || status == Status::inside; }
};

}  // namespace minkray
