// SPDX-License-Identifier: MIT
// C interface: derivatives of ray casts with respect to the rays and to the bodies that they hit.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "core/pair/sharp_point.h"
#include "core/pair_derivative/normal_error.h"
#include "core/parts/bends.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/held_scene.h"
#include "renderer/library/handles/pair_answers.h"
#include "renderer/library/handles/ray_source.h"
#include "renderer/library/handles/scene_bodies.h"
#include "renderer/library/handles/work_on_rays.h"

namespace minkray {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr double no_bound = std::numeric_limits<double>::infinity();

/// Hits of rays, in the caller's form.
struct Met {
  double t, t_lo, t_hi;
  Vec3<double> point, normal;
  std::uint32_t object;
  std::int32_t part;
  std::uint8_t status;

  Met(const minkray_hit_arrays& hits, std::size_t i)
      : t(hits.t[i]),
        t_lo(hits.t_lo[i]),
        t_hi(hits.t_hi[i]),
        point(hits.points + 3 * i),
        normal(hits.normals + 3 * i),
        object(hits.objects[i]),
        part(hits.parts ? hits.parts[i] : -1),
        status(hits.status[i]) {}
};

/// Second differences of t over nearby rays on both sides, relative to the step; infinite where one
/// of them misses.
class Bend {
 public:
  Bend(const World& world, const Ray<double>& ray, const Met& met, double size)
      : shape_(prepared(world.instances(), met)),
        ray_(ray),
        // A way that is unlikely to be along an edge.
        aside_(unit<double>(ray.direction.cross(Vec3<double>(0.3713, -0.5571, 0.7428)) +
                            0.6180 * ray.direction.norm() * ray.direction.unitOrthogonal())),
        t_(met.t),
        size_(size) {}

  static PreparedShape prepared(const Instances& instances, const Met& met) {
    if (!instances.is_compound(met.object)) return instances.at(met.object);
    const PosedCompound& posed = instances.compound_of(met.object);
    const auto part = static_cast<std::uint32_t>(met.part);
    return {posed.compound->definition(part), posed.parts[part]};
  }

  double over(double step) const {
    double sum = -2 * t_;
    for (const double side : {-step * size_, step * size_}) {
      Ray<double> beside = ray_;
      beside.origin += side * aside_;
      const CastResult<double> cast = cast_ray(shape_, beside);
      if (!cast.found()) return std::numeric_limits<double>::infinity();
      sum += cast.t();
    }
    return std::abs(sum) * ray_.direction.norm() / (step * size_);
  }

 private:
  PreparedShape shape_;
  const Ray<double>& ray_;
  Vec3<double> aside_;
  double t_, size_;
};

/// True if the surface of a shape that is known only by its support mapping has an edge there: a
/// bend that stays when steps get shorter. Curved surfaces' bends shrink with the step.
bool bends_at(const World& world, const Ray<double>& ray, const Met& met, double size) {
  constexpr double step = 1e-6;  // of the size
  constexpr double bent = 1e-4;
  const Bend bend(world, ray, met, size);
  if (bend.over(step) <= bent) return false;
  const double finer = bend.over(step / 32);
  if (finer <= bent) return false;
  return !std::isfinite(finer) || !(bend.over(step / 1024) < finer / 4);
}

class Derivatives {
 public:
  Derivatives(const HeldScene& scene, const RaySource& rays, const minkray_hit_arrays& hits,
              const minkray_ray_derivatives& to)
      : world_(scene.world()), bodies_(scene.bodies()), rays_(rays), hits_(hits), to_(to) {}

  void tell(std::size_t i) const {
    const Met met(hits_, i);
    if (met.status == MINKRAY_HIT) return tell_hit(i, met);
    // A ray that begins inside meets it at once, wherever it is.
    fill(i, met.status == MINKRAY_INSIDE ? 0 : not_known, met.status == MINKRAY_EXHAUSTED);
  }

 private:
  void fill(std::size_t i, double number, bool is_ridge) const {
    if (to_.jac_ray) std::fill_n(to_.jac_ray + 6 * i, 6, number);
    if (to_.jac_body) std::fill_n(to_.jac_body + 6 * i, 6, number);
    if (to_.is_ridge) to_.is_ridge[i] = is_ridge ? 1 : 0;
    fill_errors(i, is_ridge ? no_bound : number, is_ridge ? no_bound : number);
  }

  bool wants_errors() const { return to_.jac_error_ray || to_.jac_error_body; }
  void fill_errors(std::size_t i, double first, double second) const {
    for (double* const errors : {to_.jac_error_ray, to_.jac_error_body}) {
      if (!errors) continue;
      errors[2 * i] = first;
      errors[2 * i + 1] = second;
    }
  }

