// SPDX-License-Identifier: MIT
// C interface: ray casts.
#include <algorithm>
#include <bit>
#include <span>
#include <vector>

#include "core/cast/cast.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/held_scene.h"
#include "renderer/library/handles/held_shape.h"
#include "renderer/library/handles/poses.h"
#include "renderer/library/handles/ray_source.h"
#include "renderer/library/handles/work_on_rays.h"

namespace minkray {
namespace {

/// Rays of a call that waits for others' support points: few, so that there is much to gather.
constexpr std::size_t gathered_at_once = 32;

/// Calls write(i, ray, hit, exhausted) or write(i, ray, block, k) for each ray.
template <class Write>
class Writer : public HitReceiver {
 public:
  Writer(const RaySource& rays, std::size_t first, const Write& write)
      : rays_(rays), first_(first), write_(write) {}

  void take(std::size_t ray, const WorldHit& hit, bool exhausted) override {
    const Ray<double> of = rays_[first_ + ray];
    write_(first_ + ray, of, hit, exhausted);
  }
  void take(std::size_t first, std::uint64_t which, const BlockHits& hits) override {
    for (; which != 0; which &= which - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(which));
      write_(first_ + first + k, rays_[first_ + first + k], hits, k);
    }
  }

 private:
  const RaySource& rays_;
  std::size_t first_;
  const Write& write_;
};

template <class Write>
void cast_rays(const HeldScene& scene, const RaySource& rays, const minkray_options* options,
               const Write& write) {
  const World& world = scene.world();
  const bool gathered = are_gathered(scene.customs());
  const auto part = [&](std::size_t first, std::size_t end) {
    std::vector<Ray<double>> room;
    Writer<Write> writer(rays, first, write);
    QueryCounts counts;
    world.closest_hits(rays.part(first, end - first, room), writer, counts);
  };
  work_on_groups(rays.size(),
                 gathered ? gathered_at_once : std::max(rays_a_part, world.rays_at_once()),
                 gathered, options, part);
  throw_if_lied(scene.customs());
}

void find_occluded(const HeldScene& scene, const RaySource& rays, std::uint8_t* blocked,
                   const minkray_options* options) {
  const World& world = scene.world();
  const bool gathered = are_gathered(scene.customs());
  const auto part = [&](std::size_t first, std::size_t end) {
    std::vector<Ray<double>> room;
    QueryCounts counts;
    const std::span met(blocked + first, end - first);
    world.occluded(rays.part(first, end - first, room), met, counts);
    for (std::size_t i = 0; i < met.size(); ++i) {
      bool is_exhausted = false;
      if (met[i] == 0 && counts.exhausted > 0) {
        QueryCounts alone;
        world.occluded(rays[first + i], alone);
        is_exhausted = alone.exhausted > 0;
      }
      met[i] = met[i] != 0 ? MINKRAY_HIT : is_exhausted ? MINKRAY_EXHAUSTED : MINKRAY_MISS;
    }
  };
  work_on_groups(rays.size(),
                 gathered ? gathered_at_once : std::max(rays_a_part, world.rays_at_once()),
                 gathered, options, part);
  throw_if_lied(scene.customs());
}

/// Casts at one body: cast(ray) returns the result, without the object's number.
template <class Cast>
void cast_at_one(std::uint32_t object, const RaySource& rays, minkray_hit* hits,
                 const minkray_options* options, const Cast& cast) {
  work_on_rays(rays.size(), options, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Ray<double> ray = rays[i];
      WorldHit hit = cast(ray);
      if (hit.cast.found()) hit.instance = object;
      plain_hit(ray, hit, hit.cast.status == Status::exhausted, hits[i]);
    }
  });
}

WorldHit hit_of(const PartCast& met) {
  return {no_instance, met.cast, met.part};
}

/// An exit is not before the ray's origin.
WorldHit bounded_below(WorldHit exit) {
  if (exit.cast.status == Status::hit)
    exit.cast.offset_lo = std::max(exit.cast.offset_lo, -exit.cast.t_base);
  return exit;
}

}  // namespace
}  // namespace minkray

using namespace minkray;

