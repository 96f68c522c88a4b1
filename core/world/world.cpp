// SPDX-License-Identifier: MIT
#include "core/world/world.h"

#include <algorithm>
#include <utility>

#include "core/bvh/stream.h"
#include "core/bvh/traverse.h"
#include "core/world/single_ray.h"

namespace minkray {
namespace {

/// After a refit, the BVH is rebuilt if its expected visits per ray exceed this many times those
/// after its last build. Rebuilding 10,000 boxes takes as long as some ten thousand rays, so a
/// rebuild pays for any picture.
constexpr double most_visits_after_refit = 1.5;

/// Closed forms and packets require the default options.
bool are_default(const CastOptions& options) {
  const CastOptions standard;
  return options.solver == standard.solver && options.eps_tol == standard.eps_tol &&
         options.max_iterations == standard.max_iterations && options.v0 == standard.v0;
}

}  // namespace

World::World(Instances instances, const CastOptions& options, BvhBuild build)
    : instances_(std::move(instances)),
      build_(build),
      options_(options),
      is_default_(are_default(options)) {
  this->build(instances_.take_boxes());
}

void World::take_boxes_of_parts(const FirstTouchVector<Bounds<float>>& boxes) {
  const auto take = [&](const auto& bodies, std::vector<Bounds<float>>& taken) {
    taken.clear();
    for (const auto& body : bodies) taken.push_back(boxes[body.instance]);
  };
  take(instances_.meshes(), boxes_of_meshes_);
  take(instances_.compounds(), boxes_of_compounds_);
}

/// The BVH contains all shapes that a ray can hit first.
void World::build(const FirstTouchVector<Bounds<float>>& boxes) {
  kind_of_all_ = instances_.kind_of_all();
  repeated_ = repeated_instances(instances_);
  const RayKinds* const shown_to = instances_.shown_to();
  take_boxes_of_parts(boxes);
  mesh_boxes_ = build_bvh(boxes_of_meshes_, build_);
  compound_boxes_ = build_bvh(boxes_of_compounds_, build_);
  if (!instances_.have_shapeless() && repeated_.empty() && !shown_to) {
    bvh_ = build_bvh(boxes, build_);
    return;
  }
  std::vector<Bounds<float>> bounded;
  std::vector<std::uint32_t> number;
  auto left_out = repeated_.begin();
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (left_out != repeated_.end() && left_out->number == i) {
      ++left_out;
      continue;
    }
    if (!instances_.has_shape(i) || (shown_to && shown_to[i] == 0)) continue;
    bounded.push_back(boxes[i]);
    number.push_back(i);
  }
  std::ranges::sort(repeated_, {},
                    [](const RepeatedInstance& one) { return std::pair(one.same_as, one.number); });
  bvh_ = build_bvh(bounded, build_);
  for (BvhNode& node : bvh_.nodes)
    for (std::uint32_t& child : node.children)
      if (child != BvhNode::none && (child & BvhNode::leaf))
        child = BvhNode::leaf | number[child & ~BvhNode::leaf];
}

// Casts use the ray's own t_max rather than the nearest hit so far. Otherwise results, and the
// choice between hits, would depend on the order of the boxes.
void World::closer_hit(const WorldRay& ray, SlabRay& slabs, WorldHit& closest,
                       QueryCounts& counts) const {
  if (closer_shapeless(ray, closest, counts)) slabs.numbers.t_max = slabs.limit(closest.cast.t());
  auto on_instance = [&](std::uint32_t instance) {
    if (ray.passes(instances_, instance)) return false;
    const CastResult<double> result =
        cast_ray(instances_.at_seen_by(instance, ray.ray),
                 instances_.seen_by(instance, ray.ray, ray.time), options_);
    counts.add_cast(result);
    if (!result.found() || !closest.yields_to(instance, result.t())) return false;
    closest = {instance, instances_.turned(instance, result, ray.time)};
    slabs.numbers.t_max = slabs.limit(result.t());
    return false;
  };
  counts.nodes += traverse(bvh_, slabs, on_instance, prefetching());
}

WorldHit World::closest_hit(const WorldRay& ray, QueryCounts& counts) const {
  WorldHit closest = WorldHit::miss();
  if (bvh_.nodes.empty()) {
    closer_shapeless(ray, closest, counts);
  } else if (!closer_candidate(ray, closest, counts)) {
    SlabRay slabs(ray.ray);
    closer_hit(ray, slabs, closest, counts);
  }
  return closest;
}

