// SPDX-License-Identifier: MIT
#include "renderer/library/handles/prover.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/derived/shape_bounds.h"
#include "core/parallel/parallel.h"
#include "core/parts/compound.h"
#include "renderer/audit/half_space_verdict.h"
#include "renderer/audit/mesh_verdict.h"
#include "renderer/clearance/bodies.h"
#include "renderer/library/handles/call.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Instances that one thread takes at once.
constexpr std::size_t grain = 256;

/// True if the ray misses the box up to t_end, including rounding.
bool misses_box(const Bounds<double>& box, const Ray<double>& ray, double t_end) {
  double enter = 0, leave = t_end;
  for (int k = 0; k < 3; ++k) {
    const double o = ray.origin[k], d = ray.direction[k];
    // The box, the origin and the products are rounded to so much.
    const double wide = certificate_rounding * epsilon *
                        (std::abs(o) + std::max(std::abs(box.lower[k]), std::abs(box.upper[k])));
    const double low = box.lower[k] - wide - o, high = box.upper[k] + wide - o;
    if (d == 0) {
      if (low > 0 || high < 0) return true;
      continue;
    }
    double first = low / d, last = high / d;
    if (first > last) std::swap(first, last);
    enter = std::max(enter, first - 4 * epsilon * std::abs(first));
    leave = std::min(leave, last + 4 * epsilon * std::abs(last));
  }
  return enter > leave;
}

/// Support points that a proof rests on, of a shape that a program gives: no two of them may
/// contradict each other.
class Witnesses {
 public:
  explicit Witnesses(const Shape& shape) : shape_(shape) {}

  SupportFunction recording() {
    return [this](const Vec3<double>& n) {
      const Vec3<double> point = shape_.support(n);
      if (!n.isZero(0)) asked_.emplace_back(unit(n), point);
      return point;
    };
  }

  /// Largest distance of a point beyond another's plane.
  double contradiction() const {
    double most = 0;
    for (const auto& [n, along_n] : asked_)
      for (const auto& [m, point] : asked_) most = std::max(most, n.dot(point - along_n));
    return most;
  }

 private:
  const Shape& shape_;
  std::vector<std::pair<Vec3<double>, Vec3<double>>> asked_;
};

void complain(minkray_proof& proof, std::string_view complaint, std::uint32_t against) {
  proof.holds = 0;
  proof.against = against;
  const std::size_t count = std::min(complaint.size(), sizeof proof.complaint - 1);
  std::memcpy(proof.complaint, complaint.data(), count);
}

}  // namespace

Prover::Prover(const HeldScene& scene) : world_(scene.world()) {
  const bool has_customs = !scene.customs().empty();
  const Scene whole = scene.whole();
  for (const std::uint32_t object : objects_of_bodies(whole)) {
    if (object == first_.size()) first_.push_back(bodies_.size());
    bodies_.emplace_back().object = object;
  }
  first_.push_back(bodies_.size());
  parallel_for(bodies_.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Body& body = bodies_[i];
      Object object = instance_object(whole, body.object);
      body.is_removed = scene.is_removed(body.object);
      if (object.compound) {
        const auto& [shape, pose] = object.compound->part(i - first_[body.object]);
        object.shape = shape;
        object.pose = object.pose * pose;
      }
      if (object.half_space) {
        body.half_space = object.half_space->posed(object.pose);
        continue;
      }
      if (object.mesh) {
        body.mesh = PosedMesh(0, object.mesh, object.pose);
        body.bounds = body.mesh->bounds();
        continue;
      }
      if (has_customs) body.customs = customs_of(object.shape);
      body.shape = object.pose == Affine<double>{} ? object.shape
                                                   : Shape(Transform{object.shape, object.pose});
      body.bounds = bounds_of(*body.shape);
    }
  });
}

