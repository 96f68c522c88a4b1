// SPDX-License-Identifier: MIT
// Guarantees of a cast, checked with support points only, computed in long double from the same
// shape. Each check allows for the rounding of its own numbers only.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/math/ray.h"
#include "core/query/result.h"
#include "tests/fuzz/extent.h"
#include "tests/oracle/quad.h"

namespace minkray::fuzz {

using Real = long double;
using testing::Quad;
using testing::quad;
using testing::QuadVec;

/// One shape and one ray; the results of all solvers are checked against the same facts:
/// - a miss is proven by its plane: the ray, where it could hit, is on the plane's other side;
/// - a hit lies on a supporting plane that faces the ray: the ray does not enter the shape before;
/// - a hit, and an origin that is inside, lie in the shape: no separating plane is found;
/// - nothing is NaN, the normal has unit length, t is in [0, t_max], the bounds are in order.
class CastReferee {
 public:
  /// The shape as it lies in the ray's frame.
  CastReferee(const Shape& shape, const Ray<double>& ray);

  /// True if the numbers of the result are in T's range at all: t is distance over speed.
  bool in_range() const { return in_range_; }
  /// Tolerance of a plane or a point: a length.
  double rounding() const { return static_cast<double>(rounding_); }

  /// Description of an error in the result; empty if there is none. Stores its plane.
  std::string check(std::string_view solver, const CastResult<double>& result);
  std::string check_exit(std::string_view solver, const CastResult<double>& entry,
                         const CastResult<double>& exit);

  /// Checks that no plane separates a point that is claimed to be in the shape: those that were
  /// stored, and those that a search of our own finds.
  std::string check_claimed();

 private:
  struct Claim {
    Vec3<Real> x;  ///< claimed to be in the shape; from the centre
    std::string by;
  };

  /// Height of o + t d above the shape's furthest point along n, relative to the centre.
  Real height(const Vec3<Real>& n) const { return n.dot(shape_.support(n) - centre_); }
  Vec3<Real> at(Real t_base, Real t_offset) const;
  std::string check_miss(const Vec3<Real>& n) const;
  std::string kept_off(const Claim& claim, const Vec3<Real>& n) const;

  Shape shape_;
  Vec3<Real> centre_;
  Vec3<Real> direction_;
  QuadVec from_centre_;  ///< the ray's origin; its digits cancel
  Real speed_, t_max_, t_closest_;
  Vec3<Real> closest_;  ///< the line's point at t_closest_, from the centre
  Real radius_;         ///< of a ball around the centre that holds the shape
  Real epsilon_, rounding_, end_rounding_;
  bool in_range_;
  std::vector<Vec3<Real>> planes_;
  std::vector<Claim> claimed_;
};

}  // namespace minkray::fuzz
