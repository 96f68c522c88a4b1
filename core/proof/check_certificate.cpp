// SPDX-License-Identifier: MIT
#include "core/proof/check_certificate.h"

#include "core/math/length.h"
#include "core/query/near_segment.h"

namespace minkray {
namespace {

/// True if the vector can be normalised by its squared length.
bool is_direction(const Vec3<double>& n) {
  return is_ordinary_square(n.squaredNorm());
}

/// Points are relative to the segment's centre.
class Checker {
 public:
  Checker(const SupportFunction& support, const Ray<double>& ray, const Claim& claim,
          const Certificate& certificate)
      : support_(support),
        ray_(ray),
        claim_(claim),
        certificate_(certificate),
        near_(near_segment(support, ray)) {
    verdict_.t_base = near_.t_base;
    verdict_.allowed = certificate_rounding * claim.epsilon * near_.size;
    rounding_ = certificate_rounding * std::numeric_limits<double>::epsilon() * near_.size;
  }

  CertificateVerdict run() {
    if (near_.is_too_far) complain("the origin is too far away");
    switch (claim_.status) {
      case Status::hit:
        check_hit();
        break;
      case Status::miss:
        check_miss();
        break;
      case Status::inside:
        check_inside();
        break;
      case Status::exhausted:
        complain("the solver gave up");
        break;
    }
    verdict_.holds = verdict_.complaint.empty();
    return verdict_;
  }

 private:
  void complain(std::string_view text) {
    if (verdict_.complaint.empty()) verdict_.complaint = text;
  }
  /// Fails for NaN, too.
  void expect_at_most(double value, std::string_view otherwise) {
    if (!(value <= verdict_.allowed)) complain(otherwise);
  }

  /// The support function in a unit direction, relative to the centre.
  double support_function(const Vec3<double>& n) const { return n.dot(support_(n) - near_.centre); }

  /// The point of the shape that the certificate's support points span.
  bool spanned_point(Vec3<double>& q) const {
    double sum = 0;
    q.setZero();
    for (const WeightedSupport& term : certificate_.spanning) {
      if (!(term.weight >= 0)) return false;
      if (term.weight == 0) continue;
      if (!is_direction(term.direction)) return false;
      q += term.weight * (support_(term.direction) - near_.centre);
      sum += term.weight;
    }
    q /= sum;
    return sum > 0 && std::isfinite(sum) && q.allFinite();
  }

  /// Rounding of the parameter at which the ray crosses a plane of this slope.
  double rounding_along(double slope) const { return rounding_ / std::abs(slope); }

