// SPDX-License-Identifier: MIT
// Judges of a world's answers: one instance after the other without a hierarchy, and rays together
// against the same rays alone, bit for bit.
#pragma once

#include <gtest/gtest.h>

#include "core/world/world.h"

namespace minkray::testing {

inline ::testing::AssertionResult same(const WorldHit& a, const WorldHit& b) {
  const CastResult<double>&x = a.cast, &y = b.cast;
  if (a.instance != b.instance || a.part != b.part)
    return ::testing::AssertionFailure()
           << a.instance << " and " << b.instance << " at " << x.t() << " and " << y.t();
  if (x.status != y.status) return ::testing::AssertionFailure() << "status";
  if (!a.found()) return ::testing::AssertionSuccess();
  if (x.t_base != y.t_base || x.t_offset != y.t_offset || x.offset_lo != y.offset_lo ||
      x.offset_hi != y.offset_hi)
    return ::testing::AssertionFailure() << "t " << x.t() << " and " << y.t();
  if (x.normal != y.normal) return ::testing::AssertionFailure() << "normal";
  return ::testing::AssertionSuccess();
}

/// First hit of all instances that are shown to the ray, each by itself.
inline WorldHit first_of_all(const World& world, const WorldRay& ray) {
  const Instances& instances = world.instances();
  WorldHit first = WorldHit::miss();
  for (std::uint32_t i = 0; i < instances.size(); ++i) {
    if (i == ray.skip || !instances.is_shown_to(i, ray.kinds)) continue;
    PartCast met;
    PartCounts parts;
    if (instances.is_half_space(i)) {
      for (const auto& one : instances.half_spaces())
        if (one.instance == i) met.cast = cast_ray(one.in_world, ray.ray);
    } else if (instances.is_mesh(i)) {
      met = cast_ray(instances.mesh_of(i), ray.ray, ray.ray.t_max, false, 0, parts);
    } else {
      met.cast = cast_ray(instances.at(i), ray.ray);
    }
    if (met.cast.found() && first.yields_to(i, met.cast.t())) first = {i, met.cast, met.part};
  }
  return first;
}

/// Rays together against the same rays alone.
struct Compared {
  std::size_t rays = 0, hits = 0;
  QueryCounts alone, together;

  void with_single_rays(const World& world, std::span<const WorldRay> batch) {
    std::vector<WorldHit> answers(batch.size());
    std::vector<std::uint8_t> met(batch.size());
    world.closest_hits(batch, answers, together);
    world.occluded(batch, met, together);
    for (std::size_t i = 0; i < batch.size(); ++i, ++rays) {
      const std::size_t exhausted = alone.exhausted;
      const WorldHit hit = world.closest_hit(batch[i], alone);
      ASSERT_TRUE(same(answers[i], hit)) << "ray " << i << " of " << batch.size();
      ASSERT_EQ(met[i] != 0, world.occluded(batch[i], alone)) << i;
      if (alone.exhausted == exhausted) {
        ASSERT_EQ(met[i] != 0, hit.found()) << i;
      }
      hits += hit.found();
    }
  }
  /// The part of the rays that hit something.
  void expect_parts(double least, double most) const {
    EXPECT_GT(static_cast<double>(hits), least * static_cast<double>(rays));
    EXPECT_LT(static_cast<double>(hits), most * static_cast<double>(rays));
    EXPECT_EQ(together.exhausted, alone.exhausted);
  }
};

}  // namespace minkray::testing
