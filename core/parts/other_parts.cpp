// SPDX-License-Identifier: MIT
#include "core/parts/other_parts.h"

#include "core/parts/one_part.h"
#include "core/parts/pair_walk.h"
#include "core/parts/triangle_pair.h"

namespace minkray {
namespace {

/// Calls differ(part_a, part_b) for all pairs of parts but `known` that are no further apart than
/// `most`, until one of them returns true. The unit vector `normal` is likely to separate them.
template <class Differ>
bool any_within(const PartsBody& body_a, const Affine<double>& pose_a, const PartsBody& body_b,
                const Affine<double>& pose_b, const PartPair& known, double most,
                const Vec3<double>& normal, const Differ& differ) {
  const BodyTree a(body_a), b(body_b);
  const Sight sight(a, pose_a, b, pose_b);
  PairWalk walk(a, b, sight);
  walk.set_direction(sight.turn_a.transpose() * normal);
  const auto are_near = [&](std::uint32_t part_a, std::uint32_t part_b) {
    if (!a.mesh() || !b.mesh()) return true;
    TriangleCorners of_b = b.triangle(part_b);
    for (Vec3<double>& corner : of_b) corner = sight.b_in_a.turn * corner + sight.b_in_a.shift;
    return !(triangle_gap(a.triangle(part_a), of_b).lower > most + sight.rounding);
  };
  bool is_any = false;
  walk.run([](double gap, const MiddleBox&, const MiddleBox&) { return gap; }, [&] { return most; },
           [&](std::uint32_t part_a, std::uint32_t part_b) {
             const OnePart of_a(body_a, part_a), of_b(body_b, part_b);
             if (of_a.number() == known.a && of_b.number() == known.b) return false;
             if (!are_near(part_a, part_b)) return false;
             is_any = differ(of_a.shape(), of_b.shape());
             return is_any;
           });
  return is_any;
}

/// Sum of the bodies' radii.
double size_of(const PartsBody& a, const PartsBody& b) {
  return BodyTree(a).radius() + BodyTree(b).radius();
}

/// True unless two derivatives are equal up to their errors; `size` is the bodies'.
bool are_different(const PairDerivative& one, const PairDerivative& other, double size) {
  constexpr double same = 1e-5;
  const auto differ = [&](const TwistDerivative& a, const TwistDerivative& b) {
    const double length = a.by_velocity.norm();
    return !((a.by_velocity - b.by_velocity).norm() <= same * length) ||
           !((a.by_turn - b.by_turn).norm() <= same * (a.by_turn.norm() + size * length));
  };
  return other.is_ridge || differ(one.a, other.a) || differ(one.b, other.b);
}

}  // namespace

bool differ_in_derivative(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                          const Affine<double>& pose_b, const PartPair& nearest, double distance,
                          const PairDerivative& derivative) {
  constexpr double same = 1e-12;  // of the sizes
  const double size = size_of(a, b), most = distance + same * size;
  SignedDistanceOptions how;
  how.at_most = most;
  return any_within(a, pose_a, b, pose_b, nearest, most, derivative.b.by_velocity,
                    [&](const ContactShape& of_a, const ContactShape& of_b) {
                      return signed_distance(of_a, pose_a, of_b, pose_b, how).lower <= most &&
                             are_different(derivative,
                                           finest_derivative_of(of_a, pose_a, of_b, pose_b), size);
                    });
}

bool differ_in_derivative(const PartsBody& a, const RigidMotion& motion_a, const PartsBody& b,
                          const RigidMotion& motion_b, const PartPair& first, const Impact& found,
                          const PairDerivative& derivative) {
  constexpr double near = 1e-8, same = 2e-10;  // of the sizes
  const double size = size_of(a, b), slowness = derivative.b.by_velocity.norm();
  const double until = found.t_hi + same * size * slowness;
  return any_within(
      a, motion_a.at(found.t_lo), b, motion_b.at(found.t_lo), first, found.distance + near * size,
      derivative.b.by_velocity / slowness, [&](const ContactShape& of_a, const ContactShape& of_b) {
        const Impact other = first_impact(of_a, motion_a, of_b, motion_b, until);
        return other.status == ImpactStatus::hit &&
               are_different(derivative, derivative_of(of_a, motion_a, of_b, motion_b, other),
                             size);
      });
}

}  // namespace minkray
