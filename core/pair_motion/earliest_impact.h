// SPDX-License-Identifier: MIT
// Finds the first of many times of impact.
#pragma once

#include "core/pair_motion/impact.h"

namespace minkray {

struct EarliestImpact {
  /// `t_lo` is before all contacts. All other members are those of one body: the body that is
  /// touched first; without contact, a body whose time is unknown or a body that is missed.
  Impact impact;
  std::size_t body = none;
  static constexpr std::size_t none = ~std::size_t{0};
};

/// Result for no contact up to t_max.
inline EarliestImpact nothing_met(double t_max) {
  EarliestImpact found;
  found.impact.status = ImpactStatus::miss;
  found.impact.t_lo = t_max;
  found.impact.distance = std::numeric_limits<double>::infinity();
  return found;
}

/// Merges a body's result into `found`. The result must cover the times up to found.impact.t_hi.
inline void take(EarliestImpact& found, std::size_t body, const Impact& impact) {
  if (impact.status == ImpactStatus::miss) return;
  const double t_lo = std::min(found.impact.t_lo, impact.t_lo);
  const auto end_of = [](const Impact& one) {
    const bool touch = one.status == ImpactStatus::hit || one.status == ImpactStatus::inside;
    return touch ? one.t_hi : std::numeric_limits<double>::infinity();
  };
  const bool is_first = end_of(impact) < end_of(found.impact) ||
                        (end_of(impact) == end_of(found.impact) &&
                         (found.body == EarliestImpact::none || body < found.body));
  if (is_first) {
    found.impact = impact;
    found.body = body;
  }
  found.impact.t_lo = t_lo;
}

}  // namespace minkray
