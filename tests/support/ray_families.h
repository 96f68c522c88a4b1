// SPDX-License-Identifier: MIT
// Kinds of rays that casts are proven and measured with, made from a shape's supports alone.
#pragma once

#include <array>
#include <string_view>

#include "core/derived/shape_bounds.h"
#include "core/math/ray.h"
#include "core/shape/shape.h"
#include "tests/support/random.h"

namespace minkray::testing {

enum class RayFamily : unsigned char { random, grazing, degenerate, far, camera };

struct RayFamilyDescription {
  RayFamily family;
  std::string_view name;
  std::string_view doc;
};

inline constexpr std::array ray_families = {
    RayFamilyDescription{RayFamily::random, "random",
                         "from 5 R, at points of the ball of 0.6 R around the middle"},
    RayFamilyDescription{RayFamily::grazing, "grazing",
                         "past a support point at 1e-3 to 1e-6 R, inside or outside"},
    RayFamilyDescription{RayFamily::degenerate, "degenerate",
                         "at vertices and edges, in face planes, tangential, along the axes"},
    RayFamilyDescription{RayFamily::far, "far", "as random, from 1e5 R"},
    RayFamilyDescription{RayFamily::camera, "camera",
                         "from one point 4 R away, through all of a picture of the shape"},
};

constexpr std::string_view name_of(RayFamily family) {
  return ray_families[static_cast<std::size_t>(family)].name;
}

/// Rays at one shape, with infinite t_max. R is the radius of its bounding ball.
class FamilyRays {
 public:
  FamilyRays(const Shape& shape, RayFamily family, std::uint64_t seed)
      : shape_(shape), family_(family), random_(seed) {
    const Bounds<double> bounds = bounds_of(shape);
    ball_ = ball_around(bounds);
    half_extents_ = bounds.half_extents();
    if (!(ball_.radius > 0)) ball_.radius = 1;
  }

  const Ball<double>& ball() const { return ball_; }

  Ray<double> next() {
    switch (family_) {
      case RayFamily::grazing:
        return grazing();
      case RayFamily::degenerate:
        return degenerate();
      case RayFamily::far:
        return aimed(1e5);
      case RayFamily::camera:
        return through_picture();
      default:
        return aimed(5);
    }
  }

 private:
  Ray<double> aimed(double distance) {
    // Points of flat shapes are not hit by rays aimed off them.
    const Vec3<double> target =
        ball_.centre + 0.6 * ball_.radius * std::cbrt(random_.uniform()) * random_.direction();
    const Vec3<double> origin = ball_.centre + distance * ball_.radius * random_.direction();
    return {origin, (target - origin) / distance};
  }

  /// The picture is as wide as the bounding ball, viewed from obliquely above.
  Ray<double> through_picture() {
    const Vec3<double> towards = Vec3<double>(-2, 3, -1).normalized();
    const Vec3<double> right = towards.unitOrthogonal(), up = towards.cross(right);
    const Vec3<double> at = right * random_.uniform(-1, 1) + up * random_.uniform(-1, 1);
    const double R = ball_.radius;
    return {ball_.centre - 4 * R * towards, unit<double>(4 * towards + at)};
  }

  /// A ray along r, past the support point of a direction at right angles to it.
  Ray<double> grazing() {
    const Vec3<double> r = random_.direction();
    const Vec3<double> n = unit<double>(r.cross(random_.direction()));
    const double offset = std::pow(10.0, random_.uniform(-6, -3)) * (random_.below(2) ? 1 : -1);
    const Vec3<double> past = shape_.support(n) + offset * ball_.radius * n;
    return {past - 5 * ball_.radius * r, r * ball_.radius};
  }

  /// One of -1, 0, 1 in each coordinate, not all zero.
  Vec3<double> lattice_direction() {
    for (;;) {
      const Vec3<double> n(random_.below(3) - 1, random_.below(3) - 1, random_.below(3) - 1);
      if (n.squaredNorm() > 0) return n;
    }
  }

  Ray<double> degenerate() {
    const double R = ball_.radius;
    const Vec3<double> vertex = shape_.support(lattice_direction()),
                       other = shape_.support(random_.direction());
    switch (random_.below(5)) {
      case 0: {  // at a vertex
        const Vec3<double> origin = ball_.centre + 5 * R * random_.direction();
        return {origin, (vertex - origin) / 5};
      }
      case 1: {  // at the middle of an edge, or of a chord
        const Vec3<double> origin = ball_.centre + 5 * R * random_.direction();
        return {origin, ((vertex + other) / 2 - origin) / 5};
      }
      case 2: {  // through two support points: along an edge, in a face's plane
        const Vec3<double> along = unit<double>(shape_.support(lattice_direction()) - vertex);
        const Vec3<double> r = along.squaredNorm() > 0 ? along : Vec3<double>::UnitX();
        return {vertex - 5 * R * r, r * R};
      }
      case 3: {  // tangential
        const Vec3<double> n = unit<double>(lattice_direction());
        const Vec3<double> r = unit<double>(n.cross(lattice_direction()));
        const Vec3<double> along = r.squaredNorm() > 0 ? r : unit<double>(n.unitOrthogonal());
        return {shape_.support(n) - 5 * R * along, along * R};
      }
      default: {  // along an axis, at a corner, edge or face of the bounding box, or its middle
        Vec3<double> r = Vec3<double>::Zero();
        r[random_.below(3)] = random_.below(2) ? 1 : -1;
        const Vec3<double> at = ball_.centre + lattice_direction().cwiseProduct(half_extents_) *
                                                   (random_.below(2) ? 1 : 0.5);
        return {at - 5 * R * r, r * R};
      }
    }
  }

  const Shape& shape_;
  RayFamily family_;
  Random random_;
  Ball<double> ball_;
  Vec3<double> half_extents_;
};

}  // namespace minkray::testing
