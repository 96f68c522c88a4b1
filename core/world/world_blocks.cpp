// SPDX-License-Identifier: MIT
#include "core/bvh/traverse.h"
#include "core/world/pair_caster.h"
#include "core/world/ray_block.h"
#include "core/world/world.h"

namespace minkray {
namespace {

/// Casts rays at the instances that lanes found, four at a time. Returns the bits of rays whose
/// cast the closed form leaves in doubt, or whose hit is beyond the limit.
class BlockCaster {
 public:
  BlockCaster(const Instances& instances, const RaySpan& rays, const BlockAnswer& answer,
              BlockHits& hits)
      : instances_(instances), rays_(rays), answer_(answer), hits_(hits) {}

  std::uint64_t cast_all() {
    for (std::size_t i = 0; i < rays_.size(); ++i)
      if (answer_.instance[i] != no_instance) instances_.prefetch_digits(answer_.instance[i]);
    hits_.found = 0;
    std::uint64_t undecided = 0;
    for (std::size_t from = 0; from < rays_.size(); from += 4) undecided |= cast_four(from);
    return undecided;
  }

 private:
  std::uint64_t cast_four(std::size_t from) {
    FourPairs pairs;
    LaneBits lanes = 0;
    std::uint64_t others = 0;
    std::uint32_t some = no_instance;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t instance = answer_.instance[from + i];
      hits_.instance[from + i] = instance;
      const std::size_t ray = from + i < rays_.size() ? from + i : from;
      pairs.ray[i] = reinterpret_cast<const double*>(rays_.data() + rays_.stride() * ray);
      if (instance == no_instance) continue;
      if (some == no_instance) some = instance;
      if (instances_.places()[instance].body == instances_.places()[some].body)
        lanes |= 1u << i;
      else
        others |= std::uint64_t{1} << (from + i);
    }
    if (lanes == 0) return others;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t instance = lanes >> i & 1u ? answer_.instance[from + i] : some;
      pairs.place[i] = instances_.places() + instance;
      pairs.digits[i] = instances_.digits() ? instances_.digits() + instance : nullptr;
    }
    CastPacket& casts = hits_.casts[from / 4];
    cast_four_avx2(instances_.body_of(some), pairs, lanes, casts);
    LaneBits found = casts.found();
    for (std::size_t i = 0; i < 4; ++i)
      if (!(casts.t(static_cast<int>(i)) <= static_cast<double>(answer_.limit[from + i])))
        found &= ~(1u << i);
    hits_.found |= std::uint64_t{found} << from;
    return others | std::uint64_t{lanes & ~found} << from;
  }

  const Instances& instances_;
  const RaySpan& rays_;
  const BlockAnswer& answer_;
  BlockHits& hits_;
};

}  // namespace

