// SPDX-License-Identifier: MIT
// Certificates: short proofs of the results of ray casts, checked with only the support mapping
// (core/proof/check_certificate.h, docs/certificates.md). For a hit, a supporting plane separates
// the shape from the ray before t_lo, and at most four support points span a point of the shape on
// the ray at t_hi. If the ray begins inside, the support points span the ray's origin. For a miss,
// a plane lies between the shape and the ray.
#pragma once

#include <array>
#include <functional>

#include "core/math/ray.h"
#include "core/query/result.h"
#include "core/shape/shape.h"

namespace minkray {

/// The support mapping returns the point furthest along a direction of any length. This is the only
/// access to the shape.
using SupportFunction = std::function<Vec3<double>(const Vec3<double>&)>;

/// Wraps a shape, which must outlive the function.
inline SupportFunction supports_of(const Shape& shape) {
  return [&shape](const Vec3<double>& n) { return shape.support(n); };
}

/// A solver's result for a ray, in the ray's frame.
struct Claim {
  Status status = Status::exhausted;
  double t_base = 0, t_offset = 0;  ///< for hits: t is their sum
  Vec3<double> normal = Vec3<double>::Zero();
  double epsilon = std::numeric_limits<double>::epsilon();  ///< of the solver's number type
};

template <class T>
Claim claim_of(const CastResult<T>& result) {
  return {result.status, double(result.t_base), double(result.t_offset),
          result.normal.template cast<double>(), double(std::numeric_limits<T>::epsilon())};
}

/// The support point along a direction, and its weight in the spanned point.
struct WeightedSupport {
  Vec3<double> direction = Vec3<double>::Zero();
  double weight = 0;
};

/// The proof. Stores only directions; the support mapping returns their points.
struct Certificate {
  /// Hit: the normal of the plane that gives t_lo. Miss: the normal of a plane between shape and
  /// ray. Zero if no plane is needed, or if none was found.
  Vec3<double> plane = Vec3<double>::Zero();
  /// Hit: these points span a point on the ray. Inside: these points span the ray's origin.
  std::array<WeightedSupport, 4> spanning;
  int supports = 0;  ///< support calls of the search
};

/// Returns the best proof of the claim that the search finds; the checker decides whether the proof
/// holds. The search begins with the claim's normal. There is no proof for Status::exhausted.
Certificate certify(const SupportFunction& support, const Ray<double>& ray, const Claim& claim);

}  // namespace minkray
