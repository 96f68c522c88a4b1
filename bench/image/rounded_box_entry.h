// SPDX-License-Identifier: MIT
// Entry of a ray into a rounded box, in closed form. The squared distance to the box within is,
// along the ray, a chain of parabolas, one for each position of the ray's point relative to the
// three pairs of faces; the entry is the first root of distance^2 = radius^2.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/ray.h"

namespace minkray::bench {

struct RoundedBoxEntry {
  float t = std::numeric_limits<float>::infinity();  ///< infinite for a miss
  Vec3<float> normal;                                ///< outward, of unit length
};

/// The box is [-half, half]. The ray is in its frame, its direction of any length but zero; rays
/// that begin within the shape, or whose entry is not in [0, t_max], miss.
inline RoundedBoxEntry rounded_box_entry(const Vec3<float>& half, float radius,
                                         const Ray<float>& ray) {
  constexpr float never = std::numeric_limits<float>::infinity();
  RoundedBoxEntry entry;
  const Vec3<float>& d = ray.direction;
  // From the closest approach to the centre, so that far origins lose nothing.
  const float base = -ray.origin.dot(d) / d.squaredNorm();
  const Vec3<float> o = ray.origin + base * d;

  // The outer box, and where the ray passes the planes of the inner one.
  float enter = -never, leave = never;
  float into[3], out_of[3];
  for (int i = 0; i < 3; ++i) {
    const float inverse = 1 / d[i], away = std::abs(inverse), middle = -o[i] * inverse;
    into[i] = middle - half[i] * away;
    out_of[i] = middle + half[i] * away;
    enter = std::max(enter, into[i] - radius * away);
    leave = std::min(leave, out_of[i] + radius * away);
  }
  if (!(enter <= leave)) return entry;

  float t = enter;
  while (t <= leave) {
    float next = never, a = 0, b = 0, c = -radius * radius;
    for (int i = 0; i < 3; ++i) {
      // Before the slab or behind it; in it, this axis adds nothing.
      const bool before = t < into[i], behind = t >= out_of[i];
      if (before) next = std::min(next, into[i]);
      if (!before && !behind) next = std::min(next, out_of[i]);
      if (!before && !behind) continue;
      const float face = (before == (d[i] > 0)) ? -half[i] : half[i];
      const float beside = o[i] - face;
      a += d[i] * d[i];
      b += d[i] * beside;
      c += beside * beside;
    }
    // Within the inner box the ray has been all along.
    if (!(a > 0)) break;
    const float discriminant = b * b - a * c;
    if (discriminant >= 0) {
      const float root = (-b - std::sqrt(discriminant)) / a;
      if (root <= next) {
        t = std::max(root, t);
        break;
      }
    }
    // Rising again without having come near enough.
    if (-b <= a * next) return entry;
    t = next;
  }
  const float at = base + t;
  if (!(t <= leave) || !(at >= 0) || !(at <= ray.t_max)) return entry;
  const Vec3<float> p = o + t * d;
  entry.t = at;
  entry.normal = (p - p.cwiseMax(-half).cwiseMin(half)) / radius;
  return entry;
}

}  // namespace minkray::bench
