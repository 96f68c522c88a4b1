// SPDX-License-Identifier: MIT
#include "renderer/audit/mesh_verdict.h"

#include <algorithm>

#include "core/derived/triangle_of.h"
#include "core/math/two_fold.h"
#include "core/mesh/exact_sign.h"
#include "core/proof/certificate.h"
#include "core/shape/shape.h"

namespace minkray {
namespace {

/// The triangle in the world: its corners round once.
Shape part_in_world(const PosedMesh& posed, std::uint32_t part) {
  std::array<Vec3<double>, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = posed.pose(posed.mesh->corner(part, k));
  return triangle_of(corners[0], corners[1], corners[2]);
}

Ray<double> seen_by(const PosedMesh& posed, const Ray<double>& ray) {
  const TwoFoldVec3<double> from = exact_difference(ray.origin, posed.pose.translation);
  return {posed.to_mesh * from.high + posed.to_mesh * from.low, posed.to_mesh * ray.direction,
          ray.t_max};
}

/// Least t of a ray's hits at the mesh that it leaves.
double least_t_leaving(const PosedMesh& posed, const Ray<double>& ray) {
  const Ray<double> seen = seen_by(posed, ray);
  const double reach =
      posed.mesh->bounds().reach_of_centre().maxCoeff() + seen.origin.cwiseAbs().maxCoeff();
  return leaving_mesh * reach / seen.direction.cwiseAbs().maxCoeff();
}

/// True if the ray's line passes outside of one edge of the triangle and inside of another, by
/// exact arithmetic in the mesh's frame. No plane proves this where the line grazes an edge.
bool passes_beside(const PosedMesh& posed, std::uint32_t part, const Ray<double>& ray) {
  const Ray<double> seen = seen_by(posed, ray);
  int least = 1, most = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = exact_side_of_edge(seen.origin, seen.direction, posed.mesh->corner(part, k),
                                        posed.mesh->corner(part, (k + 1) % 3));
    least = std::min(least, side);
    most = std::max(most, side);
  }
  return least < 0 && most > 0;
}

/// True if the ray comes from behind a one-sided mesh.
bool comes_from_behind(const PosedMesh& posed, const Ray<double>& ray) {
  return posed.mesh->sides() == MeshSides::front &&
         seen_by(posed, ray).direction.dot(posed.mesh->normal(0)) > 0;
}

/// Triangles whose boxes the ray comes near to, in the mesh's frame.
std::vector<std::uint32_t> parts_near(const PosedMesh& posed, const Ray<double>& ray) {
  const Ray<double> seen = seen_by(posed, ray);
  std::vector<std::uint32_t> parts;
  PartCounts counts;
  walk_triangles(*posed.mesh, seen, counts, [&](std::uint32_t part, SlabRay&) {
    parts.push_back(part);
    return false;
  });
  std::ranges::sort(parts);
  return parts;
}

CertificateVerdict verdict_of_part(const PosedMesh& posed, std::uint32_t part,
                                   const Ray<double>& ray, const Claim& claim, Certificate* found) {
  const Shape triangle = part_in_world(posed, part);
  const SupportFunction support = supports_of(triangle);
  const Certificate certificate = certify(support, ray, claim);
  if (found) *found = certificate;
  return check_certificate(support, ray, claim, certificate);
}

/// True if the triangle is hit, and not before t_max. Near a shared edge the segment's end is too
/// close to both triangles for a separating plane.
bool is_met_no_sooner(const PosedMesh& posed, std::uint32_t part, const Ray<double>& ray,
                      double t_max) {
  const TriangleMesh& mesh = *posed.mesh;
  Ray<double> whole = ray;
  whole.t_max = std::numeric_limits<double>::infinity();
  const PartHit hit = cast_at_triangle(mesh.corner(part, 0), mesh.corner(part, 1),
                                       mesh.corner(part, 2), seen_by(posed, whole));
  if (!hit.found()) return false;
  Claim claim;
  claim.status = Status::hit;
  claim.t_offset = hit.t;
  claim.normal = posed.to_mesh.transpose() * mesh.normal(part) * (hit.is_back ? -1.0 : 1.0);
  claim.normal.normalize();
  const CertificateVerdict found = verdict_of_part(posed, part, whole, claim, nullptr);
  const double rounding = found.allowed / ray.direction.norm();
  return found.holds && found.t_base + found.offset_planes >= t_max - rounding;
}

/// Proves that all triangles but one are missed from t_min to t_max; else returns the verdict of
/// one that is not.
CertificateVerdict all_missed(const PosedMesh& posed, Ray<double> ray, double t_min, double t_max,
                              std::uint32_t but) {
  if (t_min > 0) ray.origin += t_min * ray.direction;
  t_max = std::max(0.0, t_max - t_min);
  ray.t_max = t_max;
  Claim miss;
  miss.status = Status::miss;
  CertificateVerdict verdict;
  verdict.holds = true;
  for (const std::uint32_t part : parts_near(posed, ray)) {
    if (part == but) continue;
    const CertificateVerdict of_part = verdict_of_part(posed, part, ray, miss, nullptr);
    verdict.allowed = std::max(verdict.allowed, of_part.allowed);
    if (!of_part.holds && !passes_beside(posed, part, ray) &&
        !is_met_no_sooner(posed, part, ray, t_max))
      return of_part;
  }
  return verdict;
}

}  // namespace

CertificateVerdict verdict_of(const PosedMesh& posed, const Ray<double>& ray, const Claim& claim,
                              bool leaves, Certificate* found) {
  const bool is_behind = comes_from_behind(posed, ray);
  const double t_min = leaves ? least_t_leaving(posed, ray) : 0;
  if (claim.status == Status::miss && !is_behind)
    return all_missed(posed, ray, t_min, ray.t_max, no_part);
  CertificateVerdict verdict;
  verdict.holds = claim.status == Status::miss;
  if (verdict.holds) return verdict;
  if (is_behind) {
    verdict.complaint = "is met from the front only";
    return verdict;
  }
  verdict.complaint = "no triangle proves it";
  if (claim.status != Status::hit) return verdict;
  for (const std::uint32_t part : parts_near(posed, ray)) {
    Certificate certificate;
    const CertificateVerdict hit = verdict_of_part(posed, part, ray, claim, &certificate);
    if (!hit.holds) {
      if (!verdict.holds) verdict.allowed = std::max(verdict.allowed, hit.allowed);
      continue;
    }
    // Triangles with a common edge are met at one place to rounding.
    const double rounding = hit.allowed / ray.direction.norm();
    const double before = std::max(0.0, hit.t_lo() - rounding);
    const CertificateVerdict others = all_missed(posed, ray, t_min, before, part);
    if (!others.holds) {
      verdict = others;
      verdict.complaint = "a triangle is met before";
      return verdict;
    }
    if (found) *found = certificate;
    return hit;
  }
  return verdict;
}

}  // namespace minkray
