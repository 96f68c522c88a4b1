// SPDX-License-Identifier: MIT
#include "core/bvh/traverse.h"
#include "core/world/ray_block.h"
#include "core/world/world.h"

namespace minkray {
namespace {

/// Of more planes, packets that walk over facets are sooner done than lanes that try them all.
constexpr std::size_t most_planes = 48;

}  // namespace

template <class T>
bool World<T>::closest_of_block(const Ray<T>* rays, std::size_t stride, std::size_t count,
                                BlockHits& hits, QueryCounts& counts) const {
  if constexpr (!std::is_same_v<T, double>) {
    return false;
  } else {
    if (!has_screen() || instances_.kind_of_all() == FormKind::none || bvh_.nodes.empty())
      return false;
    if (const auto& planes = instances_.screens()[0].planes; planes && planes->size() > 5 * most_planes)
      return false;
    BlockAnswer answer;
    const BlockWorld world{instances_.kind_of_all(), bvh_.nodes.data(), instances_.leaf_places(),
                           instances_.first_leaves(), instances_.screens()};
    const char* const first = reinterpret_cast<const char*>(rays);
    if (!look_at_block_avx2(world, first, stride, count, answer)) return false;
    counts.nodes += answer.nodes;
    hits.found = hits.alone = 0;
    for (std::size_t from = 0; from < count; from += 4) {
      FourPairs pairs;
      LaneBits lanes = 0;
      const LeafPlace<T>* some = nullptr;
      for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t leaf = answer.leaf[from + i];
        pairs.ray[i] = reinterpret_cast<const double*>(
            first + stride * (from + i < count ? from + i : from));
        if (leaf == no_leaf) {
          hits.instance[from + i] = no_instance;
          continue;
        }
        const LeafPlace<T>& place = world.places[leaf];
        hits.instance[from + i] = place.instance;
        pairs.centre[i] = place.centre;
        pairs.to_inner[i] = place.to_inner;
        if (!some) some = &place;
        if (place.definition == some->definition)
          lanes |= 1u << i;
        else
          hits.alone |= std::uint64_t{1} << (from + i);
      }
      if (lanes == 0) continue;
      if (lanes != 0xfu)
        for (std::size_t i = 0; i < 4; ++i)
          if (!(lanes >> i & 1u)) {
            pairs.centre[i] = some->centre;
            pairs.to_inner[i] = some->to_inner;
          }
      CastPacket<T>& casts = hits.casts[from / 4];
      cast_four_avx2(instances_.definition(some->definition), pairs, lanes, casts);
      const LaneBits found = casts.found();
      std::uint32_t late = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const bool is_late =
            !(casts.t(static_cast<int>(i)) <= static_cast<double>(answer.limit[from + i]));
        late |= (is_late ? 1u : 0u) << i;
      }
      hits.found |= std::uint64_t{found} << from;
      hits.alone |= std::uint64_t{(lanes & ~found) | (late & found)} << from;
    }
    const auto casts = static_cast<std::uint64_t>(std::popcount(hits.found));
    counts.casts += casts;
    counts.by_path[static_cast<std::size_t>(Path::filter)] += casts;
    for (std::size_t i = 0; i < answer.other_count; ++i)
      if (answer.others[i].first <= answer.limit[answer.others[i].ray])
        hits.alone |= std::uint64_t{1} << answer.others[i].ray;
    return true;
  }
}

template bool World<float>::closest_of_block(const Ray<float>*, std::size_t, std::size_t,
                                             BlockHits&, QueryCounts&) const;
template bool World<double>::closest_of_block(const Ray<double>*, std::size_t, std::size_t,
                                              BlockHits&, QueryCounts&) const;

}  // namespace minkray
