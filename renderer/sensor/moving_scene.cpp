// SPDX-License-Identifier: MIT
#include "renderer/sensor/moving_scene.h"

#include <algorithm>
#include <cmath>

#include "core/bvh/traverse.h"
#include "renderer/scene/add_instances.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

/// Relative margin of boxes: of their size, their distance from the origin, and the swept way.
/// Covers some hundred roundings of double; floats cannot represent a smaller share.
constexpr double box_slack = 1e-7;

/// Upper bound of a body's motion from `begin` to `end`, for points up to `reach` from the point
/// that the keys move: positions move on lines, and a turn moves a point by at most the arc.
double longest_way(const Motion& motion, double begin, double end, double reach) {
  double way = 0;
  const auto add = [&](const PoseKey& a, const PoseKey& b, double fraction) {
    double cosine = 0, straight = 0;
    for (std::size_t i = 0; i < 4; ++i) cosine += a.rotate[i] * b.rotate[i];
    const double sign = cosine < 0 ? -1 : 1;
    for (std::size_t i = 0; i < 4; ++i)
      straight += (a.rotate[i] - sign * b.rotate[i]) * (a.rotate[i] - sign * b.rotate[i]);
    const double angle = 4 * std::asin(std::min(1.0, std::sqrt(straight) / 2));
    way += fraction * ((b.translate - a.translate).norm() + reach * angle);
  };
  for (std::size_t k = 1; k < motion.keys.size(); ++k) {
    const PoseKey &a = motion.keys[k - 1], &b = motion.keys[k];
    const double share = (std::min(end, b.time) - std::max(begin, a.time)) / (b.time - a.time);
    if (share > 0) add(a, b, std::min(share, 1.0));
  }
  return way;
}

/// Box that contains the body during the whole interval.
Bounds<float> swept_box(const ShapeDefinition& shape, const Motion& motion, double begin,
                        double end) {
  Bounds<double> box = shape.bounds_of(motion.pose_at(begin));
  const Vec3<double> pivot = motion.translation_at(begin);
  const Vec3<double> farthest =
      (box.lower - pivot).cwiseAbs().cwiseMax((box.upper - pivot).cwiseAbs());
  const double size = box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).maxCoeff();
  const double way = longest_way(motion, begin, end, farthest.norm());
  const double more = way + box_slack * (way + size);
  box.lower.array() -= more;
  box.upper.array() += more;
  return rounded_outwards(box);
}

/// A mesh that moves, at its pose at `time`.
PosedMesh posed_at(const Object& body, double time) {
  return {0, body.mesh, body.motion->pose_at(time)};
}

bool is_for_no_ray(const Object& object) {
  return object.visible_to == 0;
}

}  // namespace

MovingScene::MovingScene(const Scene& scene) : scene_(scene) {
  Instances instances;
  instances.reserve(instance_count(scene));
  const bool has_movers = minkray::moves(scene);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (object.motion) {
      place_.push_back(static_cast<std::uint32_t>(movers_.size()));
      movers_.push_back(
          {static_cast<std::uint32_t>(i),
           !object.has_shape() ? nullptr : std::make_shared<const ShapeDefinition>(object.shape)});
      continue;
    }
    place_.push_back(static_cast<std::uint32_t>(instances.size()));
    if (has_movers) object_of_still_.push_back(static_cast<std::uint32_t>(i));
    add_object(instances, object);
  }
  add_particles(instances, scene);
  // Particles are numbered after all objects.
  if (has_movers)
    for (std::size_t i = object_of_still_.size(); i < instances.size(); ++i)
      object_of_still_.push_back(static_cast<std::uint32_t>(i + movers_.size()));
  // Sensors see what a picture hides, but not what no ray meets: robots' parts of alpha 0.
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (is_for_no_ray(scene.objects[i]) && !scene.objects[i].motion)
      instances.show_to(place_[i], 0);
  still_ = World(std::move(instances));
}

SceneWhile::SceneWhile(const MovingScene& scene, double begin, double end) : scene_(scene) {
  std::vector<Bounds<float>> boxes;
  for (std::size_t i = 0; i < scene.movers_.size(); ++i) {
    const MovingScene::Mover& mover = scene.movers_[i];
    if (is_for_no_ray(scene.scene_.objects[mover.object])) continue;
    if (!mover.definition) {
      shapeless_.push_back(static_cast<std::uint32_t>(i));
      continue;
    }
    bodies_.push_back(static_cast<std::uint32_t>(i));
    boxes.push_back(
        swept_box(*mover.definition, *scene.scene_.objects[mover.object].motion, begin, end));
  }
  if (!boxes.empty()) bvh_ = build_bvh(boxes, BvhBuild::speed);
  placed_.resize(scene.movers_.size());
}

