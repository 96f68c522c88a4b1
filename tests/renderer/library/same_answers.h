// SPDX-License-Identifier: MIT
// A shape of ours and one that is given by functions, cast at with the same rays.
#pragma once

#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <vector>

#include "tests/renderer/library/rays.h"

/// Answers of both agree: the intervals of hits meet, and statuses are equal but for rays that just
/// touch. Every answer is certified.
inline void expect_same_answers(const minkray::Shape& ours, const minkray::Shape& custom,
                                double size, std::size_t count) {
  minkray::Scene a, b;
  a.add(ours, minkray::translation({1, 2, 3}));
  b.add(custom, minkray::translation({1, 2, 3}));
  a.commit();
  b.commit();
  const std::vector<minkray::Ray> rays = rays_around({1, 2, 3}, size, count);
  std::vector<minkray::Hit> hits_a(count), hits_b(count);
  a.cast(rays, hits_a);
  b.cast(rays, hits_b);
  std::vector<minkray::Proof> proofs(count);
  b.prove(rays, hits_b, proofs);
  std::size_t hits = 0, differ = 0;
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_NE(hits_b[i].status, minkray::exhausted) << i;
    ASSERT_TRUE(proofs[i].holds) << i << ": " << proofs[i].complaint;
    if (hits_a[i].status != hits_b[i].status) {
      ++differ;
      continue;
    }
    if (hits_a[i].status != minkray::hit) continue;
    ++hits;
    // Each encloses the truth, so they meet, but for the last bit of their ends.
    const double bit = 4e-16 * std::abs(hits_a[i].t);
    EXPECT_LE(hits_a[i].t_lo, hits_b[i].t_hi + bit) << i;
    EXPECT_LE(hits_b[i].t_lo, hits_a[i].t_hi + bit) << i;
  }
  EXPECT_GT(hits, count * 3 / 10);
  EXPECT_LT(hits, count * 8 / 10);
  EXPECT_LE(differ, count / 10000);
}
