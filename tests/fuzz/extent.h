// SPDX-License-Identifier: MIT
// Magnitude of the numbers from which a shape's support points are computed: the reference of
// their rounding. A large shape minus a large shape may be small, but its rounding is no smaller.
#pragma once

#include <Eigen/LU>

#include "core/derived/shape_bounds.h"
#include "core/shape/shape.h"

namespace minkray::fuzz {

struct Extent {
  long double size = 0;       ///< no intermediate coordinate is larger (up to a small factor)
  long double condition = 1;  ///< of the maps around and in the shape, multiplied along the nesting
};

Extent extent_of(const Shape& shape);

namespace detail {

inline void add_operand(Extent& sum, const Nested& operand) {
  const Extent extent = extent_of(*operand);
  sum.size += extent.size;
  sum.condition = std::max(sum.condition, extent.condition);
}

}  // namespace detail

inline Extent under(const Affine<double>& map, const Extent& inner) {
  const Mat3<long double> M = map.linear.cast<long double>();
  return {M.norm() * inner.size + map.translation.cast<long double>().norm(),
          inner.condition * M.norm() * inverse_of<long double>(M).norm() / 3};
}

inline Extent extent_of(const Shape& shape) {
  return std::visit(
      [&]<class S>(const S& kind) -> Extent {
        if constexpr (std::is_same_v<S, Transform>) {
          return under(kind.map.affine(), extent_of(*kind.shape));
        } else {
          Extent extent;
          bool has_operands = false;
          for_each_field<S>([&](const auto& field) {
            using Member = typename std::decay_t<decltype(field)>::Member;
            const Member& member = kind.*(field.member);
            if constexpr (std::is_same_v<Member, Nested>) {
              detail::add_operand(extent, member);
              has_operands = true;
            }
            if constexpr (std::is_same_v<Member, ShapeList>) {
              for (const Nested& operand : member) detail::add_operand(extent, operand);
              has_operands = true;
            }
          });
          const Bounds<double> bounds = bounds_of(kind);
          const double reach =
              std::max(bounds.lower.cwiseAbs().maxCoeff(), bounds.upper.cwiseAbs().maxCoeff());
          // An operator also has its own lengths: all that its bounds have beyond its operands'.
          extent.size =
              has_operands ? std::max(extent.size, 2 * (long double)(reach)) : (long double)(reach);
          return extent;
        }
      },
      shape.kind);
}

}  // namespace minkray::fuzz
