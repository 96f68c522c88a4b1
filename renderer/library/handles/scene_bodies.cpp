// SPDX-License-Identifier: MIT
#include "renderer/library/handles/scene_bodies.h"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "core/derived/cube.h"
#include "core/pair_derivative/impact_derivative_error.h"
#include "core/parallel/parallel.h"
#include "core/parts/parts_contact.h"
#include "core/parts/parts_distance.h"
#include "core/parts/parts_impact.h"
#include "core/parts/parts_reach.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/library/handles/call.h"

namespace minkray {
namespace {

SignedDistance distance_to(const PlacedPlane& plane, const ContactBody& body) {
  return distance_to_half_space(plane, body.parts(), body.pose);
}

void turn_round(SignedDistance& found) {
  std::swap(found.point_a, found.point_b);
  found.normal = -found.normal;
}

void turn_round(PairDerivative& derivative) {
  std::swap(derivative.a, derivative.b);
}

/// The part of the half-space within `reach` of the point, as a box: all that a body of that reach
/// can touch.
ContactBody as_box(const PlacedPlane& plane, const Vec3<double>& near, double reach) {
  const Vec3<double>& n = plane.normal;
  const TwoFoldVec3<double> from_plane = TwoFoldVec3<double>(near) - plane.point;
  const double height = n.dot(from_plane.rounded());
  const double half = 2 * (reach + std::abs(height));
  Affine<double> pose;
  pose.linear.col(0) = n.unitOrthogonal();
  pose.linear.col(1) = n.cross(pose.linear.col(0));
  pose.linear.col(2) = n;
  pose.translation = near - (height + half) * n;
  return {ContactShape(cube_of(half)), pose};
}

/// Largest distance that the moving body gets from its origin at time 0.
double way_of(const PartsBody& moving, const RigidMotion& motion, double t_max) {
  return reach_of(moving) + t_max * motion.velocity.norm();
}

constexpr double square(double x) {
  return x * x;
}

/// The next float that is no more.
float float_below(double x) {
  constexpr double largest = std::numeric_limits<float>::max();
  const float rounded = static_cast<float>(std::clamp(x, -largest, largest));
  return double(rounded) <= x ? rounded
                              : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}

constexpr double no_end = std::numeric_limits<double>::infinity();

double value_of(const ScenePair& pair) {
  return pair.distance.is_unknown() ? no_end : pair.distance.value;
}

/// Marks pairs whose bounds meet those of another pair. The pairs are sorted by their values;
/// `others` is a lower bound of the distances of further pairs.
void mark_tied(std::vector<ScenePair>& pairs, double others) {
  double most = -no_end;
  for (ScenePair& pair : pairs) {
    pair.is_tied = pair.distance.lower <= most;
    most = std::max(most, pair.distance.upper);
  }
  for (ScenePair& pair : pairs | std::views::reverse) {
    pair.is_tied = pair.is_tied || others <= pair.distance.upper;
    others = std::min(others, pair.distance.lower);
  }
}

}  // namespace

bool SceneBodies::are_looked_at(std::uint32_t a, std::uint32_t b) const {
  if (scene_.pair_rules().allows(a, b)) return false;
  if (robot_of_.empty() || robot_of_[a] == none || robot_of_[a] != robot_of_[b]) return true;
  return minkray::are_looked_at(places_[a], places_[b]);
}

const SceneBodies::HalfSpace* SceneBodies::half_space_of(std::uint32_t object) const {
  const auto found = std::ranges::find(half_spaces_, object, &HalfSpace::object);
  return found == half_spaces_.end() ? nullptr : &*found;
}

std::vector<ScenePair> SceneBodies::near(double within, double tolerance,
                                         const RunParts& run) const {
  NearPairsOptions options;
  options.at_most = within;
  options.tolerance = tolerance;
  options.run = run;
  options.wanted = [&](std::size_t a, std::size_t b) {
    return are_looked_at(objects_[a], objects_[b]);
  };
  std::vector<ScenePair> pairs;
  for (const NearPair& pair : near_pairs(*world_, options))
    pairs.push_back({objects_[pair.a], objects_[pair.b], pair.distance});
  if (half_spaces_.empty()) return pairs;
  add_half_spaces_near(within, pairs);
  std::ranges::sort(pairs, {}, [](const ScenePair& pair) { return std::pair(pair.a, pair.b); });
  return pairs;
}

void SceneBodies::add_half_spaces_near(double within, std::vector<ScenePair>& pairs) const {
  const std::vector<ContactBody>& bodies = world_->bodies();
  std::vector<ScenePair> found(bodies.size());
  for (const HalfSpace& half_space : half_spaces_) {
    constexpr std::size_t grain = 256;
    parallel_for(bodies.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        found[i].a = none;
        const ContactBody& body = bodies[i];
        if ((body.category & half_space.masks.mask) == 0 ||
            (half_space.masks.category & body.mask) == 0 ||
            !are_looked_at(half_space.object, objects_[i]))
          continue;
        SignedDistance distance = distance_to(half_space.plane, body);
        if (distance.lower > within) continue;
        if (half_space.object > objects_[i]) turn_round(distance);
        found[i] = {std::min(half_space.object, objects_[i]),
                    std::max(half_space.object, objects_[i]), distance};
      }
    });
    std::ranges::copy_if(found, std::back_inserter(pairs),
                         [](const ScenePair& pair) { return pair.a != none; });
  }
}

