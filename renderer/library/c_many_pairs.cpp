// SPDX-License-Identifier: MIT
// C interface: queries on many pairs of shapes.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "core/pair_derivative/impact_derivative_error.h"
#include "core/pair_derivative/pair_derivative.h"
#include "core/pair_distance/manifold.h"
#include "core/parts/parts_contact.h"
#include "core/parts/parts_distance.h"
#include "core/parts/parts_impact.h"
#include "renderer/library/handles/bodies_of_pairs.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/kept_memory.h"
#include "renderer/library/handles/pair_answers.h"
#include "renderer/library/handles/work_on_rays.h"

namespace minkray {
namespace {

/// Pairs that a thread takes at once: the longest take some tens of milliseconds each.
constexpr std::size_t pairs_a_part = 64;

/// Queries each pair by itself, on as many threads as the options allow: ask(i, a, b, memory).
template <class Ask>
void ask_all(const BodiesOfPairs& a, const BodiesOfPairs& b, std::size_t count,
             minkray_pair_memory* memories, const minkray_options* how, const Ask& ask) {
  const auto part = [&](std::size_t begin, std::size_t end) {
    PosedBody body_a, body_b;
    for (std::size_t i = begin; i < end; ++i) {
      a.read(i, body_a);
      b.read(i, body_b);
      KeptMemory memory(memories ? memories + i : nullptr);
      ask(i, body_a, body_b, memory.get());
    }
  };
  if (are_gathered(a.customs()) || are_gathered(b.customs()))
    work_on_groups(count, 1, true, how, part);
  else
    work_on_parts(count, pairs_a_part, how, part);
  throw_if_lied(a.customs());
  throw_if_lied(b.customs());
}

bool are_shapes(const PosedBody& a, const PosedBody& b) {
  return a.is_shape() && b.is_shape();
}

SignedDistance distance_of(const PosedBody& a, const PosedBody& b, PairMemory* memory,
                           const SignedDistanceOptions& options) {
  if (are_shapes(a, b) && memory)
    return signed_distance(a.shape(), a.pose(), b.shape(), b.pose(), *memory, options);
  if (!memory) return signed_distance(a.parts(), a.pose(), b.parts(), b.pose(), options);
  // Keeps the nearest parts in the memory, as features.
  PartPair parts;
  if (memory->count == 1)
    parts = {static_cast<std::uint32_t>(memory->feature_a[0]),
             static_cast<std::uint32_t>(memory->feature_b[0])};
  const SignedDistance found =
      signed_distance(a.parts(), a.pose(), b.parts(), b.pose(), options, &parts, parts);
  *memory = {};
  memory->feature_a[0] = static_cast<std::int32_t>(parts.a);
  memory->feature_b[0] = static_cast<std::int32_t>(parts.b);
  memory->count = 1;
  return found;
}

PairDerivative derivative_at(const PosedBody& a, const PosedBody& b, const SignedDistance& found,
                             PairDerivativeError* error) {
  if (are_shapes(a, b))
    return derivative_of(a.shape(), a.pose(), b.shape(), b.pose(), found, error);
  return derivative_of(a.parts(), a.pose(), b.parts(), b.pose());
}

PairDerivative derivative_at(const PosedBody& a, const RigidMotion& motion_a, const PosedBody& b,
                             const RigidMotion& motion_b, const Impact& found, double end) {
  if (are_shapes(a, b)) return derivative_of(a.shape(), motion_a, b.shape(), motion_b, found);
  return derivative_of(a.parts(), motion_a, b.parts(), motion_b, end);
}

template <class To, class From>
void tell(To* to, std::size_t i, From from) {
  if (to) to[i] = static_cast<To>(from);
}

void tell(double* to, std::size_t i, const TwistDerivative& derivative) {
  if (!to) return;
  put(derivative.by_velocity, to + 6 * i);
  put(derivative.by_turn, to + 6 * i + 3);
}

/// Fills what distances and manifolds both have.
template <class Arrays, class Found>
void tell_bounds(const Arrays& to, std::size_t i, const Found& found) {
  tell(to.value, i, found.value);
  tell(to.lower, i, found.lower);
  tell(to.upper, i, found.upper);
}

/// Fills what distances and impacts both have.
template <class Arrays, class Found>
void tell_points(const Arrays& to, std::size_t i, const Found& found) {
  put(found.point_a, to.points_a, i);
  put(found.point_b, to.points_b, i);
  put(found.normal, to.normals, i);
  tell(to.status, i, code_of(found.status));
}

void tell(const minkray_distance_arrays& to, std::size_t i, const SignedDistance& found) {
  if (to.distances) to.distances[i] = plain_distance(found);
  tell_bounds(to, i, found);
  tell_points(to, i, found);
  tell(to.supports, i, found.supports);
}

void tell(const minkray_impact_arrays& to, std::size_t i, const Impact& found) {
  if (to.impacts) to.impacts[i] = plain_impact(found);
  tell(to.t_lo, i, found.t_lo);
  tell(to.t_hi, i, end_of(found));
  tell(to.distance, i, found.distance);
  tell_points(to, i, found);
}

void tell(const minkray_manifold_arrays& to, std::size_t i, const minkray_manifold& found) {
  if (to.manifolds) to.manifolds[i] = found;
  if (to.normals) std::copy_n(found.normal, 3, to.normals + 3 * i);
  const double* const a = &found.points_a[0][0];
  const double* const b = &found.points_b[0][0];
  if (to.points_a) std::copy_n(a, 12, to.points_a + 12 * i);
  if (to.points_b) std::copy_n(b, 12, to.points_b + 12 * i);
  if (to.points)
    for (std::size_t k = 0; k < 12; ++k) to.points[12 * i + k] = a[k] + (b[k] - a[k]) / 2;
  if (to.gaps) std::copy_n(found.gaps, 4, to.gaps + 4 * i);
  tell_bounds(to, i, found);
  tell(to.counts, i, found.count);
  tell(to.status, i, found.status);
}

template <class Arrays>
void tell_derivative(const Arrays& to, std::size_t i, const PairDerivative& derivative) {
  tell(to.jac_a, i, derivative.a);
  tell(to.jac_b, i, derivative.b);
  tell(to.is_ridge, i, derivative.is_ridge ? 1 : 0);
}

template <class Arrays>
bool wants_derivative(const Arrays& to) {
  return to.jac_a || to.jac_b || to.is_ridge;
}

/// Two numbers for each body of a pair.
void tell(double* to, std::size_t i, const TwistError& error) {
  if (!to) return;
  to[2 * i] = error.by_velocity;
  to[2 * i + 1] = error.by_turn;
}

/// The arrays to fill; those that an older program does not have are null. Throws CallError if they
/// are shorter than `least` bytes, the size that the first version had.
template <class Arrays>
Arrays checked(const Arrays* arrays, const char* argument, const char* type,
               std::size_t least = sizeof(Arrays)) {
  require(arrays, argument);
  if (arrays->size < least)
    wrong_use(std::string(argument) + ".size: must be sizeof(" + type + ")");
  Arrays known = {};
  std::memcpy(&known, arrays, std::min(arrays->size, sizeof(Arrays)));
  return known;
}

}  // namespace
}  // namespace minkray

