// SPDX-License-Identifier: MIT
// A cylinder around the z axis, cut by two planes that may be oblique.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "core/math/vec.h"
#include "core/support/declared.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

/// All points with x^2 + y^2 <= radius^2 between the lower plane z = heights[0] +
/// lower_slope . (x, y) and the upper plane z = heights[1] + upper_slope . (x, y).
struct CutCylinder {
  double radius = 1.0;
  std::array<double, 2> heights = {-1.0, 1.0};
  std::array<double, 2> lower_slope = {0.0, 0.0};
  std::array<double, 2> upper_slope = {0.0, 0.0};

  static constexpr std::string_view name = "cut_cylinder";
  static constexpr std::string_view doc =
      "A cylinder around the z axis, cut off by two planes at any angle.";
  static constexpr Declared declared = {.slanted = true, .heights = true};
  static constexpr auto fields() {
    return std::tuple{
        Field{"radius", &CutCylinder::radius, Unit::length, Range::positive, "its radius"},
        Field{"heights", &CutCylinder::heights, Unit::length, Range::any,
              "the heights at which the lower and the upper plane cross the z axis"},
        Field{"lower_slope", &CutCylinder::lower_slope, Unit::none, Range::any,
              "the slope of the lower plane along x, along y", true},
        Field{"upper_slope", &CutCylinder::upper_slope, Unit::none, Range::any,
              "the slope of the upper plane along x, along y", true}};
  }

  /// Reports planes that cross inside the cylinder. The planes may touch at the cylinder's surface.
  std::optional<Misfit> misfit() const {
    using std::hypot;
    constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
    const double needed =
        radius * hypot(upper_slope[0] - lower_slope[0], upper_slope[1] - lower_slope[1]);
    if (heights[1] - heights[0] >= needed * (1.0 - rounding)) return {};
    return Misfit{"heights",
                  "must be rising, and so far apart that the planes do not cross within the "
                  "cylinder: the difference must be at least",
                  double(needed)};
  }

  /// Half of the planes' distance, measured where they are furthest apart.
  long double half_thickness() const {
    using Long = long double;
    const Long apart = Long(heights[1]) - Long(heights[0]) +
                       Long(radius) * std::hypot(Long(upper_slope[0]) - Long(lower_slope[0]),
                                                 Long(upper_slope[1]) - Long(lower_slope[1]));
    const Long steepness = std::min(std::hypot(lower_slope[0], lower_slope[1]),
                                    std::hypot(upper_slope[0], upper_slope[1]));
    return apart / 2 / std::hypot(Long(1), steepness);
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    const Rims<W> rims(*this, n);
    const Vec3<W> p = select<W>(rims.is_upper, rims.upper, rims.lower) * W(radius);
    const auto height = [&](std::size_t k, const std::array<double, 2>& slope) -> W {
      return W(heights[k]) + W(slope[0]) * p.x() + W(slope[1]) * p.y();
    };
    return {p.x(), p.y(), select(rims.is_upper, height(1, upper_slope), height(0, lower_slope))};
  }

  /// Jet of the ellipse that contains the support point. The ellipse is the cylinder's cut by the
  /// lower or the upper plane.
  template <class W>
  Jet<W> jet(const Vec3<W>& n) const {
    const Mask<W> is_upper = Rims<W>(*this, n).is_upper;
    const auto either = [&](const W& lower, const W& upper) {
      return select(is_upper, upper, lower);
    };
    Jet<W> jet;
    jet.c.z() = either(W(heights[0]), W(heights[1]));
    jet.F(0, 0) = jet.F(1, 1) = W(radius);
    jet.F(2, 0) = either(W(radius) * W(lower_slope[0]), W(radius) * W(upper_slope[0]));
    jet.F(2, 1) = either(W(radius) * W(lower_slope[1]), W(radius) * W(upper_slope[1]));
    return jet;
  }

 private:
  /// Finds, for the ellipse in each plane, the point furthest along n. Stores the two points
  /// projected to the unit disk; `is_upper` is set if the upper ellipse reaches further.
  template <class W>
  struct Rims {
    Vec3<W> lower, upper;
    Mask<W> is_upper;

    Rims(const CutCylinder& shape, const Vec3<W>& n) {
      const auto seen_along_axis = [&](const std::array<double, 2>& slope) -> Vec3<W> {
        return {n.x() + n.z() * W(slope[0]), n.y() + n.z() * W(slope[1]), W(0)};
      };
      const Vec3<W> a = seen_along_axis(shape.lower_slope), b = seen_along_axis(shape.upper_slope);
      lower = unit<W>(a);
      upper = unit<W>(b);
      is_upper = n.z() * (W(shape.heights[1]) - W(shape.heights[0])) +
                     (b.dot(upper) - a.dot(lower)) * W(shape.radius) >
                 W(0);
    }
  };
};

}  // namespace minkray
