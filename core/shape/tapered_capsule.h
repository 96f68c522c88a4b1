// SPDX-License-Identifier: MIT
// A tapered capsule along the z axis: the convex hull of two balls of different radii.
#pragma once

#include <array>

#include "core/math/vec.h"
#include "core/support/declared.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

struct TaperedCapsule {
  std::array<double, 2> radii = {1.0, 1.0};
  double half_height = 1.0;

  static constexpr std::string_view name = "tapered_capsule";
  static constexpr std::string_view doc =
      "The convex hull of two balls on the z axis; where one holds the other, that ball.";
  static constexpr Declared declared = {.revolved = true};
  static constexpr auto fields() {
    return std::tuple{Field{"radii", &TaperedCapsule::radii, Unit::length, Range::not_negative,
                            "the balls' radii: at z = -half_height, at z = +half_height"},
                      Field{"half_height", &TaperedCapsule::half_height, Unit::length,
                            Range::not_negative, "half the distance of the balls' centres"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    const Vec3<W> u = unit(n);
    const auto upper = is_upper(u);
    Vec3<W> s = u * select(upper, W(radii[1]), W(radii[0]));
    s.z() += select(upper, W(half_height), W(-half_height));
    return s;
  }

  template <class W>
  AxialBallJet<W> jet(const Vec3<W>& n) const {
    const auto upper = is_upper<W>(unit(n));
    return {select(upper, W(half_height), W(-half_height)),
            select(upper, W(radii[1]), W(radii[0]))};
  }

 private:
  /// True if the upper ball reaches further along the unit vector u.
  template <class W>
  auto is_upper(const Vec3<W>& u) const {
    return u.z() * W(2 * half_height) + (W(radii[1]) - W(radii[0])) * u.squaredNorm() > W(0);
  }
};

}  // namespace minkray