SignedDistance SceneBodies::distance(std::uint32_t a, std::uint32_t b,
                                     const SignedDistanceOptions& how) const {
  const HalfSpace *plane_a = half_space_of(a), *plane_b = half_space_of(b);
  if (plane_a && plane_b)
    wrong_use("must not be two half-spaces (got " + std::to_string(a) + " and " +
              std::to_string(b) + ")");
  if (!plane_a && !plane_b) {
    const ContactBody &one = body_of(a), &other = body_of(b);
    return signed_distance(one.parts(), one.pose, other.parts(), other.pose, how);
  }
  SignedDistance found =
      plane_a ? distance_to(plane_a->plane, body_of(b)) : distance_to(plane_b->plane, body_of(a));
  if (plane_b) turn_round(found);
  return found;
}

ContactManifold SceneBodies::manifold(std::uint32_t a, std::uint32_t b,
                                      const SignedDistance& nearest) const {
  const auto solid = [&](std::uint32_t object, std::uint32_t other) -> ContactBody {
    const HalfSpace* const half_space = half_space_of(object);
    if (!half_space) return body_of(object);
    const ContactBody& body = body_of(other);
    if (!body.is_shape())
      return as_box(half_space->plane, body.pose.translation, reach_of(body.parts()));
    return as_box(half_space->plane, middle_in_world(body.shape, body.pose),
                  body.shape.ball_radius());
  };
  const ContactBody one = solid(a, b), other = solid(b, a);
  if (!one.is_shape() || !other.is_shape())
    return contact_manifold(one.parts(), one.pose, other.parts(), other.pose);
  return contact_manifold(one.shape, one.pose, other.shape, other.pose, nearest);
}

PairDerivative SceneBodies::derivative(const ScenePair& pair, PairDerivativeError* error) const {
  if (error) *error = {};
  const HalfSpace *plane_a = half_space_of(pair.a), *plane_b = half_space_of(pair.b);
  if (!plane_a && !plane_b) {
    const ContactBody &one = body_of(pair.a), &other = body_of(pair.b);
    if (!one.is_shape() || !other.is_shape())
      return derivative_of(one.parts(), one.pose, other.parts(), other.pose);
    return finest_derivative_of(one.shape, one.pose, other.shape, other.pose, error);
  }
  const HalfSpace& plane = plane_a ? *plane_a : *plane_b;
  const ContactBody& body = body_of(plane_a ? pair.b : pair.a);
  SignedDistance distance = pair.distance;
  if (plane_b) turn_round(distance);
  PairDerivative derivative =
      derivative_at_half_space(plane.origin, body.parts(), body.pose, distance, error);
  if (!plane_b) return derivative;
  turn_round(derivative);
  if (error) std::swap(error->a, error->b);
  return derivative;
}