bool World::answer_block(const RaySpan& rays, std::size_t first, HitReceiver& to,
                         QueryCounts& counts) const {
  if (instances_.move() || bvh_.nodes.empty()) return false;
  const RayKinds kinds = rays.kinds(0);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (rays.skip(i) != no_instance || rays.kinds(i) != kinds) return false;
  const bool has_shapeless = instances_.have_shapeless();
  std::array<WorldHit, rays_of_block> shapeless;  ///< hits of half-spaces and meshes
  std::array<float, rays_of_block> limits;
  QueryCounts of_shapeless;
  std::uint64_t exhausted = 0;
  if (has_shapeless) {
    std::array<std::uint8_t, rays_of_block> is_exhausted;
    closest_shapeless(rays, shapeless, is_exhausted, of_shapeless);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      limits[i] = shapeless[i].found() ? detail::float_above(shapeless[i].cast.t())
                                       : std::numeric_limits<float>::infinity();
      exhausted |= std::uint64_t{is_exhausted[i] != 0} << i;
    }
  }
  BlockAnswer answer;
  const BlockWorld world{bvh_.nodes.data(), instances_.places(), instances_.screens(),
                         instances_.shown_to()};
  if (!trace_block_avx2(world, rays.data(), rays.stride(), rays.size(), kinds,
                        has_shapeless ? limits.data() : nullptr, answer))
    return false;
  counts += of_shapeless;
  counts.nodes += answer.nodes;
  BlockHits hits;
  const std::uint64_t undecided = BlockCaster(instances_, rays, answer, hits).cast_all();
  counts.add_filtered(static_cast<std::uint64_t>(std::popcount(hits.found)));

  // Rays that need several casts, or another cast.
  std::uint64_t special = undecided;
  for (std::size_t i = 0; i < answer.other_count; ++i)
    if (answer.others[i].first <= answer.limit[answer.others[i].ray])
      special |= std::uint64_t{1} << answer.others[i].ray;
  const std::uint64_t all =
      rays.size() == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << rays.size()) - 1;
  if (has_shapeless)
    for (std::size_t i = 0; i < rays.size(); ++i)
      special |= std::uint64_t{shapeless[i].found() || (exhausted >> i & 1u)} << i;
  to.take(first, all & ~special, hits);
  if (special == 0) return true;

  std::array<WorldHit, rays_of_block> closest;
  const auto cast_at = [&](std::size_t ray, std::uint32_t instance) {
    const CastResult<double> result = cast_ray(instances_.at(instance), rays.ray(ray), options_);
    counts.add_cast(result);
    if (result.status == Status::exhausted) exhausted |= std::uint64_t{1} << ray;
    if (result.found() && closest[ray].yields_to(instance, result.t()))
      closest[ray] = {instance, result};
  };
  for (std::uint64_t left = special; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    closest[i] = has_shapeless && shapeless[i].found() ? shapeless[i] : WorldHit::miss();
    if (hits.found >> i & 1u) {
      const CastResult<double> result = hits.casts[i / 4].result(static_cast<int>(i % 4));
      if (closest[i].yields_to(hits.instance[i], result.t()))
        closest[i] = {hits.instance[i], result};
    } else if (undecided >> i & 1u) {
      cast_at(i, hits.instance[i]);
    }
  }
  const auto is_due = [&](const auto& pair) {
    return pair.first <= answer.limit[pair.ray] &&
           !(closest[pair.ray].found() &&
             closest[pair.ray].cast.t() < static_cast<double>(pair.first));
  };
  std::vector<OpenPair> formless;
  for (std::size_t i = 0; i < answer.other_count; ++i) {
    const BlockAnswer::Other& other = answer.others[i];
    if (!is_due(other)) continue;
    if (is_formless(instances_, other.instance))
      formless.push_back({other.ray, other.instance, other.first});
    else
      cast_at(other.ray, other.instance);
  }
  const auto keep = [&](std::uint32_t ray, std::uint32_t instance, double t, const auto& result) {
    if (closest[ray].yields_to(instance, t)) closest[ray] = {instance, result()};
  };
  PairCaster<decltype(keep)> caster(instances_, options_, rays, counts, keep);
  caster.cast_formless(formless, is_due);
  for (const std::uint32_t ray : caster.exhausted()) exhausted |= std::uint64_t{1} << ray;
  for (std::uint64_t left = special; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    // Traces the ray alone if a certain hit was not confirmed, or a solver failed to converge.
    const bool is_sure = hits.instance[i] != no_instance;
    const bool is_met =
        closest[i].found() && closest[i].cast.t() <= static_cast<double>(answer.limit[i]);
    bool is_exhausted = (exhausted >> i & 1u) != 0;
    if (is_exhausted || (is_sure && !is_met)) {
      QueryCounts own;
      closest[i] = closest_hit(rays[i], own);
      is_exhausted = own.exhausted > 0;
      counts += own;
    }
    to.take(first + i, closest[i], is_exhausted);
  }
  return true;
}

}  // namespace minkray
