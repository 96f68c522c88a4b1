// SPDX-License-Identifier: MIT
// Chooses how rays are traced: neighbouring rays with similar directions as blocks, others as a
// stream, few rays one by one.
#include <algorithm>

#include "core/bvh/group_walk.h"
#include "core/world/ray_block.h"
#include "core/world/world.h"

namespace minkray {
namespace {

/// Least number of rays for a stream or a block; fewer are faster one by one.
constexpr std::size_t least_stream = 4, least_block = 16;

/// Limits of the number of rays that are cast together in a world of half-spaces and meshes, and
/// the number per mesh between these limits.
constexpr std::size_t least_at_meshes = 512, most_at_meshes = 8192, rays_per_mesh = 160;

/// True if the rays may form a block.
bool may_be_block(const RaySpan& rays) {
  return are_alike(rays.ray(0), rays.ray(rays.size() - 1), 0.5);
}

class Into : public HitReceiver {
 public:
  explicit Into(std::span<WorldHit> hits) : hits_(hits) {}
  void take(std::size_t ray, const WorldHit& hit, bool) override { hits_[ray] = hit; }
  void take(std::size_t first, std::uint64_t which, const BlockHits& block) override {
    for (; which != 0; which &= which - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(which));
      if (block.found >> i & 1u)
        hits_[first + i] = {block.instance[i], block.casts[i / 4].result(static_cast<int>(i % 4))};
      else
        hits_[first + i] = WorldHit::miss();
    }
  }

 private:
  std::span<WorldHit> hits_;
};

}  // namespace

void World::closest_hits(const RaySpan& rays, HitReceiver& to, QueryCounts& counts) const {
  if (!has_screen() || rays.size() < least_stream) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      QueryCounts own;
      const WorldHit hit = closest_hit(rays[i], own);
      to.take(i, hit, own.exhausted > 0);
      counts += own;
    }
    return;
  }
  if (bvh_.nodes.empty()) {
    answer_shapeless(rays, to, counts);
    return;
  }
  std::size_t waiting = 0;  ///< rays from here on wait for a stream
  const auto stream_up_to = [&](std::size_t end) {
    for (; waiting < end; waiting += std::min(rays_of_stream, end - waiting))
      answer_stream(rays.part(waiting, std::min(rays_of_stream, end - waiting)), waiting, to,
                    counts);
  };
  for (std::size_t first = 0; first < rays.size(); first += rays_of_block) {
    const std::size_t count = std::min(rays_of_block, rays.size() - first);
    const RaySpan part = rays.part(first, count);
    if (count < least_block || !may_be_block(part)) continue;
    if (!answer_block(part, first, to, counts)) continue;
    stream_up_to(first);
    waiting = first + count;
  }
  stream_up_to(rays.size());
}

std::size_t World::rays_at_once() const {
  if (!bvh_.nodes.empty()) return rays_of_stream;
  return std::clamp(rays_per_mesh * instances_.meshes().size(), least_at_meshes, most_at_meshes);
}

void World::answer_shapeless(const RaySpan& rays, HitReceiver& to, QueryCounts& counts) const {
  const std::size_t at_once = rays_at_once();
  std::vector<WorldHit> hits(std::min(rays.size(), at_once));
  std::vector<std::uint8_t> is_exhausted(hits.size());
  for (std::size_t first = 0; first < rays.size(); first += at_once) {
    const std::size_t count = std::min(at_once, rays.size() - first);
    const std::span closest(hits.data(), count);
    std::ranges::fill(closest, WorldHit::miss());
    closest_shapeless(rays.part(first, count), closest, is_exhausted, counts);
    for (std::size_t i = 0; i < count; ++i) to.take(first + i, hits[i], is_exhausted[i] != 0);
  }
}

void World::closest_hits(std::span<const WorldRay> rays, std::span<WorldHit> hits,
                         QueryCounts& counts) const {
  Into into(hits);
  closest_hits(RaySpan(rays), into, counts);
}

void World::occluded(const RaySpan& rays, std::span<std::uint8_t> met, QueryCounts& counts) const {
  if (!has_screen() || rays.size() < least_stream) {
    for (std::size_t i = 0; i < rays.size(); ++i) met[i] = occluded(rays[i], counts) ? 1 : 0;
    return;
  }
  const std::size_t at_once = rays_at_once();
  for (std::size_t first = 0; first < rays.size(); first += at_once) {
    const std::size_t count = std::min(at_once, rays.size() - first);
    occluded_in_stream(rays.part(first, count), met.subspan(first, count), counts);
  }
}

}  // namespace minkray
