// SPDX-License-Identifier: MIT
// The functions of the C interface that cast rays.
#include <algorithm>
#include <array>
#include <vector>

#include "renderer/library/call.h"
#include "renderer/library/held_scene.h"
#include "renderer/library/held_shape.h"
#include "renderer/library/poses.h"
#include "renderer/library/ray_source.h"
#include "renderer/library/work_on_rays.h"

namespace minkray {
namespace {

constexpr std::size_t at_once = most_rays_at_once;

/// Calls tell(i, ray, hit) for each ray. Those that go together are asked for together; if a solver
/// gave up for any of them, each is asked for again to know whose.
template <class Tell>
void cast_rays(const HeldScene& scene, const RaySource& rays, const minkray_options* options,
               Tell&& tell) {
  const RenderWorld& world = scene.world();
  const bool gathered = are_gathered(scene.customs());
  const auto one = [&](std::size_t i, const Ray<double>& ray) {
    QueryCounts counts;
    const WorldHit<double> hit = world.closest_hit(ray, counts);
    tell(i, ray, plain_hit(ray, hit, counts.exhausted > 0));
  };
  const auto others = [&](std::size_t first, std::size_t end) {
    const std::size_t count = end - first;
    if (count == 0) return;
    if (count == 1) return one(first, rays[first]);
    // Pieces of work that take turns on one thread each have room of their own.
    std::vector<WorldRay<double>> own_rays;
    std::vector<WorldHit<double>> own_hits;
    thread_local std::vector<WorldRay<double>> thread_rays(rays_a_part);
    thread_local std::vector<WorldHit<double>> thread_hits(rays_a_part);
    if (gathered) {
      own_rays.resize(count);
      own_hits.resize(count);
    }
    std::vector<WorldRay<double>>& asked = gathered ? own_rays : thread_rays;
    std::vector<WorldHit<double>>& hits = gathered ? own_hits : thread_hits;
    for (std::size_t i = 0; i < count; ++i) asked[i] = {rays[first + i]};
    QueryCounts counts;
    world.closest_hits_of_all(std::span(asked).first(count), std::span(hits).first(count), counts);
    for (std::size_t i = 0; i < count; ++i) {
      if (counts.exhausted > 0)
        one(first + i, asked[i].ray);
      else
        tell(first + i, asked[i].ray, plain_hit(asked[i].ray, hits[i], false));
    }
  };
  // Blocks of rays that run alike are read and answered where the caller has them.
  const auto group = [&](std::size_t first, std::size_t end) {
    std::size_t waiting = first;
    BlockHits hits;
    std::array<Ray<double>, rays_of_block> room;
    for (std::size_t at = first; !gathered && at < end; at += rays_of_block) {
      const std::size_t count = std::min(rays_of_block, end - at);
      if (count < at_once) break;
      const Ray<double>* const block = rays.in_a_row(at, count, room.data());
      QueryCounts counts;
      if (!world.closest_of_block(block, sizeof(Ray<double>), count, hits, counts)) continue;
      others(waiting, at);
      waiting = at + count;
      for (std::size_t i = 0; i < count; ++i) {
        if (hits.alone >> i & 1u)
          one(at + i, block[i]);
        else
          tell(at + i, block[i], hits, i);
      }
    }
    others(waiting, end);
  };
  work_on_groups(rays.size(), gathered ? at_once : rays_a_part, gathered, options, group);
  throw_if_lied(scene.customs());
}

void find_occluded(const HeldScene& scene, const RaySource& rays, std::uint8_t* blocked,
                   const minkray_options* options) {
  const RenderWorld& world = scene.world();
  const auto group = [&](std::size_t first, std::size_t end) {
    std::array<WorldRay<double>, at_once> asked;
    const std::size_t count = end - first;
    for (std::size_t i = 0; i < count; ++i) asked[i] = {rays[first + i]};
    QueryCounts counts;
    const RayGroupMask met = world.occluded(std::span(asked).first(count), counts);
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_met = (met >> i & 1u) != 0;
      bool gave_up = !is_met && counts.exhausted > 0;
      if (gave_up) {
        QueryCounts alone;
        world.occluded(asked[i].ray, alone);
        gave_up = alone.exhausted > 0;
      }
      blocked[first + i] = is_met ? MINKRAY_HIT : gave_up ? MINKRAY_EXHAUSTED : MINKRAY_MISS;
    }
  };
  work_on_groups(rays.size(), at_once, are_gathered(scene.customs()), options, group);
  throw_if_lied(scene.customs());
}

/// Casts at one shape, one way or the other.
template <class Cast>
void cast_at_one(const PreparedShape<double>& shape, std::uint32_t object, const RaySource& rays,
                 minkray_hit* hits, const minkray_options* options, Cast&& cast) {
  work_on_rays(rays.size(), options, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Ray<double> ray = rays[i];
      WorldHit<double> hit{no_instance, cast(shape, ray)};
      if (hit.cast.found()) hit.instance = object;
      hits[i] = plain_hit(ray, hit, hit.cast.status == Status::exhausted);
    }
  });
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
      const WorldHit<double> hit = held->world().closest_hit(ray, counts);
      plain_hit(ray, hit, counts.exhausted > 0, *hits);
      return;
    }
    struct {
      minkray_hit* hits;
      void operator()(size_t i, const Ray<double>&, const minkray_hit& hit) const { hits[i] = hit; }
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
    if (hits->size < sizeof(minkray_hit_arrays))
      wrong_use("hits.size: must be sizeof(minkray_hit_arrays)");
    struct {
      const minkray_hit_arrays& hits;
      void operator()(size_t i, const Ray<double>& ray, const minkray_hit& hit) const {
        store(hits, i, ray, hit);
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
    find_occluded(*held, RaySource(rays, count), blocked, options);
  });
}

