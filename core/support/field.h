// SPDX-License-Identifier: MIT
// Descriptions of a shape's parameters. These generate the JSON reader and writer, error messages
// that name the parameter, `minkray info --shapes`, the JSON Schema, the conversion between float
// and double, and the typed tests.
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

/// Largest brightness of a light, in the scene's unit. Products of a few such numbers, or sums of
/// millions, are finite in a picture of floats (up to 3.4e38).
inline constexpr double most_brightness = 1e15;

/// One parameter: a member of shape S. The member's type determines the parameter's JSON: for T a
/// number, for std::array<T, 2> and Vec3<T> a list of two or three numbers, for std::array<Vec3<T>,
/// N> a list of N points, for Nested<T> a shape, for ShapeList<T> a list of shapes, for
/// PointCloud<T> points or a mesh file, for AffineMap<T> the keys of a pose. An omitted optional
/// parameter keeps its initial value.
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

/// A parameter that contradicts others of its shape, and its requirement: a text and a number that
/// follows it. Shapes whose parameters depend on each other have a member function misfit().
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