std::vector<ScenePair> SceneBodies::nearest(const ContactBody& to, std::size_t count,
                                            double at_most) const {
  std::vector<ScenePair> best;
  double others = no_end;  // lower bound of the distances of other bodies
  for (const NearPair& pair : nearest_bodies(to, *world_, count, at_most, &others))
    best.push_back({none, objects_[pair.b], pair.distance});
  for (const HalfSpace& half_space : half_spaces_) {
    if ((half_space.masks.category & to.mask) == 0) continue;
    SignedDistance distance = distance_to(half_space.plane, to);
    if (distance.lower > at_most) continue;
    turn_round(distance);
    best.push_back({none, half_space.object, distance});
  }
  std::ranges::stable_sort(best, {},
                           [](const ScenePair& pair) { return std::pair(value_of(pair), pair.b); });
  mark_tied(best, others);
  if (best.size() > count) best.resize(count);
  return best;
}

PairDerivative SceneBodies::derivative(const ContactBody& of, const ScenePair& pair,
                                       PairDerivativeError* error) const {
  PairDerivative derivative = derivative_of_pair(of, pair, error);
  if (!pair.is_tied) return derivative;
  derivative.is_ridge = true;
  if (error) *error = {};
  return derivative;
}

PairDerivative SceneBodies::derivative_of_pair(const ContactBody& of, const ScenePair& pair,
                                               PairDerivativeError* error) const {
  if (error) *error = {};
  if (const HalfSpace* const half_space = half_space_of(pair.b)) {
    SignedDistance distance = pair.distance;
    turn_round(distance);
    PairDerivative derivative =
        derivative_at_half_space(half_space->origin, of.parts(), of.pose, distance, error);
    turn_round(derivative);
    if (error) std::swap(error->a, error->b);
    return derivative;
  }
  const ContactBody& other = body_of(pair.b);
  if (!of.is_shape() || !other.is_shape())
    return derivative_of(of.parts(), of.pose, other.parts(), other.pose);
  return finest_derivative_of(of.shape, of.pose, other.shape, other.pose, error);
}

Vec3<double> SceneBodies::origin(std::uint32_t object) const {
  const HalfSpace* const half_space = half_space_of(object);
  return half_space ? half_space->origin : body_of(object).pose.translation;
}

bool SceneBodies::is_another_at(const Vec3<double>& point, std::uint32_t object,
                                double near) const {
  for (const HalfSpace& one : half_spaces_)
    if (one.object != object &&
        std::abs(one.plane.normal.dot((TwoFoldVec3<double>(point) - one.plane.point).rounded())) <=
            near)
      return true;
  SignedDistanceOptions how;
  how.at_most = near;
  Affine<double> at;
  at.translation = point;
  const Vec3<double> around = Vec3<double>::Constant(near);
  return any_body_in({point - around, point + around}, [&](std::uint32_t index) {
    // Most boxes that hold a point are of bodies that do not: their corners.
    const Ball& ball = balls_[index];
    if ((point - ball.middle).squaredNorm() > square(ball.radius + 2 * near) ||
        objects_[index] == object)
      return false;
    const ContactBody& body = world_->bodies()[index];
    const SignedDistance distance =
        signed_distance(PartsBody(point_), at, body.parts(), body.pose, how);
    return distance.lower <= near && distance.upper >= -near;
  });
}

template <class Test>
bool SceneBodies::any_body_in(const Bounds<double>& box, const Test& test) const {
  if (world_->bodies().empty()) return false;
  float least[3], most[3];  // of the box, rounded outwards
  for (int axis = 0; axis < 3; ++axis) {
    least[axis] = float_below(box.lower[axis]);
    most[axis] = -float_below(-box.upper[axis]);
  }
  std::uint32_t open[bvh_max_depth * (bvh_width - 1) + bvh_width];
  int count = 0;
  open[count++] = 0;
  while (count > 0) {
    const std::uint32_t what = open[--count];
    if ((what & BvhNode::leaf) == 0) {
      const BvhNode& node = world_->hierarchy().nodes[what];
      int is_in[bvh_width];  // all at once; what is no child has an empty box
      for (int i = 0; i < bvh_width; ++i) {
        is_in[i] = 1;
        for (int axis = 0; axis < 3; ++axis)
          is_in[i] &= (node.planes[0][axis][i] <= most[axis] ? 1 : 0) &
                      (node.planes[1][axis][i] >= least[axis] ? 1 : 0);
      }
      for (int i = 0; i < bvh_width; ++i)
        if (is_in[i] != 0 && node.children[i] != BvhNode::none) open[count++] = node.children[i];
      continue;
    }
    if (test(what & ~BvhNode::leaf)) return true;
  }
  return false;
}