CertificateVerdict Prover::verdict(const Body& body, const Ray<double>& ray, const Claim& claim,
                                   Certificate* found) const {
  if (body.mesh) return verdict_of(*body.mesh, ray, claim, false, found);
  if (!body.shape) return verdict_of(body.half_space, ray, claim);
  Witnesses witnesses(*body.shape);
  const SupportFunction support =
      body.customs.empty() ? supports_of(*body.shape) : witnesses.recording();
  const Certificate certificate = certify(support, ray, claim);
  CertificateVerdict verdict = check_certificate(support, ray, claim, certificate);
  if (found) *found = certificate;
  if (!body.customs.empty() && witnesses.contradiction() > verdict.allowed) {
    verdict.holds = false;
    verdict.complaint = "support points contradict each other";
  }
  return verdict;
}

const Prover::Body* Prover::body_of(const minkray_hit& hit) const {
  if (hit.object + std::size_t{1} >= first_.size()) return nullptr;
  const std::size_t first = first_[hit.object], count = first_[hit.object + 1] - first;
  const bool is_compound = world_.instances().is_compound(hit.object);
  const std::size_t part = is_compound ? static_cast<std::uint32_t>(hit.part) : 0;
  return part < count && !bodies_[first].is_removed ? &bodies_[first + part] : nullptr;
}

bool Prover::keeps_off(const Body& body, const Ray<double>& ray, double t_lo) const {
  Ray<double> before = ray;
  before.t_max = t_lo;
  PartCounts parts;
  const CastResult<double> cast = body.mesh
                                      ? cast_ray(*body.mesh, before, t_lo, false, 0, parts).cast
                                  : !body.shape ? cast_ray(body.half_space, before)
                                  : world_.instances().has_shape(body.object)
                                      ? cast_ray(world_.instances().at(body.object), before)
                                      : cast_ray(PreparedShape(*body.shape), before);
  const CertificateVerdict found = verdict(body, before, claim_of(cast), nullptr);
  if (!found.holds) return false;
  if (cast.status == Status::miss) return true;
  // Met, but not before: two objects may be met at the same place.
  const double rounding = certificate_rounding * epsilon * std::abs(t_lo);
  return cast.status == Status::hit && found.t_base + found.offset_planes >= t_lo - rounding;
}

minkray_proof Prover::prove(const Ray<double>& ray, const minkray_hit& hit) const {
  minkray_proof proof = {};
  proof.against = MINKRAY_NO_OBJECT;
  proof.t_lo = proof.t_hi = hit.t;
  proof.holds = 1;
  if (hit.status == MINKRAY_EXHAUSTED) {
    complain(proof, "the solver gave up", MINKRAY_NO_OBJECT);
    return proof;
  }
  const Body* body = nullptr;
  const bool is_met = hit.status == MINKRAY_HIT || hit.status == MINKRAY_INSIDE;
  if (is_met) {
    body = body_of(hit);
    if (!body) {
      complain(proof, "no such object", hit.object);
      return proof;
    }
    Claim claim;
    claim.status = hit.status == MINKRAY_HIT ? Status::hit : Status::inside;
    claim.t_base = hit.t_base;
    claim.t_offset = hit.t_offset;
    claim.normal = {hit.normal[0], hit.normal[1], hit.normal[2]};
    Certificate certificate;
    const CertificateVerdict found = verdict(*body, ray, claim, &certificate);
    proof.checked = 1;
    proof.allowed = found.allowed;
    if (hit.status == MINKRAY_HIT) {
      proof.t_lo = found.t_lo();
      proof.t_hi = found.t_hi();
    }
    const Vec3<double>& plane = certificate.plane.isZero(0) ? claim.normal : certificate.plane;
    for (int k = 0; k < 3; ++k) proof.plane[k] = unit(plane)[k];
    if (!found.holds) {
      complain(proof, found.complaint, hit.object);
      return proof;
    }
  }
  // Nothing is before what the ray begins in.
  if (hit.status == MINKRAY_INSIDE) return proof;
  const double end = is_met ? proof.t_lo : ray.t_max;
  for (const Body& other : bodies_) {
    if (other.is_removed || &other == body) continue;
    if (other.shape && misses_box(other.bounds, ray, end)) continue;
    ++proof.checked;
    if (!keeps_off(other, ray, end)) {
      complain(proof,
               is_met ? "another object before it is not separated" : "an object is not separated",
               other.object);
      return proof;
    }
  }
  return proof;
}

}  // namespace minkray
