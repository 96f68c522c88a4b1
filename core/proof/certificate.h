// SPDX-License-Identifier: MIT
// Certificates: short proofs of the results of ray casts, checked with only the support mapping
// (core/proof/check_certificate.h, docs/certificates.md). Hit, with t between bounds t_lo and t_hi:
// a plane separates the shape from the part of the ray before t_lo; the ray's point at t_hi is a
// convex combination of up to four support points, and so is in the shape. Inside: the ray's origin
// is such a convex combination. Miss: a plane separates the shape from the ray.
#pragma once

#include <array>
#include <functional>

#include "core/math/ray.h"
#include "core/query/result.h"
#include "core/shape/shape.h"

namespace minkray {

/// The support mapping of a shape: takes a direction of any length and returns the shape's point
/// that is furthest along it. Proofs and checks access the shape only by this function.
using SupportFunction = std::function<Vec3<double>(const Vec3<double>&)>;

/// Returns the support mapping of a shape. The shape must outlive the returned function.
inline SupportFunction supports_of(const Shape& shape) {
  return [&shape](const Vec3<double>& n) { return shape.support(n); };
}

/// A solver's result for a ray, which is to be proven; in the ray's frame.
struct Claim {
  Status status = Status::exhausted;
  double t_base = 0, t_offset = 0;  ///< for hits: the ray parameter t is their sum
  Vec3<double> normal = Vec3<double>::Zero();
  /// Machine epsilon of the solver's number type.
  double epsilon = std::numeric_limits<double>::epsilon();
};

/// Makes a claim from the result of a ray cast.
template <class T>
Claim claim_of(const CastResult<T>& result) {
  return {result.status, double(result.t_base), double(result.t_offset),
          result.normal.template cast<double>(), double(std::numeric_limits<T>::epsilon())};
}

/// A direction, and the weight of its support point in a convex combination.
struct WeightedSupport {
  Vec3<double> direction = Vec3<double>::Zero();
  double weight = 0;
};

/// The proof. Stores only directions; the support mapping returns their points.
struct Certificate {
  /// Hit: normal of the plane that the ray crosses at t_lo. Miss: normal of the plane that
  /// separates shape and ray. Zero if no plane is needed, or if none was found.
  Vec3<double> plane = Vec3<double>::Zero();
  /// Support points and weights (unused ones are 0). Their convex combination is, for a hit, the
  /// ray's point at t_hi and, for a ray that begins inside, the ray's origin.
  std::array<WeightedSupport, 4> spanning;
  int supports = 0;  ///< number of support points that the search used
};

/// Searches for a proof of the claim and returns the best one found; the checker decides whether it
/// holds. The search begins with the claim's normal. For Status::exhausted there is no proof.
Certificate certify(const SupportFunction& support, const Ray<double>& ray, const Claim& claim);

}  // namespace minkray