using namespace minkray;

extern "C" {

int minkray_signed_distances(const minkray_bodies* a, const minkray_bodies* b, size_t count,
                             const minkray_distance_options* options, minkray_pair_memory* memories,
                             const minkray_distance_arrays* distances, const minkray_options* how) {
  return call("minkray_signed_distances", [&] {
    const BodiesOfPairs all_a(a, count, "a"), all_b(b, count, "b");
    const minkray_distance_arrays to = checked(distances, "distances", "minkray_distance_arrays",
                                               offsetof(minkray_distance_arrays, jac_error_a));
    SignedDistanceOptions asked = distance_options(options);
    const bool bound = to.jac_error_a || to.jac_error_b;
    const bool derive = bound || wants_derivative(to);
    if (derive) asked = for_derivatives(asked);
    ask_all(all_a, all_b, count, memories, how,
            [&](size_t i, const PosedBody& one, const PosedBody& other, PairMemory* memory) {
              const SignedDistance found = distance_of(one, other, memory, asked);
              tell(to, i, found);
              if (!derive) return;
              PairDerivativeError error;
              tell_derivative(to, i, derivative_at(one, other, found, bound ? &error : nullptr));
              if (!bound) return;
              tell(to.jac_error_a, i, error.a);
              tell(to.jac_error_b, i, error.b);
            });
  });
}

int minkray_times_of_impact(const minkray_bodies* a, const minkray_bodies* b, size_t count,
                            const double* t_max, size_t t_max_count, minkray_pair_memory* memories,
                            const minkray_impact_arrays* impacts, const minkray_options* how) {
  return call("minkray_times_of_impact", [&] {
    const BodiesOfPairs all_a(a, count, "a"), all_b(b, count, "b");
    const minkray_impact_arrays to = checked(impacts, "impacts", "minkray_impact_arrays",
                                             offsetof(minkray_impact_arrays, jac_error_a));
    check_ends(t_max, t_max_count, count);
    const bool bound = to.jac_error_a || to.jac_error_b;
    ImpactOptions asked;
    asked.is_for_derivatives = bound || wants_derivative(to);
    ask_all(all_a, all_b, count, memories, how,
            [&](size_t i, const PosedBody& one, const PosedBody& other, PairMemory* memory) {
              const RigidMotion motion_a = all_a.motion(i, one), motion_b = all_b.motion(i, other);
              const double end = t_max[t_max_count == 1 ? 0 : i];
              const Impact found =
                  memory && are_shapes(one, other)
                      ? first_impact(one.shape(), motion_a, other.shape(), motion_b, end, *memory,
                                     asked)
                      : first_impact(one.parts(), motion_a, other.parts(), motion_b, end, asked);
              tell(to, i, found);
              if (!asked.is_for_derivatives) return;
              const PairDerivative derivative =
                  derivative_at(one, motion_a, other, motion_b, found, end);
              tell_derivative(to, i, derivative);
              if (!bound) return;
              const PairDerivativeError error =
                  are_shapes(one, other)
                      ? error_of(one.shape(), motion_a, other.shape(), motion_b, found, derivative)
                      : error_of(found);
              tell(to.jac_error_a, i, error.a);
              tell(to.jac_error_b, i, error.b);
            });
  });
}

int minkray_manifolds(const minkray_bodies* a, const minkray_bodies* b, size_t count,
                      const minkray_distance_options* options, minkray_pair_memory* memories,
                      const minkray_manifold_arrays* manifolds, const minkray_options* how) {
  return call("minkray_manifolds", [&] {
    const BodiesOfPairs all_a(a, count, "a"), all_b(b, count, "b");
    const minkray_manifold_arrays to = checked(manifolds, "manifolds", "minkray_manifold_arrays");
    const SignedDistanceOptions asked = distance_options(options);
    ask_all(all_a, all_b, count, memories, how,
            [&](size_t i, const PosedBody& one, const PosedBody& other, PairMemory* memory) {
              const SignedDistance found = distance_of(one, other, memory, asked);
              tell(to, i,
                   plain_manifold(found, are_shapes(one, other)
                                             ? contact_manifold(one.shape(), one.pose(),
                                                                other.shape(), other.pose(), found)
                                             : contact_manifold(one.parts(), one.pose(),
                                                                other.parts(), other.pose())));
            });
  });
}

}  // extern "C"
