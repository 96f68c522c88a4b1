// SPDX-License-Identifier: MIT
// Checker of certificates: decides in double whether a certificate proves a claim, using only
// support points. Shares no code with the solvers; docs/certificates.md derives the tests.
#pragma once

#include <string_view>

#include "core/math/outward_sum.h"
#include "core/proof/certificate.h"

namespace minkray {

/// Error allowed in each condition, in units of the claim's epsilon times NearSegment::size.
/// Support points, the ray near the shape, planes, and sums of points each have a rounding of a few
/// units. See docs/certificates.md for measurements.
inline constexpr double certificate_rounding = 64;

/// Result of the checker. Lengths are in units of the scene.
struct CertificateVerdict {
  bool holds = false;
  std::string_view complaint;  ///< the first condition that fails; empty if all hold

  /// Hit: t lies in t_base + [offset_lo, offset_hi]. The interval includes the rounding of planes
  /// and of the spanned point (the convex combination of the certificate's support points).
  /// Rounding moves a plane along its normal; along the ray the plane moves further.
  double t_base = 0, offset_lo = 0, offset_hi = 0;
  double offset_planes = 0;  ///< hit: offset of t where the ray crosses the last plane
  /// Hit: offset of t at the spanned point. Rounding can make it less than offset_planes.
  double offset_spanned = 0;
  double gap = 0;      ///< hit: depth of the spanned point below the plane, (t_hi - t_lo) * cosine
  double lateral = 0;  ///< distance of the spanned point from the ray (hit) or origin (inside)
  double margin = 0;   ///< miss: distance from the plane to the ray; negative if they cross
  /// Hit: distance of the claimed point from the plane with the claimed normal, or its height above
  /// the certificate's plane if that is larger.
  double claim_error = 0;
  double late = 0;     ///< hit: distance along the ray of the claimed t beyond the proven t_hi
  double allowed = 0;  ///< limit of gap, lateral, -margin and claim_error

  double t_lo() const { return sum_or_less(t_base, offset_lo); }
  double t_hi() const { return sum_or_more(t_base, offset_hi); }
};

/// Checks a certificate. Never holds for Status::exhausted, which claims nothing.
CertificateVerdict check_certificate(const SupportFunction& support, const Ray<double>& ray,
                                     const Claim& claim, const Certificate& certificate);

}  // namespace minkray
