// SPDX-License-Identifier: MIT
#include "core/world/posed_mesh.h"

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

/// The ray in the mesh's frame. Its direction is longer by 2^exponent there.
struct NearRay {
  Ray<double> ray;
  double origin_loss = 0, direction_loss = 0;  ///< bounds on their errors
  int exponent = 0;
  bool is_number = true;

  double in_near(double t) const { return exponent == 0 ? t : std::ldexp(t, -exponent); }
  double in_world(double t) const { return exponent == 0 ? t : std::ldexp(t, exponent); }
};

NearRay near_ray(const PosedMesh& posed, const Ray<double>& ray,
                 double most = std::numeric_limits<double>::infinity()) {
  NearRay near;
  const double size = ray.direction.cwiseAbs().maxCoeff();
  Vec3<double> direction = ray.direction;
  if (!(size > shortest && size < 1 / shortest)) [[unlikely]] {
    std::frexp(size, &near.exponent);
    near.exponent = -near.exponent;
    for (double& x : direction) x = std::ldexp(x, near.exponent);
  }
  const TwoFoldVec3<double> from = exact_difference(ray.origin, posed.pose.translation);
  if (posed.is_turned) {
    near.ray.origin = posed.to_mesh * from.high + posed.to_mesh * from.low;
    near.ray.direction = posed.to_mesh * direction;
    const Mat3<double> sizes = posed.to_mesh.cwiseAbs();
    near.origin_loss = map_rounding * (sizes * from.high.cwiseAbs()).norm();
    near.direction_loss = map_rounding * (sizes * direction.cwiseAbs()).norm();
  } else {
    near.ray.origin = from.rounded();
    near.ray.direction = direction;
    if (!from.low.isZero(0)) near.origin_loss = from.low.norm();
  }
  near.ray.t_max = std::min(near.in_near(ray.t_max), near.in_near(most) * (1 + rounding_of_most));
  near.is_number = size > 0 && near.ray.origin.cwiseAbs().maxCoeff() <= largest_number &&
                   near.ray.direction.cwiseAbs().maxCoeff() <= largest_number;
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

double t_min_of(const PosedMesh& posed, const NearRay& near, bool leaves) {
  if (!leaves) return 0;
  const double reach =
      posed.mesh->bounds().reach_of_centre().maxCoeff() + near.ray.origin.cwiseAbs().maxCoeff();
  return leaving_mesh * reach / near.ray.direction.cwiseAbs().maxCoeff();
}

/// Result for a ray whose numbers are too large, or whose direction is zero.
MeshCast without_hit(const Ray<double>& ray) {
  MeshCast answer;
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

MeshCast cast_of(const PosedMesh& posed, const NearRay& near, const PartHit& hit, double loss) {
  MeshCast answer;
  CastResult<double>& cast = answer.cast;
  cast.status = Status::miss;
  cast.path = Path::filter;
  if (!hit.found() || is_missed_from_behind(*posed.mesh, hit)) return answer;
  // For the shortest directions t is not a finite number: the cast is exhausted.
  if (!std::isfinite(near.in_world(hit.t))) return {};
  answer.part = hit.part;
  const Vec3<double> normal = posed.mesh->normal(hit.part) * (hit.is_back ? -1.0 : 1.0);
  // If the ray is uncertain, so is its distance to the triangle's plane.
  const double beside =
      near.origin_loss + loss * posed.to_mesh.norm() + hit.t * near.direction_loss;
  double error = hit.error;
  if (beside > 0) {
    const double fall = -normal.dot(near.ray.direction) - near.direction_loss;
    error = fall > 0 ? error + beside / fall : std::numeric_limits<double>::infinity();
  }
  cast.status = Status::hit;
  const double rest = rest_of(posed.mesh->corner(hit.part, 0), normal, near.ray, hit.t);
  cast.t_base = near.in_world(hit.t);
  cast.t_offset = std::abs(rest) <= error ? near.in_world(rest) : 0;
  cast.offset_lo = near.in_world(std::max(-error, -hit.t));
  cast.offset_hi = near.in_world(error);
  cast.normal =
      posed.is_turned ? Vec3<double>((posed.to_mesh.transpose() * normal).normalized()) : normal;
  return answer;
}

}  // namespace

PosedMesh::PosedMesh(std::uint32_t number, std::shared_ptr<const TriangleMesh> of,
                     const Affine<double>& at)
    : instance(number), mesh(std::move(of)), pose(at) {
  is_turned = at.linear != Mat3<double>::Identity();
  if (is_turned) to_mesh = accurate_inverse<double>(at.linear);
}

Bounds<double> PosedMesh::bounds_under(const Affine<double>& other) const {
  const Bounds<double>& own = mesh->bounds();
  const Vec3<double> middle = own.centre(), reach = own.reach_of_centre();
  const Vec3<double> centre = other(middle), around = other.linear.cwiseAbs() * reach;
  return {centre - around, centre + around};
}

MeshCast cast_ray(const PosedMesh& posed, const Ray<double>& ray, double most, bool leaves,
                  double loss, PartCounts& counts) {
  const NearRay near = near_ray(posed, ray, most);
  if (!near.is_number) return without_hit(ray);
  const PartHit hit = closest_part(*posed.mesh, near.ray, t_min_of(posed, near, leaves), counts);
  return cast_of(posed, near, hit, loss);
}

void cast_for(const PosedMesh& posed, std::span<const MeshQuery> queries, PartCounts& counts,
              const CastTaker& taker) {
  FirstTouchVector<NearRay> near;
  FirstTouchVector<PartRay> rays;
  near.resize(queries.size());
  rays.resize(queries.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const MeshQuery& query = queries[i];
    near[i] = near_ray(posed, query.ray, query.most);
    if (near[i].is_number) rays[count++] = {near[i].ray, t_min_of(posed, near[i], query.leaves)};
  }
  FirstTouchVector<PartHit> hits;
  hits.resize(count);
  closest_parts(*posed.mesh, std::span(rays.data(), count), hits, counts);
  std::size_t next = 0;
  for (std::size_t i = 0; i < queries.size(); ++i)
    taker.take(taker.context, i,
               near[i].is_number ? cast_of(posed, near[i], hits[next++], queries[i].loss)
                                 : without_hit(queries[i].ray));
}

CastResult<double> cast_exit(const PosedMesh& posed, const Ray<double>& ray) {
  CastResult<double> exit;
  exit.status = Status::miss;
  const NearRay near = near_ray(posed, ray);
  if (!near.is_number) return exit;
  const std::vector<PartHit> hits = all_parts(*posed.mesh, near.ray);
  if (hits.empty()) return exit;
  // Triangles that share the corner or edge where the ray enters count as one hit.
  const double same = leaving_mesh * (hits[0].t + posed.mesh->bounds().reach_of_centre().norm());
  std::size_t last = 0;
  while (last + 1 < hits.size() && hits[last].t - hits[0].t <= same) ++last;
  exit.status = Status::hit;
  exit.t_offset = near.in_world(hits[last].t);
  return exit;
}

MeshCast cast_last_exit(const PosedMesh& posed, const Ray<double>& ray, double loss) {
  const NearRay near = near_ray(posed, ray);
  if (!near.is_number) return without_hit(ray);
  const TriangleMesh& mesh = *posed.mesh;
  if (std::isfinite(near.ray.t_max) && mesh.is_closed()) {
    Ray<double> endless = near.ray;
    endless.t_max = std::numeric_limits<double>::infinity();
    int turns = 0;
    for (const PartHit& hit : crossings(mesh, endless))
      if (hit.t > near.ray.t_max) turns += hit.is_back ? 1 : -1;
    if (turns != 0) {
      MeshCast end;
      end.cast = {Status::inside, Path::filter, ray.t_max, 0, 0, 0};
      return end;
    }
  }
  std::vector<PartHit> hits = all_parts(mesh, near.ray);
  std::erase_if(hits, [&](const PartHit& hit) { return is_missed_from_behind(mesh, hit); });
  PartHit last;
  for (const PartHit& hit : hits)
    if (!last.found() || hit.t > last.t) last = hit;
  MeshCast exit = cast_of(posed, near, last, loss);
  if (exit.cast.status != Status::hit) return exit;
  exit.cast.normal *= -1;
  // Within the errors, another triangle may be the last one.
  for (const PartHit& hit : hits) {
    if (hit.t + hit.error < last.t - last.error) continue;
    const CastResult<double> other = cast_of(posed, near, hit, loss).cast;
    exit.cast.offset_hi =
        std::max(exit.cast.offset_hi,
                 sum_or_more(sum_or_more(other.t_base, other.offset_hi), -exit.cast.t_base));
  }
  return exit;
}

bool add_crossings(const PosedMesh& posed, const Ray<double>& ray, double loss,
                   std::vector<MeshCrossing>& to) {
  const NearRay near = near_ray(posed, ray);
  if (!near.is_number) return without_hit(ray).cast.status == Status::miss;
  for (const PartHit& hit : crossings(*posed.mesh, near.ray)) {
    if (is_missed_from_behind(*posed.mesh, hit)) continue;
    MeshCast at = cast_of(posed, near, hit, loss);
    if (!at.cast.found()) return false;
    if (hit.is_back) at.cast.normal *= -1;
    to.push_back({at, hit.is_back});
  }
  return true;
}

bool is_met(const PosedMesh& posed, const Ray<double>& ray, bool leaves, PartCounts& counts) {
  const NearRay near = near_ray(posed, ray);
  if (!near.is_number) return false;
  const double t_min = t_min_of(posed, near, leaves);
  if (posed.mesh->sides() == MeshSides::both)
    return meets_part(*posed.mesh, near.ray, t_min, counts);
  const PartHit hit = closest_part(*posed.mesh, near.ray, t_min, counts);
  return hit.found() && !is_missed_from_behind(*posed.mesh, hit);
}

void are_met(const PosedMesh& posed, std::span<const MeshQuery> queries,
             std::span<std::uint8_t> met, PartCounts& counts) {
  if (posed.mesh->sides() == MeshSides::front) {
    for (std::size_t i = 0; i < queries.size(); ++i)
      met[i] = is_met(posed, queries[i].ray, queries[i].leaves, counts) ? 1 : 0;
    return;
  }
  std::vector<PartRay> rays;
  std::vector<std::size_t> number;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    met[i] = 0;
    const NearRay near = near_ray(posed, queries[i].ray);
    if (!near.is_number) continue;
    rays.push_back({near.ray, t_min_of(posed, near, queries[i].leaves)});
    number.push_back(i);
  }
  std::vector<std::uint8_t> are(rays.size());
  meet_parts(*posed.mesh, rays, are, counts);
  for (std::size_t i = 0; i < are.size(); ++i) met[number[i]] = are[i];
}

}  // namespace minkray