CastResult<double> World::cast_at_rest(std::uint32_t instance, const Ray<double>& ray) const {
  Mat3<double> map;
  CastResult<double> result;
  if (cast_by_form(instances_.form_place(instance, map), ray, result)) return result;
  return cast_ray(instances_.at(instance), ray, options_);
}

bool World::closer_candidate(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const {
  if (!has_screen() || instances_.move() || bvh_.nodes.empty()) return false;
  SingleRay single = single_ray(ray);
  WorldHit found = WorldHit::miss();
  QueryCounts own;
  if (closer_shapeless(ray, found, own)) {
    single.limit = std::min(single.limit, detail::float_above(found.cast.t()));
    single.slabs.numbers.t_max = single.slabs.limit(found.cast.t());
  }
  if (!trace_single_avx2(single_world(), single)) return false;
  own.nodes += single.nodes;
  for (std::size_t i = 0; i < single.candidate_count; ++i) {
    const auto [instance, first] = single.candidates[i];
    if (!(first <= single.limit)) continue;
    const CastResult<double> result = cast_at_rest(instance, ray.ray);
    own.add_cast(result);
    if (result.found() && found.yields_to(instance, result.t())) found = {instance, result};
  }
  const bool is_met = found.found() && found.cast.t() <= static_cast<double>(single.limit);
  if (single.is_sure && !is_met)
    return false;  // a solver failed to converge: the hit is not certain
  closest = found;
  counts += own;
  return true;
}

bool World::occluded(const WorldRay& ray, QueryCounts& counts) const {
  if (blocked_by_shapeless(ray, counts)) return true;
  if (has_screen() && !instances_.move() && !bvh_.nodes.empty()) {
    SingleRay single = single_ray(ray);
    single.ends_if_sure = true;
    const bool is_complete = trace_single_avx2(single_world(), single);
    counts.nodes += single.nodes;
    if (single.is_sure) return true;
    if (is_complete) {
      for (std::size_t i = 0; i < single.candidate_count; ++i) {
        const CastResult<double> result = cast_at_rest(single.candidates[i].instance, ray.ray);
        counts.add_cast(result);
        if (result.found()) return true;
      }
      return false;
    }
  }
  bool met = false;
  auto on_instance = [&](std::uint32_t instance) {
    if (ray.passes(instances_, instance)) return false;
    const CastResult<double> result =
        cast_ray(instances_.at_seen_by(instance, ray.ray),
                 instances_.seen_by(instance, ray.ray, ray.time), options_);
    counts.add_cast(result);
    met = result.found();
    return met;
  };
  counts.nodes += traverse(bvh_, SlabRay(ray.ray), on_instance, prefetching());
  return met;
}

SingleRay World::single_ray(const WorldRay& ray) const {
  SingleRay single;
  single.ray = &ray.ray;
  make_slabs_avx2(reinterpret_cast<const char*>(&ray.ray), 0, 1, &single.slabs);
  single.skip = ray.skip;
  single.kinds = ray.kinds;
  single.limit = detail::float_above(ray.ray.t_max);
  return single;
}

SingleWorld World::single_world() const {
  return {bvh_.nodes.data(), instances_.places(), instances_.digits(), instances_.screens(),
          instances_.shown_to()};
}

bool World::has_screen() const {
  return is_default_ && has_avx2();
}

void World::pose_all(const std::function<Affine<double>(std::size_t)>& pose_of,
                     const std::function<Movement<double>(std::size_t)>& movement_of) {
  const auto visits = [&] {
    const VisitEstimate expected = expected_visits(bvh_);
    return expected.nodes + expected.leaves;
  };
  instances_.pose_all(pose_of, movement_of);
  kind_of_all_ = instances_.kind_of_all();
  const FirstTouchVector<Bounds<float>> boxes = instances_.take_boxes();
  if (visits_as_built_ == 0) visits_as_built_ = visits();
  if (!repeated_.empty()) {  // the instances may be at different poses now
    build(boxes);
    visits_as_built_ = visits();
    return;
  }
  refit(bvh_, boxes);
  take_boxes_of_parts(boxes);
  refit(mesh_boxes_, boxes_of_meshes_);
  refit(compound_boxes_, boxes_of_compounds_);
  if (visits() > most_visits_after_refit * visits_as_built_) {
    build(boxes);
    visits_as_built_ = visits();
  }
}

}  // namespace minkray
