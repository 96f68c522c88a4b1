// SPDX-License-Identifier: MIT
#include <cstring>
#include <sstream>

#include "core/cast/cast.h"
#include "core/cast/packet_cast.h"
#include "core/proof/check_certificate.h"
#include "core/query/near_segment.h"
#include "renderer/member_json/shape_json.h"
#include "renderer/query/query_json.h"
#include "tests/fuzz/cast_promises.h"
#include "tests/fuzz/shape_from_bytes.h"
#include "tests/fuzz/target.h"
#include "tests/support/solvers.h"

namespace minkray::fuzz {
namespace {

template <class A>
bool same_bits(const A& a, const A& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Compares a lane of the packet with the result of cast_ray: empty if they are the same, bit for
/// bit.
std::string compare(const CastResult<double>& one, const CastResult<double>& lane) {
  if (one.status != lane.status)
    return "status " + std::string(name_of(lane.status)) + " instead of " +
           std::string(name_of(one.status));
  if (one.status == Status::exhausted) return "";
  const bool same_t =
      one.status == Status::miss ||
      (same_bits(one.t_base, lane.t_base) && same_bits(one.t_offset, lane.t_offset) &&
       same_bits(one.offset_lo, lane.offset_lo) && same_bits(one.offset_hi, lane.offset_hi));
  bool same_normal = true;
  for (int i = 0; i < 3; ++i) same_normal &= same_bits(one.normal[i], lane.normal[i]);
  if (!same_t) return "another t";
  std::ostringstream normals;
  normals.precision(std::numeric_limits<double>::max_digits10);
  normals << "another normal (" << name_of(one.status) << "): " << lane.normal.transpose()
          << " instead of " << one.normal.transpose();
  if (!same_normal) return normals.str();
  if (one.supports == lane.supports) return "";
  return std::to_string(lane.supports) + " support points instead of " +
         std::to_string(one.supports);
}

/// The line to give to `minkray cast`.
std::string as_query(const Shape& shape, const Ray<double>& ray) {
  const auto list = [](const Vec3<double>& v) {
    return Json::array({double(v.x()), double(v.y()), double(v.z())});
  };
  Json json = {{"query", "ray"},
               {"shape", write_shape(shape)},
               {"ray", {{"origin", list(ray.origin)}, {"direction", list(ray.direction)}}}};
  if (std::isfinite(ray.t_max)) json["ray"]["t_max"] = double(ray.t_max);
  return json.dump();
}

std::string check_packets(const PreparedShape& prepared, const RayPacket& rays, LaneBits lanes) {
  for (const InstructionSet set : {InstructionSet::sse2, InstructionSet::avx2}) {
    if (set > best_instruction_set()) continue;
    CastPacket answers{};
    cast_packet(prepared, rays, lanes, answers, set);
    for (int lane = 0; lane < packet_lanes; ++lane) {
      if (!(lanes & (LaneBits(1) << lane))) continue;
      const std::string bad = compare(cast_ray(prepared, rays.ray(lane)), answers.result(lane));
      if (!bad.empty())
        return "lane " + std::to_string(lane) +
               (set == InstructionSet::sse2 ? ", SSE2" : ", AVX2") + ": " + bad;
    }
  }
  return "";
}

/// Checks that the result's certificate holds, if it is allowed `rounding`, and that one of a hit
/// that is claimed too early does not.
std::string check_proof(const Shape& shape, const Ray<double>& ray,
                        const CastResult<double>& result, double rounding) {
  if (result.status == Status::exhausted) return "";
  const Ray<double> same_ray{ray.origin.cast<double>(), ray.direction.cast<double>(),
                             double(ray.t_max)};
  const SupportFunction support = supports_of(shape);
  if (near_segment(support, same_ray).is_too_far) return "";
  const Bounds<double> bounds = bounds_of(shape);
  const double size = bounds.centre().norm() + bounds.half_extents().norm();
  Claim claim = claim_of(result);
  if (size > 0) claim.epsilon = std::max(claim.epsilon, rounding / (certificate_rounding * size));
  const Certificate certificate = certify(support, same_ray, claim);
  const CertificateVerdict verdict = check_certificate(support, same_ray, claim, certificate);
  if (!verdict.holds) return "the certificate: " + std::string(verdict.complaint);
  const double slope = -claim.normal.dot(same_ray.direction);
  if (result.status != Status::hit || !(slope > 0)) return "";
  claim.t_offset -= 4 * verdict.allowed / slope;
  const bool is_early = claim.t_offset + 3 * verdict.allowed / slope < double(result.t_offset);
  if (is_early && check_certificate(support, same_ray, claim, certificate).holds)
    return "a certificate holds of a hit that is too early";
  return "";
}

std::string check_ray(const Shape& shape, const PreparedShape& prepared, const Ray<double>& ray) {
  CastReferee referee(shape, ray);
  const auto complaint = [&](std::string_view who, const std::string& bad) {
    return "solver " + std::string(who) + ": " + bad + "\n" + as_query(shape, ray);
  };
  for (const auto& solver : testing::accurate_solvers()) {
    const CastOptions options{solver.kind};
    const CastResult<double> result = cast_ray(prepared, ray, options);
    if (const std::string bad = referee.check(solver.name, result); !bad.empty())
      return complaint(solver.name, bad);
    // At extreme proportions casts prove their own results, in the shape's own frame.
    const bool is_ordinary = referee.in_range() && !prepared.definition().is_extreme();
    if (solver.kind == &solver::automatic && is_ordinary)
      if (const std::string bad = check_proof(shape, ray, result, referee.rounding()); !bad.empty())
        return complaint(solver.name, bad);
    if (const std::string bad =
            referee.check_exit(solver.name, result, cast_exit(prepared, ray, options));
        !bad.empty())
      return complaint(solver.name, "exit: " + bad);
  }
  if (const std::string bad = referee.check_claimed(); !bad.empty()) return complaint("any", bad);
  return "";
}

/// A map and a shape, as one shape and as a pose around it: the same answers are promised.
std::string check(Bytes bytes, bool wild) {
  const Affine<double> pose = map_from(bytes, wild);
  const bool posed = bytes.below(2) == 1;
  const Shape inner = shape_from(bytes, wild);
  const Shape shape = posed ? Shape(Transform{inner, AffineMap(pose)}) : inner;
  // Sums of the largest may leave the range of numbers: shapes there are none.
  const Bounds<double> bounds = bounds_of(shape);
  if (!bounds.lower.allFinite() || !bounds.upper.allFinite()) return "";
  const PreparedShape prepared = posed ? PreparedShape(inner, pose) : PreparedShape(shape);
  RayPacket rays{};
  const int count = 1 + bytes.below(packet_lanes);
  LaneBits lanes = 0;
  for (int lane = 0; lane < count; ++lane) {
    const Ray<double> ray = ray_from(bytes, shape, wild);
    if (!ray.origin.allFinite() || !ray.direction.allFinite()) continue;
    rays.set(lane, ray);
    lanes |= LaneBits(1) << lane;
    if (const std::string bad = check_ray(shape, prepared, ray); !bad.empty()) return bad;
  }
  const std::string bad = check_packets(prepared, rays, lanes);
  if (bad.empty()) return "";
  std::string text = bad;
  for (int lane = 0; lane < count; ++lane) text += "\n" + as_query(shape, rays.ray(lane));
  return text;
}

}  // namespace

std::string check_cast_query(std::string_view line) {
  Mistakes mistakes("casts");
  MeshFiles meshes("no-such-folder");
  const std::optional<Query> query = parse_query(line, meshes, mistakes);
  if (!query) return mistakes.text();
  const auto* cast = std::get_if<RayQuery>(&query->kind);
  if (!cast || cast->has_mesh()) return "not a ray cast at a shape";
  const Shape& shape = cast->body.shape;
  return check_ray(shape, PreparedShape(shape), cast->ray);
}

std::string check_cast(std::string_view input) {
  Bytes bytes(input);
  const unsigned kind = bytes.byte();
  const bool wild = (kind & 2) != 0;
  return check(bytes, wild);
}

}  // namespace minkray::fuzz
