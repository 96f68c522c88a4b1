// SPDX-License-Identifier: MIT
// The checker of certificates: decides whether a certificate proves a claim, in double, from
// support points alone. Shares no code with the solvers; docs/certificates.md derives what it
// tests.
#pragma once

#include <string_view>

#include "core/math/outward_sum.h"
#include "core/proof/certificate.h"

namespace minkray {

/// Error allowed in each condition, in units of the claim's machine epsilon times the `size` of
/// NearSegment: support points, the ray near the shape, planes and sums of points are each rounded
/// to a few of these units. See docs/certificates.md for measurements.
inline constexpr double certificate_rounding = 64;

/// Lengths are the scene's.
struct CertificateVerdict {
  bool holds = false;
  std::string_view complaint;  ///< the first condition that fails; empty if it holds

  /// Hit: t lies in t_base + [lo, hi], with an allowance for rounding: planes and the spanned point
  /// are rounded across the plane, which is longer along the ray.
  double t_base = 0, offset_lo = 0, offset_hi = 0;
  double offset_planes = 0;   ///< hit: where the ray crosses the last of the planes
  double offset_spanned = 0;  ///< hit: where the point is; rounding may put planes beyond it
  double gap = 0;      ///< hit: how deep that point lies under the plane: (t_hi - t_lo) * cosine
  double lateral = 0;  ///< hit, inside: the distance of the spanned point from ray or origin
  double margin = 0;   ///< miss: from the plane to the ray; negative if the ray crosses it
  /// Hit: how far the claimed point lies off the claimed plane or above the proven one.
  double claim_error = 0;
  double late = 0;     ///< hit: how far beyond the proven t_hi the claimed t is, along the ray
  double allowed = 0;  ///< limit of gap, lateral, -margin and claim_error

  double t_lo() const { return sum_or_less(t_base, offset_lo); }
  double t_hi() const { return sum_or_more(t_base, offset_hi); }
};

/// Exhausted claims nothing, and so nothing holds of it.
CertificateVerdict check_certificate(const SupportFunction& support, const Ray<double>& ray,
                                     const Claim& claim, const Certificate& certificate);

}  // namespace minkray