  void check_hit() {
    const double lambda = near_.lambda_of(claim_.t_base, claim_.t_offset);
    const Vec3<double> hit_point = near_.at(lambda);
    double lower = std::max(near_.first, near_.lambda_of(0, 0)), earliest = lower;

    // The claimed plane must touch the shape and contain the claimed point, and face the ray.
    if (!is_direction(claim_.normal)) return complain("a hit without a normal");
    const Vec3<double> n = claim_.normal.normalized();
    const double above = n.dot(hit_point) - support_function(n), slope = n.dot(near_.r);
    verdict_.claim_error = std::abs(above);
    double least_slope = std::abs(slope);
    if (slope < 0) {
      lower = std::max(lower, lambda - above / slope);
      earliest = std::max(earliest, lambda - above / slope - rounding_along(slope));
    }
    if (!(slope <= certificate_rounding * claim_.epsilon)) complain("the normal looks backwards");
    if (!(near_.lambda_of(ray_.t_max, 0) - lambda >= -verdict_.allowed))
      complain("the hit lies beyond t_max");
    if (!(lambda - near_.lambda_of(0, 0) >= -verdict_.allowed))
      complain("the hit lies before the ray");
    // Planes along the ray do not determine a point on it, so the point must be near the shape.
    if (!(lambda >= near_.begin - verdict_.allowed && lambda <= near_.end + verdict_.allowed))
      complain("the hit lies before or behind the shape");
    expect_at_most(std::abs(above), "the hit point is not on the plane of its normal");

    // The plane of the certificate: no point of the shape is above it.
    double depth_above = -std::numeric_limits<double>::infinity();
    Vec3<double> q;
    const bool spans = spanned_point(q);
    if (is_direction(certificate_.plane)) {
      const Vec3<double> m = certificate_.plane.normalized();
      const double h = support_function(m);
      depth_above = m.dot(hit_point) - h;
      const double steep = m.dot(near_.r);
      if (steep < 0) {
        lower = std::max(lower, lambda - depth_above / steep);
        earliest = std::max(earliest, lambda - depth_above / steep - rounding_along(steep));
      }
      least_slope = std::min(least_slope, std::abs(steep));
      if (spans) verdict_.gap = h - m.dot(q);
    } else if (spans) {
      verdict_.gap = (n.dot(hit_point) - above) - n.dot(q);
    }
    verdict_.claim_error = std::max(verdict_.claim_error, depth_above);
    if (depth_above > verdict_.allowed) complain("the hit point lies outside the shape");

    // The spanned point must be on the ray, and not far below the plane.
    if (!spans) return complain("no support points");
    const double at_q = near_.r.dot(q - near_.s);
    verdict_.lateral = (q - near_.at(at_q)).norm();
    expect_at_most(verdict_.lateral, "the support points do not enclose the ray");
    expect_at_most(verdict_.gap, "the bounds are apart");
    if (!(at_q >= near_.lambda_of(0, 0) - verdict_.allowed) ||
        !(at_q <= near_.lambda_of(ray_.t_max, 0) + verdict_.allowed))
      complain("the support points span no point of the ray");
    verdict_.offset_spanned = near_.t_offset(at_q);
    // If the spanned point is not exactly on the ray, the ray may enter later: at most by this
    // distance / slope if the surface were the plane. Allows twice that, since the surface bends
    // away from its plane, but no more than to the shape's end.
    const double beside = 2 * (verdict_.lateral + rounding_) / least_slope;
    const double latest = std::max(lower, at_q);
    const double end = std::max(latest, near_.end) + rounding_;
    verdict_.offset_planes = near_.t_offset(std::min(lower, at_q));
    verdict_.offset_lo = near_.t_offset(std::min(earliest, at_q));
    verdict_.offset_hi = near_.t_offset(std::min(latest + beside, end));
    verdict_.late = lambda - std::max(lower, at_q);
  }

  void check_inside() {
    Vec3<double> q;
    if (!spanned_point(q)) return complain("no support points");
    verdict_.lateral = (q - (ray_.origin - near_.centre)).norm();
    expect_at_most(verdict_.lateral, "the support points do not enclose the origin");
    verdict_.offset_lo = verdict_.offset_hi = -near_.t_base;
  }

  void check_miss() {
    verdict_.margin = near_.begin - near_.end;
    if (verdict_.margin > 0) return;  // the ray is outside the planes perpendicular to it
    if (!is_direction(certificate_.plane)) return complain("a miss without a plane");
    const Vec3<double> n = certificate_.plane.normalized();
    verdict_.margin =
        std::min(n.dot(near_.at(near_.begin)), n.dot(near_.at(near_.end))) - support_function(n);
    expect_at_most(-verdict_.margin, "the plane does not separate");
  }

  const SupportFunction& support_;
  const Ray<double>& ray_;
  const Claim& claim_;
  const Certificate& certificate_;
  NearSegment near_;
  double rounding_;  ///< rounding of this checker across a plane, for any claim
  CertificateVerdict verdict_;
};

}  // namespace

CertificateVerdict check_certificate(const SupportFunction& support, const Ray<double>& ray,
                                     const Claim& claim, const Certificate& certificate) {
  return Checker(support, ray, claim, certificate).run();
}

}  // namespace minkray
