// SPDX-License-Identifier: MIT
#include "core/world/posed_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math/outward_sum.h"
#include "core/math/two_fold.h"
#include "core/mesh/crossings.h"
#include "core/mesh/mesh_rays.h"
#include "core/query/tolerances.h"
#include "core/world/posed_mesh_rays.h"

namespace minkray {
namespace {

/// Limit of the ray's origin and direction, so that products of three numbers do not overflow.
constexpr double largest_number = 0x1p300;

/// Rounding of a map: once for each number of the matrix and four times for a product of three
/// pairs, 2.5 epsilon; 3 are allowed.
constexpr double map_rounding = 3 * tolerance::epsilon<double>;

/// Directions that are shorter, or longer than the inverse, are scaled to a length of about 1.
constexpr double shortest = 0x1p-64;

/// The t of a hit is refined after the search, so another mesh's hit at the same t may be less than
/// this one's t in the search, by this share of it.
constexpr double rounding_of_most = 0x1p-20;

/// A ray in the mesh's frame.
struct NearRay {
  PartRay part;
  MapLoss loss;
  bool is_number = true;
};

double in_near(const MapLoss& loss, double t) {
  return loss.exponent == 0 ? t : std::ldexp(t, -loss.exponent);
}
double in_world(const MapLoss& loss, double t) {
  return loss.exponent == 0 ? t : std::ldexp(t, loss.exponent);
}

Vec3<double> mapped_origin(const PosedMesh& posed, const Vec3<double>& origin) {
  const TwoFoldVec3<double> from = exact_difference(origin, posed.pose.translation);
  if (!posed.is_turned) return from.rounded();
  return posed.to_mesh * from.high + posed.to_mesh * from.low;
}

/// Error of the mapped origin.
double loss_of_origin(const PosedMesh& posed, const Vec3<double>& origin) {
  const TwoFoldVec3<double> from = exact_difference(origin, posed.pose.translation);
  if (!posed.is_turned) return from.low.isZero(0) ? 0 : from.low.norm();
  return map_rounding * (posed.to_mesh.cwiseAbs() * from.high.cwiseAbs()).norm();
}

Vec3<double> times_power_of_two(Vec3<double> direction, int exponent) {
  for (double& x : direction) x = std::ldexp(x, exponent);
  return direction;
}

void map_direction(const PosedMesh& posed, const Ray<double>& ray, double most, Ray<double>& near,
                   MapLoss& loss) {
  const double size = ray.direction.cwiseAbs().maxCoeff();
  near.direction = ray.direction;
  loss.exponent = 0;
  if (!(size > shortest && size < 1 / shortest)) [[unlikely]] {
    std::frexp(size, &loss.exponent);
    loss.exponent = -loss.exponent;
    near.direction = times_power_of_two(ray.direction, loss.exponent);
  }
  if (posed.is_turned) near.direction = posed.to_mesh * Vec3<double>(near.direction);
  near.t_max = std::min(in_near(loss, ray.t_max), in_near(loss, most) * (1 + rounding_of_most));
}

/// Error of the mapped direction.
double loss_of_direction(const PosedMesh& posed, const Vec3<double>& direction, int exponent) {
  if (!posed.is_turned) return 0;
  const Vec3<double> scaled = exponent == 0 ? direction : times_power_of_two(direction, exponent);
  return map_rounding * (posed.to_mesh.cwiseAbs() * scaled.cwiseAbs()).norm();
}

/// False if numbers of the mapped ray are too large or NaN, as sums are then, or if its direction
/// is zero.
bool is_usable(const Ray<double>& near) {
  const double size = near.direction.cwiseAbs().sum();
  return size > 0 && size <= largest_number && near.origin.cwiseAbs().sum() <= largest_number;
}

double t_min_of(const PosedMesh& posed, const Ray<double>& near, bool leaves) {
  if (!leaves) return 0;
  const double reach =
      posed.mesh->bounds().reach_of_centre().maxCoeff() + near.origin.cwiseAbs().maxCoeff();
  return leaving_mesh * reach / near.direction.cwiseAbs().maxCoeff();
}

NearRay near_ray(const PosedMesh& posed, const Ray<double>& ray, double loss = 0,
                 double most = std::numeric_limits<double>::infinity()) {
  NearRay near;
  near.loss.before = loss;
  near.part.ray.origin = mapped_origin(posed, ray.origin);
  map_direction(posed, ray, most, near.part.ray, near.loss);
  near.is_number = is_usable(near.part.ray);
  return near;
}

/// Remainder of t lost by rounding: if the origin is far away, t alone has too few digits to locate
/// the hit.
double rest_of(const Vec3<double>& corner, const Vec3<double>& normal, const Ray<double>& ray,
               double t) {
  TwoFoldVec3<double> from_corner = exact_difference(ray.origin, corner);
  for (int k = 0; k < 3; ++k) from_corner.set(k, from_corner[k] + two_product(t, ray.direction[k]));
  return -normal.dot(from_corner.rounded()) / normal.dot(ray.direction);
}

/// Result for a ray whose numbers are too large, or whose direction is zero.
PartCast without_hit(const Ray<double>& ray) {
  PartCast answer;
  if (!ray.direction.isZero(0)) return answer;  // exhausted
  answer.cast.status = Status::miss;
  answer.cast.path = Path::filter;
  return answer;
}

/// All triangles of a mesh with one side look the same way: what is behind the first is seen from
/// behind as well.
bool is_missed_from_behind(const TriangleMesh& mesh, const PartHit& hit) {
  return mesh.sides() == MeshSides::front && hit.is_back;
}

/// Writes the cast that found the hit. The answer must be as constructed; `direction` is the ray's
/// before the map, `of_origin` the error of the mapped origin.
void write_cast(const PosedMesh& posed, const Vec3<double>& direction, const Ray<double>& near,
                const MapLoss& loss, double of_origin, const PartHit& hit, PartCast& answer) {
  CastResult<double>& cast = answer.cast;
  // For the shortest directions t is not a finite number: the cast is exhausted.
  const bool is_found = hit.found() && !is_missed_from_behind(*posed.mesh, hit);
  if (is_found && !std::isfinite(in_world(loss, hit.t))) return;
  cast.path = Path::filter;
  cast.status = is_found ? Status::hit : Status::miss;
  if (!is_found) return;
  answer.part = hit.part;
  const Vec3<double> normal = posed.mesh->normal(hit.part) * (hit.is_back ? -1.0 : 1.0);
  // If the ray is uncertain, so is its distance to the triangle's plane.
  double beside = of_origin;
  if (loss.before > 0) beside += loss.before * posed.to_mesh.norm();
  const double of_direction = loss_of_direction(posed, direction, loss.exponent);
  beside += hit.t * of_direction;
  double error = hit.error;
  if (beside > 0) {
    const double fall = -normal.dot(near.direction) - of_direction;
    error = fall > 0 ? error + beside / fall : std::numeric_limits<double>::infinity();
  }
  const double rest = rest_of(posed.mesh->corner(hit.part, 0), normal, near, hit.t);
  cast.t_base = in_world(loss, hit.t);
  cast.t_offset = std::abs(rest) <= error ? in_world(loss, rest) : 0;
  cast.offset_lo = in_world(loss, std::max(-error, -hit.t));
  cast.offset_hi = in_world(loss, error);
  cast.normal =
      posed.is_turned ? Vec3<double>((posed.to_mesh.transpose() * normal).normalized()) : normal;
}

PartCast cast_of(const PosedMesh& posed, const Ray<double>& ray, const NearRay& near,
                 const PartHit& hit) {
  PartCast answer;
  const double of_origin = hit.found() ? loss_of_origin(posed, ray.origin) : 0;
  write_cast(posed, ray.direction, near.part.ray, near.loss, of_origin, hit, answer);
  return answer;
}

/// The box around the box under the map.
Bounds<double> box_under(const Affine<double>& map, const Bounds<double>& box) {
  const Vec3<double> middle = box.centre(), reach = box.reach_of_centre();
  const Vec3<double> centre = map(middle), around = map.linear.cwiseAbs() * reach;
  return {centre - around, centre + around};
}

}  // namespace

PosedMesh::PosedMesh(std::uint32_t number, std::shared_ptr<const TriangleMesh> of,
                     const Affine<double>& at)
    : instance(number), mesh(std::move(of)), pose(at) {
  is_turned = at.linear != Mat3<double>::Identity();
  if (is_turned) to_mesh = accurate_inverse<double>(at.linear);
}

Bounds<double> PosedMesh::bounds_under(const Affine<double>& other) const {
  return box_under(other, mesh->bounds());
}

Bounds<double> PosedMesh::tight_bounds_under(const Affine<double>& other) const {
  if (other.linear == Mat3<double>::Identity()) return bounds_under(other);
  constexpr int depth = 3;
  Bounds<double> tight;
  const auto extend = [&](const auto& self, std::uint32_t number, int left) -> void {
    const BvhNode& node = mesh->bvh().nodes[number];
    for (int i = 0; i < bvh_width && node.children[i] != BvhNode::none; ++i) {
      const bool is_leaf = (node.children[i] & BvhNode::leaf) != 0;
      if (left > 1 && !is_leaf) {
        self(self, node.children[i], left - 1);
        continue;
      }
      const Bounds<float> box = node.box(i);
      const Bounds<double> under =
          box_under(other, {box.lower.cast<double>(), box.upper.cast<double>()});
      tight.extend(under.lower);
      tight.extend(under.upper);
    }
  };
  extend(extend, 0, depth);
  const Bounds<double> whole = bounds_under(other);
  return {whole.lower.cwiseMax(tight.lower), whole.upper.cwiseMin(tight.upper)};
}

PartCast cast_ray(const PosedMesh& posed, const Ray<double>& ray, double most, bool leaves,
                  double loss, PartCounts& counts) {
  const NearRay near = near_ray(posed, ray, loss, most);
  if (!near.is_number) return without_hit(ray);
  const double t_min = t_min_of(posed, near.part.ray, leaves);
  return cast_of(posed, ray, near, closest_part(*posed.mesh, near.part.ray, t_min, counts));
}

void RaysAtMesh::begin(const PosedMesh& posed, std::size_t most_rays) {
  posed_ = &posed;
  count_ = 0;
  if (rays_.size() >= most_rays) return;
  rays_.resize(most_rays);
  losses_.resize(most_rays);
  numbers_.resize(most_rays);
}

bool RaysAtMesh::add(std::uint32_t number, const Ray<double>& ray, double most, bool leaves,
                     double loss) {
  PartRay& part = rays_[count_];
  MapLoss& of_map = losses_[count_];
  of_map.before = loss;
  if (count_ > 0 && ray.origin == last_origin_) {
    part.ray.origin = rays_[count_ - 1].ray.origin;
  } else {
    part.ray.origin = mapped_origin(*posed_, ray.origin);
    last_origin_ = ray.origin;
  }
  map_direction(*posed_, ray, most, part.ray, of_map);
  if (!is_usable(part.ray)) [[unlikely]]
    return false;
  part.t_min = t_min_of(*posed_, part.ray, leaves);
  numbers_[count_++] = number;
  return true;
}

void RaysAtMesh::find_closest(PartCounts& counts) {
  hits_.resize(std::max(hits_.size(), count_));
  closest_parts(*posed_->mesh, std::span(rays_.data(), count_), hits_, counts);
}

void RaysAtMesh::find_any(std::span<std::uint8_t> met, PartCounts& counts) {
  if (posed_->mesh->sides() == MeshSides::front) {
    find_closest(counts);
    for (std::size_t i = 0; i < count_; ++i)
      if (hits_[i].found() && !is_missed_from_behind(*posed_->mesh, hits_[i])) met[numbers_[i]] = 1;
    return;
  }
  met_.resize(std::max(met_.size(), count_));
  meet_parts(*posed_->mesh, std::span(rays_.data(), count_), met_, counts);
  for (std::size_t i = 0; i < count_; ++i) met[numbers_[i]] |= met_[i];
}

PartCast RaysAtMesh::closest(std::size_t i, const Ray<double>& ray, OriginLoss& last) const {
  if (ray.origin != last.origin) last = {ray.origin, loss_of_origin(*posed_, ray.origin)};
  PartCast answer;
  write_cast(*posed_, ray.direction, rays_[i].ray, losses_[i], last.loss, hits_[i], answer);
  return answer;
}

CastResult<double> cast_exit(const PosedMesh& posed, const Ray<double>& ray) {
  CastResult<double> exit;
  exit.status = Status::miss;
  const NearRay near = near_ray(posed, ray);
  if (!near.is_number) return exit;
  const std::vector<PartHit> hits = all_parts(*posed.mesh, near.part.ray);
  if (hits.empty()) return exit;
  // Triangles that share the corner or edge where the ray enters count as one hit.
  const double same = leaving_mesh * (hits[0].t + posed.mesh->bounds().reach_of_centre().norm());
  std::size_t last = 0;
  while (last + 1 < hits.size() && hits[last].t - hits[0].t <= same) ++last;
  exit.status = Status::hit;
  exit.t_offset = in_world(near.loss, hits[last].t);
  return exit;
}

PartCast cast_last_exit(const PosedMesh& posed, const Ray<double>& ray, double loss) {
  const NearRay near = near_ray(posed, ray, loss);
  if (!near.is_number) return without_hit(ray);
  const TriangleMesh& mesh = *posed.mesh;
  if (std::isfinite(near.part.ray.t_max) && mesh.is_closed()) {
    Ray<double> endless = near.part.ray;
    endless.t_max = std::numeric_limits<double>::infinity();
    int turns = 0;
    for (const PartHit& hit : crossings(mesh, endless))
      if (hit.t > near.part.ray.t_max) turns += hit.is_back ? 1 : -1;
    if (turns != 0) {
      PartCast end;
      end.cast = {Status::inside, Path::filter, ray.t_max, 0, 0, 0};
      return end;
    }
  }
  std::vector<PartHit> hits = all_parts(mesh, near.part.ray);
  std::erase_if(hits, [&](const PartHit& hit) { return is_missed_from_behind(mesh, hit); });
  PartHit last;
  for (const PartHit& hit : hits)
    if (!last.found() || hit.t > last.t) last = hit;
  PartCast exit = cast_of(posed, ray, near, last);
  if (exit.cast.status != Status::hit) return exit;
  exit.cast.normal *= -1;
  // Within the errors, another triangle may be the last one.
  for (const PartHit& hit : hits) {
    if (hit.t + hit.error < last.t - last.error) continue;
    const CastResult<double> other = cast_of(posed, ray, near, hit).cast;
    exit.cast.offset_hi =
        std::max(exit.cast.offset_hi,
                 sum_or_more(sum_or_more(other.t_base, other.offset_hi), -exit.cast.t_base));
  }
  return exit;
}

bool add_crossings(const PosedMesh& posed, const Ray<double>& ray, double loss,
                   std::vector<PartCrossing>& to) {
  const NearRay near = near_ray(posed, ray, loss);
  if (!near.is_number) return without_hit(ray).cast.status == Status::miss;
  for (const PartHit& hit : crossings(*posed.mesh, near.part.ray)) {
    if (is_missed_from_behind(*posed.mesh, hit)) continue;
    PartCast at = cast_of(posed, ray, near, hit);
    if (!at.cast.found()) return false;
    if (hit.is_back) at.cast.normal *= -1;
    to.push_back({at, hit.is_back});
  }
  return true;
}

bool is_met(const PosedMesh& posed, const Ray<double>& ray, bool leaves, PartCounts& counts) {
  const NearRay near = near_ray(posed, ray);
  if (!near.is_number) return false;
  const double t_min = t_min_of(posed, near.part.ray, leaves);
  if (posed.mesh->sides() == MeshSides::both)
    return meets_part(*posed.mesh, near.part.ray, t_min, counts);
  const PartHit hit = closest_part(*posed.mesh, near.part.ray, t_min, counts);
  return hit.found() && !is_missed_from_behind(*posed.mesh, hit);
}

}  // namespace minkray