bool SceneWhile::moves(std::uint32_t instance) const {
  const std::vector<Object>& objects = scene_.scene_.objects;
  return instance < objects.size() && objects[instance].motion.has_value();
}

bool SceneWhile::is_half_space(std::uint32_t instance) const {
  const std::vector<Object>& objects = scene_.scene_.objects;
  return instance < objects.size() && objects[instance].half_space.has_value();
}

PreparedShape SceneWhile::mover_at(std::size_t mover, double time) {
  const ShapeDefinition& definition = *scene_.movers_[mover].definition;
  Placed& placed = placed_[mover];
  if (!placed.is_known || placed.time != time) {
    const Object& object = scene_.scene_.objects[scene_.movers_[mover].object];
    placed = {time, true, definition.placed(object.motion->pose_at(time))};
  }
  return {definition, placed.placement};
}

/// Updates the closest hit so far, if any, with nearer hits of moving bodies, in the same way as a
/// world.
void SceneWhile::meet_movers(const WorldRay& ray, double time, WorldHit& closest,
                             QueryCounts& counts) {
  const auto meet = [&](std::uint32_t object, const CastResult<double>& result) {
    counts.add_cast(result);
    if (!result.found() || !closest.yields_to(object, result.t())) return false;
    closest = {object, result};
    return true;
  };
  for (const std::uint32_t mover : shapeless_) {
    const std::uint32_t object = scene_.movers_[mover].object;
    const Object& body = scene_.scene_.objects[object];
    if (body.half_space) {
      if (object != ray.skip)
        meet(object, cast_ray(body.half_space->posed(body.motion->pose_at(time)), ray.ray));
      continue;
    }
    const double most =
        closest.found() ? closest.cast.t() : std::numeric_limits<double>::infinity();
    PartCounts parts;
    const PartCast met =
        cast_ray(posed_at(body, time), ray.ray, most, object == ray.skip, 0, parts);
    counts.add_parts(parts);
    if (meet(object, met.cast)) closest.part = met.part;
  }
  if (bodies_.empty()) return;
  SlabRay slabs(ray.ray);
  if (closest.found()) slabs.numbers.t_max = slabs.limit(closest.cast.t());
  counts.nodes += traverse(bvh_, slabs, [&](std::uint32_t body) {
    const std::uint32_t mover = bodies_[body];
    const std::uint32_t object = scene_.movers_[mover].object;
    if (object == ray.skip) return false;
    if (meet(object, cast_ray(mover_at(mover, time), ray.ray)))
      slabs.numbers.t_max = slabs.limit(closest.cast.t());
    return false;
  });
}

void SceneWhile::closest_hits(std::span<const WorldRay> rays, std::span<const double> times,
                              std::span<WorldHit> hits, QueryCounts& counts) {
  scene_.still_.closest_hits(rays, hits, counts);
  if (scene_.movers_.empty()) return;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].found()) hits[i].instance = scene_.object_of_still_[hits[i].instance];
    meet_movers(rays[i], times[i], hits[i], counts);
  }
}

WorldHit SceneWhile::closest_hit(const WorldRay& ray, double time, QueryCounts& counts) {
  const bool all_still = scene_.movers_.empty();
  std::uint32_t skip = ray.skip;
  if (skip != no_instance) skip = moves(skip) ? no_instance : scene_.still_number(skip);
  WorldHit closest = scene_.still_.closest_hit(ray.ray, counts, skip);
  if (all_still) return closest;
  if (closest.found()) closest.instance = scene_.object_of_still_[closest.instance];
  meet_movers(ray, time, closest, counts);
  return closest;
}

CastResult<double> SceneWhile::exit(std::uint32_t instance, const Ray<double>& ray, double time) {
  const Instances& still = scene_.still_.instances();
  if (moves(instance)) {
    const Object& body = scene_.scene_.objects[instance];
    if (body.mesh) return cast_exit(posed_at(body, time), ray);
    return cast_exit(mover_at(scene_.place_[instance], time), ray);
  }
  const std::uint32_t number = scene_.still_number(instance);
  if (still.is_mesh(number)) return cast_exit(still.mesh_of(number), ray);
  if (still.is_compound(number)) {
    QueryCounts counts;
    return cast_last_exit(still.compound_of(number), ray, {}, counts).cast;
  }
  return cast_exit(still.at(number), ray);
}

}  // namespace minkray