  void tell_hit(std::size_t i, const Met& met) const {
    const Ray<double> ray = rays_[i];
    const double along = met.normal.dot(ray.direction);
    const Vec3<double> by_point = met.normal / along;
    if (!std::isfinite(by_point.sum())) return fill(i, not_known, true);
    if (to_.jac_ray) {
      put(-by_point, to_.jac_ray, 2 * i);
      put(-met.t * by_point, to_.jac_ray, 2 * i + 1);
    }
    const Vec3<double> arm = met.point - bodies_.origin(met.object);
    if (to_.jac_body) {
      put(by_point, to_.jac_body, 2 * i);
      put(arm.cross(by_point), to_.jac_body, 2 * i + 1);
    }
    if (!to_.is_ridge && !wants_errors()) return;
    constexpr double grazing = 1e-6;
    const double length = ray.direction.norm();
    const double off = (met.t_hi - met.t_lo) * length;
    const bool is_ridge =
        !std::isfinite(off) || !(-along > grazing * length) || is_sharp(ray, met, off);
    if (to_.is_ridge) to_.is_ridge[i] = is_ridge ? 1 : 0;
    if (!wants_errors()) return;
    fill_errors(i, no_bound, no_bound);
    if (!is_ridge) tell_errors(i, ray, met, arm);
  }

  /// Bounds for m = n/(n.d), the derivative with respect to the origin, for t m (to the direction),
  /// and for arm x m (to a turn).
  void tell_errors(std::size_t i, const Ray<double>& ray, const Met& met,
                   const Vec3<double>& arm) const {
    const double length = ray.direction.norm();
    const double off = rounded(ray, met, (met.t_hi - met.t_lo) * length);
    const double tilt = tilt_at(met, off);
    const double along = std::abs(met.normal.dot(ray.direction)), least = along - tilt * length;
    if (!(least > 0)) return;
    const double of_point = tilt * (1 / least + length / (least * least)), by_point = 1 / least;
    const double of_time = off / length;
    if (to_.jac_error_ray) {
      to_.jac_error_ray[2 * i] = of_point;
      to_.jac_error_ray[2 * i + 1] = std::abs(met.t) * of_point + by_point * of_time;
    }
    if (to_.jac_error_body) {
      const double of_arm = off + rounding * (met.point.norm() + bodies_.origin(met.object).norm());
      to_.jac_error_body[2 * i] = of_point;
      to_.jac_error_body[2 * i + 1] = arm.norm() * of_point + by_point * of_arm;
    }
  }

  static constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

  /// Error bound of the hit's point: `off` from the bounds of t, and rounding.
  static double rounded(const Ray<double>& ray, const Met& met, double off) {
    return off + rounding * (met.point.norm() + ray.origin.norm());
  }

  /// Error bound of the normal; infinite where nothing is known.
  double tilt_at(const Met& met, double off) const {
    constexpr double of_plane = 16 * std::numeric_limits<double>::epsilon();
    const ContactBody* const body = bodies_.body(met.object);
    // Robots' meshes may be hulls or half-spaces for contact, which rays do not meet.
    if (world_.instances().is_mesh(met.object) && !(body && body->mesh)) return no_bound;
    if (!body) return of_plane;
    // Poses may be rigid to a few digits only.
    const auto lean_of = [](const Mat3<double>& turn) {
      return 4 * (turn.transpose() * turn - Mat3<double>::Identity()).norm() + of_plane;
    };
    if (body->mesh) {
      const TriangleMesh& mesh = *body->mesh;
      const auto part = static_cast<std::uint32_t>(met.part);
      if (met.part < 0 || part >= mesh.size()) return no_bound;
      const Vec3<double> own = body->pose.linear * mesh.normal(part);
      const Vec3<double> a = mesh.corner(part, 1) - mesh.corner(part, 0),
                         b = mesh.corner(part, 2) - mesh.corner(part, 0);
      const double of_corners = rounding * mesh.reach() *
                                std::max({a.norm(), b.norm(), (b - a).norm()}) / a.cross(b).norm();
      const double lean = std::min((own - met.normal).norm(), (own + met.normal).norm());
      return lean + of_corners + lean_of(body->pose.linear);
    }
    const ContactShape* const shape = shape_of(*body, met);
    if (!shape) return no_bound;
    const ShapeCore& core = shape->core();
    const PlacedCore frame = placed(*shape, body->pose);
    const double lean = lean_of(frame.turn);
    const double near = off + (rounding + lean) * shape->ball_radius() + core.rounding;
    return lean + normal_error_at(core, frame.turn.transpose() * (met.point - frame.middle),
                                  frame.turn.transpose() * met.normal, near);
  }

