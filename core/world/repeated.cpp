// SPDX-License-Identifier: MIT
#include "core/world/repeated.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

namespace minkray {
namespace {

/// Returns a hash that is the same for equal instances.
std::uint64_t hash_of(const Instances& instances, std::uint32_t i) {
  const InstancePlace& place = instances.places()[i];
  std::uint64_t hash = place.body;
  const auto add = [&](std::uint64_t bits) { hash = (hash ^ bits) * 0x9e3779b97f4a7c15u; };
  for (const double x : place.origin) add(std::bit_cast<std::uint64_t>(x));
  for (const float x : place.to_inner) add(std::bit_cast<std::uint32_t>(x));
  if (instances.digits() != nullptr)
    for (const std::int32_t x : instances.digits()[i].of) add(static_cast<std::uint32_t>(x));
  return hash ^ hash >> 32;
}

}  // namespace

std::vector<RepeatedInstance> repeated_instances(const Instances& instances) {
  std::vector<RepeatedInstance> repeated;
  const auto count = static_cast<std::uint32_t>(instances.size());
  if (instances.move() || count < 3) return repeated;
  // Most worlds have no repeated instances. A small table indexed by hash shows this quickly.
  const std::uint64_t slots = std::bit_ceil(std::uint64_t(4) * count);
  std::vector<std::uint8_t> seen(slots);
  const auto slot_of = [&](std::uint32_t i) { return hash_of(instances, i) & (slots - 1); };
  bool has_many = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint8_t& here = seen[slot_of(i)];
    if (here < 3) ++here;
    has_many |= here == 3;
  }
  if (!has_many) return repeated;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> kept;  ///< by hash
  for (std::uint32_t i = 0; i < count; ++i) {
    if (seen[slot_of(i)] < 3 || !instances.has_shape(i)) continue;
    std::vector<std::uint32_t>& same_hash = kept[hash_of(instances, i)];
    const auto is_same = [&](std::uint32_t other) { return instances.are_same(i, other); };
    if (std::count_if(same_hash.begin(), same_hash.end(), is_same) < 2)
      same_hash.push_back(i);
    else
      repeated.push_back({i, *std::find_if(same_hash.begin(), same_hash.end(), is_same)});
  }
  return repeated;
}

}  // namespace minkray
