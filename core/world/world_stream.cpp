// SPDX-License-Identifier: MIT
// Traces incoherent rays: the BVH finds pairs of ray and instance, float lanes discard most of
// them, and the rest are cast.
#include <algorithm>

#include "core/world/pair_caster.h"
#include "core/world/pair_screen.h"
#include "core/world/world.h"

namespace minkray {
namespace {

/// Number of pairs without a closed form that are cast together. With more pairs, packets are
/// fuller, but fewer pairs are skipped because of nearer hits.
constexpr std::size_t formless_at_once = 128;

/// Number of pairs by which prefetching is ahead of casts.
constexpr std::size_t fetched_ahead = 16;

/// Finds the pairs of a ray and an instance that may hit, screens them and casts the rest.
/// on_sure(ray, last) is called for certain hits at t <= last, and returns true if the pair is to
/// be cast nevertheless. on_found is that of PairCaster. is_due(pair) returns true if the pair can
/// still change the result. Returns the rays with a cast that did not converge.
template <class OnSure, class OnFound, class IsDue>
std::vector<std::uint32_t> trace_stream(const World& world, FormKind kind_of_all,
                                        const RaySpan& rays, RayLimits& limits, QueryCounts& counts,
                                        const OnSure& on_sure, const OnFound& on_found,
                                        const IsDue& is_due) {
  const Instances& instances = world.instances();
  PairCaster<OnFound> caster(instances, world.options(), rays, counts, on_found);
  std::vector<OpenPair> open, formless;
  open.reserve(4 * rays.size());
  const auto on_open = [&](std::uint32_t ray, std::uint32_t instance, float from, float last,
                           bool is_sure) {
    if (is_sure) {
      if (on_sure(ray, last)) open.push_back({ray, instance, from});
    } else if (!is_formless(instances, instance)) {
      open.push_back({ray, instance, from});
    } else {
      formless.push_back({ray, instance, from});
      if (formless.size() >= formless_at_once) caster.cast_formless(formless, is_due);
    }
  };
  PairScreen<decltype(on_open)> screen(instances, kind_of_all, rays, limits, on_open);
  const auto visit = [](void* context, const std::uint32_t* of_pairs, const std::uint32_t* boxes,
                        std::size_t pairs) {
    static_cast<decltype(screen)*>(context)->take(of_pairs, boxes, pairs);
  };
  counts.nodes += walk_stream(world.bvh(), limits.slabs, {visit, &screen});
  screen.finish();
  caster.cast_formless(formless, is_due);
  std::erase_if(open, [&](const OpenPair& pair) { return !is_due(pair); });
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (i + fetched_ahead < open.size()) {
      instances.prefetch(open[i + fetched_ahead].instance);
      instances.prefetch_digits(open[i + fetched_ahead].instance);
    }
    if (is_due(open[i])) caster.add(open[i].ray, open[i].instance);
  }
  caster.finish();
  return caster.exhausted();
}

}  // namespace

void World::answer_stream(const RaySpan& rays, std::size_t first, HitReceiver& to,
                          QueryCounts& counts) const {
  std::vector<WorldHit> hits(rays.size(), WorldHit::miss());
  QueryCounts own;
  std::vector<std::uint8_t> is_alone(rays.size());  ///< 1: the ray is traced alone
  if (instances_.have_shapeless()) closest_shapeless(rays, hits, is_alone, own);
  RayLimits limits(rays);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (hits[i].found()) limits.lower(i, hits[i].cast.t());
  const auto on_sure = [&](std::uint32_t ray, float last) {
    if (last <= limits.t[ray]) {
      limits.lower(ray, static_cast<double>(last));
      limits.sure[ray] = 1;
    }
    return true;
  };
  const auto keep = [&](std::uint32_t ray, std::uint32_t instance, double t, const auto& result) {
    if (!hits[ray].yields_to(instance, t)) return;
    hits[ray] = {instance, instances_.turned(instance, result(), rays.time(ray))};
    limits.lower(ray, t);
  };
  const auto is_due = [&](const OpenPair& pair) { return pair.first <= limits.t[pair.ray]; };
  for (const std::uint32_t ray :
       trace_stream(*this, kind_of_all_, rays, limits, own, on_sure, keep, is_due))
    is_alone[ray] = 1;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool is_met = hits[i].found() && hits[i].cast.t() <= static_cast<double>(limits.t[i]);
    if (!is_alone[i] && (!limits.sure[i] || is_met)) {
      to.take(first + i, hits[i], false);
      continue;
    }
    // Traces the ray alone if a solver failed to converge or a certain hit was not confirmed.
    QueryCounts alone;
    const WorldHit hit = closest_hit(rays[i], alone);
    to.take(first + i, hit, alone.exhausted > 0);
    own += alone;
  }
  counts += own;
}

void World::occluded_in_stream(const RaySpan& rays, std::span<std::uint8_t> met,
                               QueryCounts& counts) const {
  std::ranges::fill(met, std::uint8_t{0});
  if (instances_.have_shapeless()) blocked_by_shapeless(rays, met, counts);
  if (bvh_.nodes.empty()) return;
  RayLimits limits(rays);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (met[i] != 0) limits.end(i);
  const auto end = [&](std::uint32_t ray) {
    met[ray] = 1;
    limits.end(ray);
  };
  const auto on_sure = [&](std::uint32_t ray, float) {
    end(ray);
    return false;
  };
  const auto on_found = [&](std::uint32_t ray, std::uint32_t, double, const auto&) { end(ray); };
  const auto is_due = [&](const OpenPair& pair) { return met[pair.ray] == 0; };
  trace_stream(*this, kind_of_all_, rays, limits, counts, on_sure, on_found, is_due);
}

}  // namespace minkray