  /// The shape that is hit, or the part of a compound. Null if the compound has no such part.
  static const ContactShape* shape_of(const ContactBody& body, const Met& met) {
    if (!body.compound) return &body.shape;
    const auto part = static_cast<std::uint32_t>(met.part);
    return part < body.compound->size() ? &body.compound->contact(part) : nullptr;
  }

  static bool is_another_part_at(const ContactBody& body, const Met& met, double near) {
    if (!body.compound) return false;
    static const ContactShape point{Shape(Point())};
    Affine<double> at;
    at.translation = met.point;
    for (std::size_t i = 0; i < body.compound->size(); ++i) {
      if (i == static_cast<std::uint32_t>(met.part)) continue;
      const SignedDistance distance =
          signed_distance(point, at, body.compound->contact(i), body.pose);
      if (distance.lower <= near && distance.upper >= -near) return true;
    }
    return false;
  }

  bool is_sharp(const Ray<double>& ray, const Met& met, double off) const {
    const ContactBody* const body = bodies_.body(met.object);
    const double near_point = rounded(ray, met, off);
    if (body && body->mesh) {
      const Vec3<double> point =
          body->pose.linear.transpose() * (met.point - body->pose.translation);
      if (bends_or_ends_at(*body->mesh, point, near_point + rounding * body->mesh->reach()))
        return true;
    } else if (body) {
      const ContactShape* const shape = shape_of(*body, met);
      if (!shape || is_another_part_at(*body, met, 2 * near_point)) return true;
      const ShapeCore& core = shape->core();
      const double near = near_point + rounding * shape->ball_radius() + core.rounding;
      // A shape grown by a radius has no edge.
      if (!(core.radius > 0)) {
        if (core.kind == CoreKind::other) {
          if (bends_at(world_, ray, met, core.ball)) return true;
        } else {
          const PlacedCore frame = placed(*shape, body->pose);
          if (is_sharp_at(core, frame.turn.transpose() * (met.point - frame.middle),
                          frame.turn.transpose() * met.normal, near))
            return true;
        }
      }
    }
    return bodies_.is_another_at(met.point, met.object, 2 * near_point);
  }

  const World& world_;
  const SceneBodies& bodies_;
  const RaySource& rays_;
  const minkray_hit_arrays& hits_;
  const minkray_ray_derivatives& to_;
};

void require_all(const minkray_hit_arrays& hits) {
  require(hits.t, "hits.t");
  require(hits.t_lo, "hits.t_lo");
  require(hits.t_hi, "hits.t_hi");
  require(hits.points, "hits.points");
  require(hits.normals, "hits.normals");
  require(hits.objects, "hits.objects");
  require(hits.status, "hits.status");
}

}  // namespace
}  // namespace minkray

using namespace minkray;

extern "C" {

int minkray_scene_ray_derivatives(minkray_scene scene, const minkray_ray_arrays* rays, size_t count,
                                  const minkray_hit_arrays* hits,
                                  const minkray_ray_derivatives* derivatives,
                                  const minkray_options* options) {
  return call("minkray_scene_ray_derivatives", [&] {
    const SceneQuery held(scene);
    require(hits, "hits");
    if (hits->size < offsetof(minkray_hit_arrays, parts))
      wrong_use("hits.size: must be sizeof(minkray_hit_arrays)");
    require(derivatives, "derivatives");
    if (derivatives->size < offsetof(minkray_ray_derivatives, jac_error_ray))
      wrong_use("derivatives.size: must be sizeof(minkray_ray_derivatives)");
    minkray_ray_derivatives to = {};
    std::memcpy(&to, derivatives, std::min(derivatives->size, sizeof to));
    minkray_hit_arrays from = {};
    std::memcpy(&from, hits, std::min(hits->size, sizeof from));
    if (count > 0) require_all(from);
    const RaySource source(rays, count);
    const size_t objects = held->world().instances().size();
    for (size_t i = 0; i < count; ++i)
      if (from.status[i] == MINKRAY_HIT &&
          (from.objects[i] >= objects || held->is_removed(from.objects[i])))
        wrong_use("hits.objects[" + std::to_string(i) + "]: must be an object of the scene (got " +
                  std::to_string(from.objects[i]) + ")");
    const Derivatives all(*held, source, from, to);
    work_on_rays(count, options, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) all.tell(i);
    });
    throw_if_lied(held->customs());
  });
}

}  // extern "C"
