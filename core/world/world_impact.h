// SPDX-License-Identifier: MIT
// Which of many bodies at rest a moving one touches first, and when: bodies are looked at in the
// order in which the moving one's box meets theirs.
#pragma once

#include "core/contact/impact.h"
#include "core/world/near_pairs.h"

namespace minkray {

struct WorldImpact {
  /// `t_lo` is before all contacts; the rest is of the body that is touched first, or of that whose
  /// time is not known, or of a body that is missed.
  Impact impact;
  std::size_t body = none;
  static constexpr std::size_t none = ~std::size_t{0};
};

/// A is the moving body, which all bodies with a bit of `mask` in their category are looked at
/// for; `known` is what is known already of others.
WorldImpact first_impact(const PartsBody& moving, const RigidMotion& motion,
                         const ContactWorld& world, double t_max, std::uint32_t mask,
                         const WorldImpact& known);

/// Takes the body's answer in, which was asked for at times until found.impact.t_hi, or all.
void take(WorldImpact& found, std::size_t body, const Impact& impact);

/// Nothing is met until t_max.
WorldImpact nothing_met(double t_max);

}  // namespace minkray
