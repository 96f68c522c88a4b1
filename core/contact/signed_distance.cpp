// SPDX-License-Identifier: MIT
#include "core/contact/signed_distance.h"

#include <algorithm>
#include <cmath>

#include "core/contact/closed_pairs.h"
#include "core/contact/core_signed_distance.h"
#include "core/contact/searchable.h"

namespace minkray {
namespace {

/// What all roundings of a query amount to, relative to the sizes and the middles' distance.
constexpr double core_rounding = 16 * std::numeric_limits<double>::epsilon();

/// Bounds and points of the shapes, with their radii, as `search` finds them of the cores; nothing
/// is searched for at sizes that are out of its range, but for balls. `distance` is that of the
/// middles; `to_world` turns from the frame of what was found, which stands about A's middle.
template <class Search, class ToWorld>
SignedDistance told(const Search& search, const ContactShape& a, const ContactShape& b,
                    double distance, const Affine<double>& pose_a, bool only_sign,
                    const ToWorld& to_world) {
  const double radius_a = a.core().radius, radius_b = b.core().radius, radii = radius_a + radius_b;
  const double size = a.core().ball + b.core().ball + radii;
  const double allowed = core_rounding * (size + distance) + a.core().rounding + b.core().rounding;
  SignedDistance result;
  if (!std::isfinite(allowed)) return result;  // squares of such lengths are no numbers
  const bool are_balls = a.core().kind == CoreKind::point && b.core().kind == CoreKind::point;
  if (!are_balls && !are_searchable(size, distance)) return result;
  const CoreDistance found = search();
  result.supports = found.supports;
  result.is_exhausted = found.is_exhausted;
  result.lower = found.lower - radii - allowed;
  result.upper = found.upper - radii + allowed;
  if (found.status == CoreStatus::overlapping && found.upper >= 0)
    result.upper = found.c.norm() - radii + allowed;
  const bool is_from_points = found.status == CoreStatus::separated && std::isfinite(found.upper);
  result.value =
      std::clamp((is_from_points ? found.upper : found.lower) - radii, result.lower, result.upper);
  const bool is_near = result.upper - result.lower <= settled_core_gap * size + 2 * allowed;
  result.status = SignedStatus::undecided;
  const bool has_common_point = only_sign && found.status == CoreStatus::overlapping;
  if (result.upper < 0 || has_common_point)
    result.status = SignedStatus::overlapping;
  else if (result.lower > 0)
    result.status = SignedStatus::separated;
  else if (is_near)
    result.status = SignedStatus::touching;
  const Vec3<double> middle = middle_in_world(a, pose_a);
  const Vec3<double>& axis = to_world(found.axis);
  const Vec3<double>& on_a = to_world(found.a);
  const Vec3<double>& between = to_world(found.c);
  result.normal = unit<double>(axis);
  // Where the points of the cores lead a little aside of the normal, those of the bodies still lead
  // along it, by a path as long as the value. Closed forms end with one direction for both.
  const bool is_aside = is_from_points && found.lower < found.upper && radii > 0;
  const Vec3<double> outwards =
      is_aside ? unit<double>(between - std::min(result.value, 0.0) * result.normal) : axis;
  result.point_a = middle + (on_a + radius_a * outwards);
  result.point_b = middle + (on_a + between - radius_b * outwards);
  return result;
}

/// Both are points or segments. No frame of either is needed.
SignedDistance of_lines(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                        const Affine<double>& pose_b, bool only_sign) {
  const auto half = [](const ContactShape& shape, const Affine<double>& pose) -> Vec3<double> {
    if (shape.core().kind == CoreKind::point) return Vec3<double>::Zero();
    return pose.linear * (shape.turn().col(2) * shape.core().size.z());
  };
  const Vec3<double> x = between_middles(a, pose_a, b, pose_b);
  return told([&] { return between_segments(half(a, pose_a), half(b, pose_b), x); }, a, b, x.norm(),
              pose_a, only_sign, [](const Vec3<double>& v) -> const Vec3<double>& { return v; });
}

/// A is a point, B a box or disks. A's frame is not needed.
SignedDistance of_point_and_solid(const ContactShape& a, const Affine<double>& pose_a,
                                  const ContactShape& b, const Affine<double>& pose_b,
                                  bool only_sign) {
  const Mat3<double> turn = turn_in_world(b, pose_b);
  const Vec3<double> x = between_middles(a, pose_a, b, pose_b);
  const auto search = [&] {
    CoreDistance found = between_solid_and_point(b.core(), turn.transpose() * -x);
    found.axis = -found.axis;
    found.c = -found.c;
    found.a.setZero();
    return found;
  };
  return told(search, a, b, x.norm(), pose_a, only_sign,
              [&](const Vec3<double>& v) -> Vec3<double> { return turn * v; });
}

/// A's kind is not after B's: the solvers are compiled for one order of two kinds.
SignedDistance in_order(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                        const Affine<double>& pose_b, const SignedDistanceOptions& options,
                        PairMemory* memory) {
  if (is_line(b.core())) return of_lines(a, pose_a, b, pose_b, options.only_sign);
  if (a.core().kind == CoreKind::point && is_solid(b.core()))
    return of_point_and_solid(a, pose_a, b, pose_b, options.only_sign);
  const Mat3<double> turn = turn_in_world(a, pose_a);
  const CorePair pair = pair_of(a, pose_a, turn, b, pose_b);
  return told([&] { return core_signed_distance(pair, options, memory); }, a, b, pair.x.norm(),
              pose_a, options.only_sign,
              [&](const Vec3<double>& v) -> Vec3<double> { return turn * v; });
}

SignedDistance in_any_order(const ContactShape& a, const Affine<double>& pose_a,
                            const ContactShape& b, const Affine<double>& pose_b,
                            const SignedDistanceOptions& options, PairMemory* memory) {
  if (a.core().kind <= b.core().kind) return in_order(a, pose_a, b, pose_b, options, memory);
  SignedDistance turned = in_order(b, pose_b, a, pose_a, options, memory);
  std::swap(turned.point_a, turned.point_b);
  turned.normal = -turned.normal;
  return turned;
}

}  // namespace

SignedDistance signed_distance(const ContactShape& a, const Affine<double>& pose_a,
                               const ContactShape& b, const Affine<double>& pose_b,
                               const SignedDistanceOptions& options) {
  return in_any_order(a, pose_a, b, pose_b, options, nullptr);
}

SignedDistance signed_distance(const ContactShape& a, const Affine<double>& pose_a,
                               const ContactShape& b, const Affine<double>& pose_b,
                               PairMemory& memory, const SignedDistanceOptions& options) {
  return in_any_order(a, pose_a, b, pose_b, options, &memory);
}

SignedDistance signed_distance(const ContactShape& a, const ContactShape& b,
                               const SignedDistanceOptions& options) {
  return signed_distance(a, {}, b, {}, options);
}

}  // namespace minkray