int minkray_scene_exit(minkray_scene scene, uint32_t object, const minkray_ray* rays, size_t count,
                       minkray_hit* hits, const minkray_options* options) {
  return call("minkray_scene_exit", [&] {
    const SceneQuery held(scene);
    if (count > 0) require(hits, "hits");
    const Instances<double>& instances = held->world().instances();
    if (object >= instances.size())
      wrong_use("object: must be less than " + std::to_string(instances.size()) + " (got " +
                std::to_string(object) + ")");
    if (object < held->plain().objects.size()) held->object(object);
    if (instances.is_half_space(object))
      wrong_use("object: must not be a half-space, which rays never leave");
    cast_at_one(instances.at(object), object, RaySource(rays, count), hits, options,
                [](const PreparedShape<double>& shape, const Ray<double>& ray) {
                  return cast_exit(shape, ray);
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
    if (count == 1 && !options && held.customs().empty()) {
      const Ray<double> ray = ray_of(rays);
      const auto cast = [&] {
        if (!pose || is_identity(*pose)) return cast_ray(held.prepared(), ray);
        // Nothing is counted: the handle's owner keeps the definition.
        const ShapeDefinition<double>& definition = *held.definition();
        const auto placement = definition.placed(pose_of(pose, "pose"));
        return cast_ray(
            PreparedShape<double>(definition, placement.centre,
                                  placement.is_rigid_identity ? nullptr : &placement.to_inner),
            ray);
      };
      WorldHit<double> hit{no_instance, cast()};
      if (hit.cast.found()) hit.instance = 0;
      plain_hit(ray, hit, hit.cast.status == Status::exhausted, *hits);
      return;
    }
    const PreparedShape<double> prepared(held.definition(), pose_of(pose, "pose"));
    cast_at_one(prepared, 0, RaySource(rays, count), hits, options,
                [](const PreparedShape<double>& one, const Ray<double>& ray) {
                  return cast_ray(one, ray);
                });
    throw_if_lied(held.customs());
  });
}

}  // extern "C"
