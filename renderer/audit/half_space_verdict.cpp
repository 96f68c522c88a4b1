// SPDX-License-Identifier: MIT
#include "renderer/audit/half_space_verdict.h"

#include <cmath>

namespace minkray {

CertificateVerdict verdict_of(const HalfSpaceBody<double>& half_space, const Ray<double>& ray,
                              const Claim& claim) {
  using Number = long double;
  const Vec3<Number> n = half_space.normal.cast<Number>();
  const Vec3<Number> origin = ray.origin.cast<Number>(), along = ray.direction.cast<Number>();
  const Number height = n.dot(origin) - Number(half_space.offset), rise = n.dot(along);
  const Number t = Number(claim.t_base) + Number(claim.t_offset);
  const auto size_at = [&](Number at) {
    return n.cwiseAbs().dot(origin.cwiseAbs() + at * along.cwiseAbs()) +
           std::abs(Number(half_space.offset));
  };
  CertificateVerdict verdict;
  const auto complain = [&](std::string_view complaint) {
    verdict.complaint = complaint;
    return verdict;
  };
  const Number unit_of_rounding = certificate_rounding * Number(claim.epsilon);
  if (claim.status == Status::exhausted) return complain("nothing is claimed");
  const Number end = claim.status == Status::hit ? t : 0;
  verdict.allowed = static_cast<double>(unit_of_rounding * size_at(end));
  if (claim.status == Status::hit) {
    // Uncertainty of the plane's crossing along the ray, from the error allowed across the plane.
    const Number crossing = height / -rise - t, along_ray = Number(verdict.allowed) / -rise;
    verdict.t_base = static_cast<double>(t);
    verdict.offset_planes = verdict.offset_spanned = static_cast<double>(crossing);
    verdict.offset_lo = static_cast<double>(crossing - along_ray);
    verdict.offset_hi = static_cast<double>(crossing + along_ray);
    verdict.claim_error = static_cast<double>(std::abs(height + t * rise));
    if (!std::isfinite(t) || !(verdict.claim_error <= verdict.allowed))
      return complain("the hit point is off the plane");
    if (!(height >= -verdict.allowed) || !(rise < 0)) return complain("the plane is not entered");
    if (!(t * -rise <= Number(ray.t_max) * -rise + Number(verdict.allowed)))
      return complain("the hit lies beyond t_max");
    if (!(claim.normal == half_space.normal)) return complain("the normal is not the plane's");
  } else if (claim.status == Status::inside) {
    if (!(height <= verdict.allowed)) return complain("the ray begins above the plane");
  } else {
    const bool ends = std::isfinite(ray.t_max);
    const Number last = ends ? height + Number(ray.t_max) * rise : rise;
    const Number allowed =
        unit_of_rounding * (ends ? size_at(Number(ray.t_max)) : n.cwiseAbs().dot(along.cwiseAbs()));
    verdict.margin = static_cast<double>(std::min(height, last));
    if (!(height >= -verdict.allowed) || !(last >= -allowed))
      return complain("the ray comes below the plane");
  }
  verdict.holds = true;
  return verdict;
}

}  // namespace minkray