EarliestImpact SceneBodies::first_impact(const PartsBody& moving, const RigidMotion& motion,
                                         double t_max, std::uint32_t mask) const {
  EarliestImpact found = nothing_met(t_max);
  for (const HalfSpace& half_space : half_spaces_) {
    if ((half_space.masks.category & mask) == 0) continue;
    const ContactBody box =
        as_box(half_space.plane, motion.pose.translation, way_of(moving, motion, t_max));
    take(found, half_space.object,
         minkray::first_impact(moving, motion, box.parts(), {box.pose}, t_max));
  }
  // Bodies and half-spaces have numbers of their own until here.
  EarliestImpact met = minkray::first_impact(
      moving, motion, *world_, std::min(t_max, found.impact.t_hi), mask, nothing_met(t_max));
  if (met.body != EarliestImpact::none) take(found, objects_[met.body], met.impact);
  return found;
}

bool SceneBodies::is_another_touched(const PartsBody& moving, const RigidMotion& motion,
                                     const EarliestImpact& found, std::uint32_t mask,
                                     double slowness) const {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const auto object = static_cast<std::uint32_t>(found.body);
  const double time = found.impact.t_lo;
  const double reach = reach_of(moving);
  const double speed = motion.velocity.norm() + reach * motion.angular_velocity.norm();
  // Until the contact is certain, the gap closes up to the distance at which bodies count as
  // touching.
  const double later =
      std::max(found.impact.t_hi - time, slowness * 2 * std::max(found.impact.distance, 0.0));
  const double near =
      later * speed +
      16 * epsilon * (reach + motion.pose.translation.norm() + found.impact.t_hi * speed);
  const Affine<double> pose = motion.at(time);
  for (const HalfSpace& one : half_spaces_)
    if (one.object != object && (one.masks.category & mask) != 0 &&
        distance_to_half_space(one.plane, moving, pose).lower <= near)
      return true;
  SignedDistanceOptions how;
  how.at_most = near;
  const Vec3<double> around = Vec3<double>::Constant(near);
  const Bounds<double> box = bounds_of(moving, pose);
  return any_body_in({box.lower - around, box.upper + around}, [&](std::uint32_t index) {
    const ContactBody& body = world_->bodies()[index];
    return objects_[index] != object && (body.category & mask) != 0 &&
           signed_distance(moving, pose, body.parts(), body.pose, how).lower <= near;
  });
}

PairDerivative SceneBodies::derivative(const PartsBody& moving, const RigidMotion& motion,
                                       const EarliestImpact& found, std::uint32_t mask,
                                       PairDerivativeError* error) const {
  PairDerivative derivative = derivative_of_impact(moving, motion, found, error);
  if (found.impact.status != ImpactStatus::hit || derivative.is_ridge ||
      !is_another_touched(moving, motion, found, mask, derivative.a.by_velocity.norm()))
    return derivative;
  derivative.is_ridge = true;
  if (error) *error = {};
  return derivative;
}

PairDerivative SceneBodies::derivative_of_impact(const PartsBody& moving, const RigidMotion& motion,
                                                 const EarliestImpact& found,
                                                 PairDerivativeError* error) const {
  if (error) *error = error_of(found.impact);
  if (found.body == EarliestImpact::none)
    return derivative_of(point_, motion, point_, motion, found.impact);
  const auto object = static_cast<std::uint32_t>(found.body);
  const HalfSpace* const half_space = half_space_of(object);
  const ContactBody body = half_space ? as_box(half_space->plane, motion.pose.translation,
                                               way_of(moving, motion, found.impact.t_lo))
                                      : body_of(object);
  if (moving.shape() && body.is_shape()) {
    const PairDerivative derivative =
        derivative_of(*moving.shape(), motion, body.shape, {body.pose}, found.impact);
    if (error)
      *error = error_of(*moving.shape(), motion, body.shape, {body.pose}, found.impact, derivative);
    return derivative;
  }
  return derivative_of(moving, motion, body.parts(), {body.pose}, found.impact.t_hi);
}

}  // namespace minkray