extern "C" {

int minkray_scene_cast(minkray_scene scene, const minkray_ray* rays, size_t count,
                       minkray_hit* hits, const minkray_options* options) {
  return call("minkray_scene_cast", [&] {
    const SceneQuery held(scene);
    if (count > 0) require(hits, "hits");
    if (count == 1 && !options && held->customs().empty()) {
      const Ray<double> ray = ray_of(rays);
      QueryCounts counts;
      const WorldHit hit = held->world().closest_hit(ray, counts);
      plain_hit(ray, hit, counts.exhausted > 0, *hits);
      return;
    }
    struct {
      minkray_hit* hits;
      void operator()(size_t i, const Ray<double>& ray, const WorldHit& hit, bool exhausted) const {
        plain_hit(ray, hit, exhausted, hits[i]);
      }
      void operator()(size_t i, const Ray<double>& ray, const BlockHits& block, size_t k) const {
        plain_hit(ray, block, k, hits[i]);
      }
    } const tell{hits};
    cast_rays(*held, RaySource(rays, count), options, tell);
  });
}

int minkray_scene_cast_arrays(minkray_scene scene, const minkray_ray_arrays* rays, size_t count,
                              const minkray_hit_arrays* hits, const minkray_options* options) {
  return call("minkray_scene_cast_arrays", [&] {
    const SceneQuery held(scene);
    require(hits, "hits");
    if (hits->size < offsetof(minkray_hit_arrays, parts))
      wrong_use("hits.size: must be sizeof(minkray_hit_arrays)");
    struct {
      const minkray_hit_arrays& hits;
      void operator()(size_t i, const Ray<double>& ray, const WorldHit& hit, bool exhausted) const {
        store(hits, i, ray, plain_hit(ray, hit, exhausted));
      }
      void operator()(size_t i, const Ray<double>& ray, const BlockHits& block, size_t k) const {
        minkray_hit hit;
        plain_hit(ray, block, k, hit);
        store(hits, i, ray, hit);
      }
    } const tell{*hits};
    cast_rays(*held, RaySource(rays, count), options, tell);
  });
}

int minkray_scene_occluded(minkray_scene scene, const minkray_ray_arrays* rays, size_t count,
                           uint8_t* blocked, const minkray_options* options) {
  return call("minkray_scene_occluded", [&] {
    const SceneQuery held(scene);
    if (count > 0) require(blocked, "blocked");
    find_occluded(*held, RaySource(rays, count), blocked, options);
  });
}

int minkray_scene_occluded_rays(minkray_scene scene, const minkray_ray* rays, size_t count,
                                uint8_t* blocked, const minkray_options* options) {
  return call("minkray_scene_occluded_rays", [&] {
    const SceneQuery held(scene);
    if (count > 0) require(blocked, "blocked");
    if (count == 1 && !options && held->customs().empty()) {
      QueryCounts counts;
      const bool met = held->world().occluded(ray_of(rays), counts);
      *blocked = met ? MINKRAY_HIT : counts.exhausted > 0 ? MINKRAY_EXHAUSTED : MINKRAY_MISS;
      return;
    }
    find_occluded(*held, RaySource(rays, count), blocked, options);
  });
}

int minkray_scene_exit(minkray_scene scene, uint32_t object, const minkray_ray* rays, size_t count,
                       minkray_hit* hits, const minkray_options* options) {
  return call("minkray_scene_exit", [&] {
    const SceneQuery held(scene);
    if (count > 0) require(hits, "hits");
    const Instances& instances = held->world().instances();
    if (object >= instances.size())
      wrong_use("object: must be less than " + std::to_string(instances.size()) + " (got " +
                std::to_string(object) + ")");
    if (object < held->size()) held->check_object(object);
    if (instances.is_half_space(object))
      wrong_use("object: must not be a half-space, since rays never leave it");
    const RaySource source(rays, count);
    if (instances.is_mesh(object)) {
      const PosedMesh& mesh = instances.mesh_of(object);
      cast_at_one(object, source, hits, options,
                  [&](const Ray<double>& ray) { return hit_of(cast_last_exit(mesh, ray, 0)); });
      return;
    }
    if (instances.is_compound(object)) {
      const PosedCompound& compound = instances.compound_of(object);
      cast_at_one(object, source, hits, options, [&](const Ray<double>& ray) {
        QueryCounts counts;
        return bounded_below(hit_of(cast_last_exit(compound, ray, {}, counts)));
      });
      throw_if_lied(held->customs());
      return;
    }
    const PreparedShape& shape = instances.at(object);
    cast_at_one(object, source, hits, options, [&](const Ray<double>& ray) {
      return bounded_below({no_instance, cast_exit_within(shape, ray)});
    });
    throw_if_lied(held->customs());
  });
}

int minkray_shape_cast(minkray_shape shape, const minkray_pose* pose, const minkray_ray* rays,
                       size_t count, minkray_hit* hits, const minkray_options* options) {
  return call("minkray_shape_cast", [&] {
    const HeldShape& held = shape_of(shape, "shape");
    refuse_if_running(held.customs(), "shape");
    if (count > 0) require(hits, "hits");
    if (held.mesh()) {
      const PosedMesh posed(0, held.mesh(), pose_of(pose, "pose"));
      cast_at_one(0, RaySource(rays, count), hits, options, [&](const Ray<double>& ray) {
        PartCounts parts;
        return hit_of(cast_ray(posed, ray, ray.t_max, false, 0, parts));
      });
      return;
    }
    if (held.compound()) {
      const PosedCompound posed(0, held.compound(), pose_of(pose, "pose"));
      cast_at_one(0, RaySource(rays, count), hits, options, [&](const Ray<double>& ray) {
        QueryCounts counts;
        return hit_of(cast_ray(posed, ray, ray.t_max, false, 0, {}, counts));
      });
      throw_if_lied(held.customs());
      return;
    }
    if (count == 1 && !options && held.customs().empty()) {
      const Ray<double> ray = ray_of(rays);
      WorldHit hit{no_instance, pose && !is_identity(*pose)
                                    ? cast_ray(*held.definition(), pose_of(pose, "pose"), ray)
                                    : cast_ray(held.prepared(), ray)};
      if (hit.cast.found()) hit.instance = 0;
      plain_hit(ray, hit, hit.cast.status == Status::exhausted, *hits);
      return;
    }
    const PreparedShape prepared(held.definition(), pose_of(pose, "pose"));
    cast_at_one(0, RaySource(rays, count), hits, options, [&](const Ray<double>& ray) {
      return WorldHit{no_instance, cast_ray(prepared, ray)};
    });
    throw_if_lied(held.customs());
  });
}

}  // extern "C"
