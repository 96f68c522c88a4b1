// SPDX-License-Identifier: MIT
// Descriptions of a shape's parameters. Used to read and write JSON, to name a parameter in error
// messages, for `minkray info --shapes`, and for the JSON Schema.
#pragma once

#include <string_view>
#include <tuple>

namespace minkray {

enum class Unit { none, length, degrees };

/// Valid values of a number. All numbers must be finite. zero_to_180 excludes both ends.
enum class Range {
  any,
  positive,
  not_negative,
  at_least_one,
  zero_to_one,
  zero_to_180,
  brightness
};

/// Largest brightness of a light, in the scene's unit. Products of a few such numbers, and sums of
/// millions, stay finite in a picture of floats (up to 3.4e38).
inline constexpr double most_brightness = 1e15;

/// One parameter: a member of shape S. The member's type determines the JSON form: T is a number;
/// std::array<T, 2> and Vec3<T> are lists of two and three numbers; std::array<Vec3<T>, N> is a
/// list of N points; Nested is a shape; ShapeList is a list of shapes; PointCloud is points or a
/// mesh file; AffineMap is the keys `translate`, `rotate`, `scale` or `matrix`. An optional
/// parameter keeps its initial value if left out.
template <class S, class M>
struct Field {
  using Member = M;

  std::string_view name;
  M S::*member;
  Unit unit;
  Range range;
  std::string_view doc;
  bool optional = false;
};

template <class S, class M>
Field(std::string_view, M S::*, Unit, Range, std::string_view) -> Field<S, M>;
template <class S, class M>
Field(std::string_view, M S::*, Unit, Range, std::string_view, bool) -> Field<S, M>;

/// A parameter that contradicts others of its shape, and the requirement that it violates: a text
/// followed by a number. Shapes whose parameters depend on each other have a function misfit().
struct Misfit {
  std::string_view parameter;
  std::string_view must_be;
  double number;
};

/// Calls visit(field) for every parameter of shape S, in order.
template <class S, class Visit>
constexpr void for_each_field(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, S::fields());
}

}  // namespace minkray
