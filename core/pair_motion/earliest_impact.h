// SPDX-License-Identifier: MIT
// Merges the first contacts of one body with each of many others into the earliest contact.
#pragma once

#include "core/pair_motion/impact.h"

namespace minkray {

struct EarliestImpact {
  /// `t_lo` is a lower bound for all bodies: there is no contact with any of them before t_lo. All
  /// other members are the result for a single body: the body that is touched first. If no contact
  /// was found, they are the result for an undecided body or else a miss.
  Impact impact;
  std::size_t body = none;  ///< number of that body; none if all results are misses
  static constexpr std::size_t none = ~std::size_t{0};
};

/// Returns the initial value for take(): no contact up to t_max.
inline EarliestImpact nothing_met(double t_max) {
  EarliestImpact found;
  found.impact.status = ImpactStatus::miss;
  found.impact.t_lo = t_max;
  return found;
}

/// Merges the result for one body into `found`. The body must have been tested at least up to
/// found.impact.t_hi.
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
