// SPDX-License-Identifier: MIT
// C interface: all hits of rays.
#include <map>
#include <mutex>
#include <vector>

#include "renderer/library/handles/call.h"
#include "renderer/library/handles/held_scene.h"
#include "renderer/library/handles/ray_source.h"
#include "renderer/library/handles/work_on_rays.h"

namespace minkray {
namespace {

/// Rays of a call that waits for others' support points.
constexpr std::size_t all_hits_gathered_at_once = 32;

minkray_crossing plain_crossing(const WorldCrossing& found) {
  minkray_crossing plain = {};
  plain.t = found.t;
  plain.t_lo = found.t_lo;
  plain.t_hi = found.t_hi;
  for (int k = 0; k < 3; ++k) {
    plain.point[k] = found.point[k];
    plain.normal[k] = found.normal[k];
  }
  plain.object = found.instance;
  plain.part = static_cast<std::int32_t>(found.part);
  plain.leaves = found.leaves ? 1 : 0;
  return plain;
}

/// Hits of many rays, one list for all.
struct AllHits {
  std::vector<std::size_t> offsets;
  std::vector<minkray_crossing> hits;
  std::vector<std::uint8_t> status;
};

AllHits all_hits_of(const HeldScene& scene, const RaySource& rays, const minkray_options* options) {
  const World& world = scene.world();
  AllHits all;
  all.offsets.resize(rays.size() + 1);
  all.status.resize(rays.size());
  std::mutex mutex;
  std::map<std::size_t, std::vector<minkray_crossing>> of_parts;  // by their first rays
  const auto part = [&](std::size_t first, std::size_t end) {
    std::vector<minkray_crossing> plain;
    std::vector<WorldCrossing> found;
    for (std::size_t i = first; i < end; ++i) {
      found.clear();
      QueryCounts counts;
      world.all_hits({rays[i]}, found, counts);
      for (const WorldCrossing& one : found) plain.push_back(plain_crossing(one));
      all.offsets[i + 1] = found.size();
      all.status[i] = counts.exhausted > 0 ? MINKRAY_EXHAUSTED
                      : found.empty()      ? MINKRAY_MISS
                                           : MINKRAY_HIT;
    }
    const std::lock_guard lock(mutex);
    of_parts.emplace(first, std::move(plain));
  };
  const bool gathered = are_gathered(scene.customs());
  work_on_groups(rays.size(), gathered ? all_hits_gathered_at_once : rays_a_part, gathered, options,
                 part);
  for (std::size_t i = 0; i < rays.size(); ++i) all.offsets[i + 1] += all.offsets[i];
  all.hits.reserve(all.offsets.back());
  for (auto& [first, hits] : of_parts) {
    all.hits.insert(all.hits.end(), hits.begin(), hits.end());
    hits = {};
  }
  return all;
}

}  // namespace
}  // namespace minkray

using namespace minkray;

extern "C" {

int minkray_scene_all_hits(minkray_scene scene, const minkray_ray_arrays* rays, size_t count,
                           minkray_take_all_hits take, void* user, const minkray_options* options) {
  return call("minkray_scene_all_hits", [&] {
    const SceneQuery held(scene);
    if (!take) wrong_null("take");
    const AllHits all = all_hits_of(*held, RaySource(rays, count), options);
    throw_if_lied(held->customs());
    const minkray_all_hits found = {sizeof found, count, all.offsets.data(), all.hits.data(),
                                    all.status.data()};
    if (take(user, &found) != 0) throw CallError(MINKRAY_STOPPED, "stopped by the caller");
  });
}

}  // extern "C"
