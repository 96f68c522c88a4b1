// SPDX-License-Identifier: MIT
#include "renderer/audit/ray_audit.h"

#include "core/derived/shape_bounds.h"
#include "renderer/audit/half_space_verdict.h"
#include "renderer/audit/mesh_verdict.h"
#include "renderer/json/json.h"
#include "renderer/json/number_json.h"
#include "renderer/member_json/shape_json.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

/// Enough to see a pattern.
constexpr std::size_t most_failures = 20;

/// Margin of boxes around their contents, relative to their largest coordinate: boxes only spare
/// proofs.
constexpr double box_padding = 1e-9;

/// True if the ray may pass through the box; also if in doubt.
bool may_pass(const Bounds<double>& box, const Ray<double>& ray) {
  double enter = 0, leave = ray.t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const double to_lower = box.lower[axis] - ray.origin[axis];
    const double to_upper = box.upper[axis] - ray.origin[axis];
    const double d = ray.direction[axis];
    if (d == 0) {
      if (to_lower > 0 || to_upper < 0) return false;
      continue;
    }
    enter = std::max(enter, std::min(to_lower / d, to_upper / d));
    leave = std::min(leave, std::max(to_lower / d, to_upper / d));
  }
  return !(enter > leave);
}

std::string query_line(const Object& object, const Shape& in_world, const Ray<double>& ray) {
  Json json;
  json["name"] = object.name;
  json["query"] = "ray";
  json["shape"] = write_shape(in_world);
  json["ray"] = {{"origin", point_json(ray.origin)}, {"direction", point_json(ray.direction)}};
  if (std::isfinite(ray.t_max)) json["ray"]["t_max"] = ray.t_max;
  return json.dump();
}

Bounds<double> with_margin(Bounds<double> bounds) {
  const double padding = box_padding * std::max(bounds.lower.cwiseAbs().maxCoeff(),
                                                bounds.upper.cwiseAbs().maxCoeff());
  bounds.lower.array() -= padding;
  bounds.upper.array() += padding;
  return bounds;
}

}  // namespace

RayAudit::RayAudit(const Scene& scene, const World& world) : scene_(scene), world_(world) {
  for (std::size_t i = 0; i < instance_count(scene); ++i) {
    const Object object = instance_object(scene, i);
    if (object.half_space) {
      constexpr double end = std::numeric_limits<double>::infinity();
      targets_.push_back({object.shape,
                          {Vec3<double>::Constant(-end), Vec3<double>::Constant(end)},
                          object.half_space->posed(object.pose)});
      continue;
    }
    if (object.mesh) {
      const PosedMesh posed(0, object.mesh, object.pose);
      targets_.push_back({object.shape, with_margin(posed.bounds()), {}, posed});
      continue;
    }
    const Shape in_world = Transform{object.shape, object.pose};
    targets_.push_back({in_world, with_margin(bounds_of(in_world))});
  }
}

CertificateVerdict RayAudit::verdict(std::uint32_t instance, const Ray<double>& ray,
                                     std::uint32_t skip, const Claim& claim) {
  ++certificates_;
  if (const auto& half_space = targets_[instance].half_space)
    return verdict_of(*half_space, ray, claim);
  if (const auto& mesh = targets_[instance].mesh)
    return verdict_of(*mesh, ray, claim, instance == skip);
  const SupportFunction support = supports_of(targets_[instance].shape);
  return check_certificate(support, ray, claim, certify(support, ray, claim));
}

void RayAudit::fail(RayKind kind, std::uint32_t instance, const Ray<double>& ray,
                    std::string_view what) {
  ++failed_[index(kind)];
  const std::lock_guard lock(mutex_);
  if (failures_.size() >= most_failures) return;
  std::string message(ray_kind_names[index(kind)]);
  message += " ray: ";
  if (instance == no_instance) {
    failures_.push_back({message + std::string(what), {}});
    return;
  }
  const Object object = instance_object(scene_, instance);
  message += object.name + ": " + std::string(what);
  // Queries are about shapes.
  failures_.push_back(
      {message, !object.has_shape() ? "" : query_line(object, targets_[instance].shape, ray)});
}

bool RayAudit::may_meet(RayKind kind, std::uint32_t instance, const Ray<double>& ray) const {
  return world_.instances().is_shown_to(instance, kinds_of(kind)) &&
         may_pass(targets_[instance].bounds, ray);
}

/// A ray cannot meet a convex shape again that it leaves, but it can meet a mesh.
bool RayAudit::is_ignored(std::uint32_t instance, std::uint32_t skip) const {
  return instance == skip && !targets_[instance].mesh;
}

/// All but two: the shape that the ray leaves, and the object that it meets.
bool RayAudit::all_missed(RayKind kind, const Ray<double>& ray, std::uint32_t skip,
                          std::uint32_t met) {
  Claim miss;
  miss.status = Status::miss;
  for (std::uint32_t i = 0; i < targets_.size(); ++i) {
    if (is_ignored(i, skip) || i == met || !may_meet(kind, i, ray)) continue;
    const CertificateVerdict answer = verdict(i, ray, skip, miss);
    if (answer.holds) continue;
    fail(kind, i, ray, met == no_instance ? "not proven to be missed" : "is met before");
    return false;
  }
  return true;
}

void RayAudit::closest(RayKind kind, const Ray<double>& ray, std::uint32_t skip,
                       const WorldHit& answer) {
  ++rays_[index(kind)];
  if (!answer.found()) {
    all_missed(kind, ray, skip, no_instance);
    return;
  }
  const CertificateVerdict hit = verdict(answer.instance, ray, skip, claim_of(answer.cast));
  if (!hit.holds) return fail(kind, answer.instance, ray, hit.complaint);
  if (answer.cast.status == Status::inside) return;
  // If two objects touch, rounding decides which one is met first.
  const double rounding = hit.allowed / ray.direction.norm();
  all_missed(kind, {ray.origin, ray.direction, std::max(0.0, hit.t_lo() - rounding)}, skip,
             answer.instance);
}

void RayAudit::occluded(RayKind kind, const Ray<double>& ray, std::uint32_t skip, bool answer) {
  ++rays_[index(kind)];
  if (!answer) {
    all_missed(kind, ray, skip, no_instance);
    return;
  }
  for (std::uint32_t i = 0; i < targets_.size(); ++i) {
    if (is_ignored(i, skip) || !may_meet(kind, i, ray)) continue;
    PartCounts parts;
    const CastResult<double> cast =
        targets_[i].half_space ? cast_ray(*targets_[i].half_space, ray)
        : targets_[i].mesh ? cast_ray(*targets_[i].mesh, ray, ray.t_max, i == skip, 0, parts).cast
                           : cast_ray(world_.instances().at(i), ray, world_.options());
    if (cast.found() && verdict(i, ray, skip, claim_of(cast)).holds) return;
  }
  fail(kind, no_instance, ray, "nothing is proven to be in its way");
}

}  // namespace minkray
