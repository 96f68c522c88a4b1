// SPDX-License-Identifier: MIT
// Casts a ray at a sum A + B as a motion: the mirrored B moves along the ray until it meets A. A
// ray begins in the sum if the two overlap at the start.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/cast/stages.h"
#include "core/derived/sum_of_cores.h"
#include "core/pair_distance/core_distance.h"
#include "core/pair_motion/swept_time.h"

namespace minkray {
namespace {

/// Distance before the shape's centre at which the motion begins, in units of the bounding radius,
/// if the ray begins even earlier.
constexpr double first_distance = 1.0625;
/// Rounding of gaps along a plane's normal, relative to the operands' sizes and their distance:
/// half an epsilon each for the two support points and their difference, up to three for the
/// rotation between the operands and three for the product with the normal.
constexpr double gap_rounding = 8 * std::numeric_limits<double>::epsilon();
/// Rounding of the motion, up to two bounding radii of two epsilons each, in units of the radius.
constexpr double motion_rounding = 4 * std::numeric_limits<double>::epsilon();

/// Finds the normal of a plane that separates the ray from the shape. `axis` is the normal of a
/// plane that separates them for a part of the motion. Tries it, and then the nearest normal
/// perpendicular to the ray. Returns zero if neither separates. Times of the ray's ends are
/// relative to the motion's beginning.
Vec3<double> separating_normal(const CorePair& pair, const Vec3<double>& velocity,
                               const Vec3<double>& axis, double first, double last) {
  const auto gap = [&](const Vec3<double>& n) {
    return n.dot(nearest_along(pair, n).c) - pair.radii() - pair.rounding();
  };
  const double speed = axis.dot(velocity), end = speed > 0 ? first : last;
  if (speed == 0 || gap(axis) + end * speed > 0) return axis;
  const Vec3<double> across = unit<double>(axis - speed * velocity);
  return gap(across) > 0 ? across : Vec3<double>(Vec3<double>::Zero());
}

/// True if the origin is in the tetrahedron, even if each corner is up to `margin` from its place.
/// Such an error tilts the plane of a thin face.
bool is_within(const std::array<Vec3<double>, 4>& corners, double margin) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3<double>&a = corners[i], u = corners[(i + 1) % 4] - a, v = corners[(i + 2) % 4] - a,
          w = corners[(i + 3) % 4] - a, n = u.cross(v);
    const double height = n.dot(a), opposite = n.dot(w);
    const double tilt = 4 * margin * (u.norm() + v.norm());
    if (!(std::abs(opposite) > tilt * w.norm() + 2 * margin * n.norm())) return false;
    if (!(std::copysign(1.0, -opposite) * height > tilt * a.norm() + margin * n.norm()))
      return false;
  }
  return true;
}

/// Position of the operands at the start.
struct Beginning {
  Status status = Status::exhausted;  ///< inside; miss if they are apart; exhausted if undecided
  Vec3<double> axis = Vec3<double>::Zero();  ///< normal of a plane between operands that are apart
};

Beginning begin_of(const CorePair& pair, int& supports) {
  constexpr double coarse = 1e-9;
  const double margin = 2 * pair.rounding();
  CoreSearch search;
  search.gap = coarse;
  search.apart = pair.radii() + margin;
  Enclosure enclosure;
  const CoreDistance found = distance_of_cores(pair, search, &enclosure);
  supports += found.supports;
  if (found.lower > pair.radii() + margin) return {Status::miss, found.axis};
  if (found.upper < pair.radii() - margin || (enclosure.is_found && is_within(enclosure.c, margin)))
    return {Status::inside};
  return {};
}

/// Same as ask_operands, without the count of iterations.
CastResult<double> contact_of(const SumOfCores* sum, const StageQuestion& question) {
  CastResult<double> result;
  if (!sum) return result;
  const RayNearBall<double>& near = question.near;
  const Ball<double>& ball = question.shape.inner_ball();
  const double begin = std::max(near.lambda_min, -first_distance * ball.radius);
  if (!(near.lambda_max > begin)) return result;
  const Mat3<double> to_a = sum->a.turn.transpose();
  const double loss = sum->loss + near.loss + motion_rounding * ball.radius;
  const CorePair pair{sum->a.core,
                      sum->b.core,
                      -(to_a * sum->b.turn),
                      to_a * (near.s + begin * near.r + (ball.centre - sum->middle)),
                      loss,
                      gap_rounding};
  const Vec3<double> velocity = to_a * near.r;
  const auto miss = [&](const Vec3<double>& axis) {
    const Vec3<double> normal =
        separating_normal(pair, velocity, axis, near.lambda_min - begin, near.lambda_max - begin);
    if (!(normal.squaredNorm() > 0)) return result;
    result.status = Status::miss;
    result.normal = sum->a.turn * normal;
    result.offset_hi = 0.0;
    return result;
  };
  Beginning beginning;
  if (begin == near.lambda_min) {
    beginning = begin_of(pair, result.supports);
    if (beginning.status == Status::inside) result.status = Status::inside;
    if (beginning.status != Status::miss) return result;
    if (beginning.axis.dot(velocity) >= 0) return miss(beginning.axis);
  }
  constexpr double as_near_as_rounding_allows = 0;
  const SweptTime contact =
      swept_time(pair, velocity, near.lambda_max - begin, as_near_as_rounding_allows, nullptr);
  result.supports += contact.supports;
  if (contact.status == SweptStatus::miss) return miss(contact.axis);
  // The line has left the shape before the ray begins outside.
  if (contact.t_hi < 0 && beginning.status == Status::miss) return miss(beginning.axis);
  if (contact.status == SweptStatus::hit && contact.t_lo > 0 &&
      begin + contact.t_hi <= near.lambda_max) {
    // The plane's lower bound allows for rounding; the hit itself does not.
    const double rounding = pair.rounding() / -contact.axis.dot(velocity),
                 hit = std::min(contact.t_lo + rounding, contact.t_hi);
    result.status = Status::hit;
    result.normal = sum->a.turn * contact.axis;
    result.t_base = near.t_base;
    result.t_offset = near.t_offset(begin + hit);
    const double digits = std::copysign(near.offset_rounding(result.t_offset), near.t_per_length);
    result.offset_lo = near.t_offset(begin + contact.t_lo) - digits;
    result.offset_hi = near.t_offset(begin + contact.t_hi) + digits;
  }
  return result;
}

}  // namespace

CastResult<double> ask_operands(const StageQuestion& question) {
  CastResult<double> result = contact_of(question.shape.definition().operands(), question);
  result.iterations = result.supports;  // each step takes one support point of the sum
  return result;
}

}  // namespace minkray
