// SPDX-License-Identifier: MIT
// C interface: derivatives of ray casts by the rays and the bodies that they hit.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pair/sharp_point.h"
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

/// Hits of rays, in the caller's form.
struct Met {
  double t, t_lo, t_hi;
  Vec3<double> point, normal;
  std::uint32_t object;
  std::uint8_t status;

  Met(const minkray_hit_arrays& hits, std::size_t i)
      : t(hits.t[i]),
        t_lo(hits.t_lo[i]),
        t_hi(hits.t_hi[i]),
        point(hits.points + 3 * i),
        normal(hits.normals + 3 * i),
        object(hits.objects[i]),
        status(hits.status[i]) {}
};

/// Second differences of t over nearby rays on both sides, relative to the step; infinite where one
/// of them misses.
class Bend {
 public:
  Bend(const World& world, const Ray<double>& ray, const Met& met, double size)
      : shape_(world.instances().at(met.object)),
        ray_(ray),
        // A way that is unlikely to be along an edge.
        aside_(unit<double>(ray.direction.cross(Vec3<double>(0.3713, -0.5571, 0.7428)) +
                            0.6180 * ray.direction.norm() * ray.direction.unitOrthogonal())),
        t_(met.t),
        size_(size) {}

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
  PreparedShape<double> shape_;
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
    if (to_.jac_body) {
      put(by_point, to_.jac_body, 2 * i);
      put((met.point - bodies_.origin(met.object)).cross(by_point), to_.jac_body, 2 * i + 1);
    }
    if (!to_.is_ridge) return;
    constexpr double grazing = 1e-6;
    const double length = ray.direction.norm();
    const double off = (met.t_hi - met.t_lo) * length;
    to_.is_ridge[i] =
        !std::isfinite(off) || !(-along > grazing * length) || is_sharp(ray, met, off) ? 1 : 0;
  }

  bool is_sharp(const Ray<double>& ray, const Met& met, double off) const {
    const ContactBody* const body = bodies_.body(met.object);
    constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
    const double rounded = off + rounding * (met.point.norm() + ray.origin.norm());
    if (body && body->mesh) {
      const Vec3<double> point =
          body->pose.linear.transpose() * (met.point - body->pose.translation);
      if (minkray::bends_at(*body->mesh, point, rounded + rounding * body->mesh->reach()))
        return true;
    } else if (body) {
      const ShapeCore& core = body->shape.core();
      const double near = rounded + rounding * body->shape.ball_radius() + core.rounding;
      // A shape grown by a radius has no edge.
      if (!(core.radius > 0)) {
        if (core.kind == CoreKind::other) {
          if (bends_at(world_, ray, met, core.ball)) return true;
        } else {
          const PlacedCore frame = placed(body->shape, body->pose);
          if (is_sharp_at(core, frame.turn.transpose() * (met.point - frame.middle),
                          frame.turn.transpose() * met.normal, near))
            return true;
        }
      }
    }
    return bodies_.is_another_at(met.point, met.object, 2 * rounded);
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
    if (derivatives->size < sizeof(minkray_ray_derivatives))
      wrong_use("derivatives.size: must be sizeof(minkray_ray_derivatives)");
    if (count > 0) require_all(*hits);
    const RaySource source(rays, count);
    const size_t objects = held->world().instances().size();
    for (size_t i = 0; i < count; ++i)
      if (hits->status[i] == MINKRAY_HIT &&
          (hits->objects[i] >= objects || held->is_removed(hits->objects[i])))
        wrong_use("hits.objects[" + std::to_string(i) + "]: must be an object of the scene (got " +
                  std::to_string(hits->objects[i]) + ")");
    const Derivatives all(*held, source, *hits, *derivatives);
    work_on_rays(count, options, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) all.tell(i);
    });
    throw_if_lied(held->customs());
  });
}

}  // extern "C"
