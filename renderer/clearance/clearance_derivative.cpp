// SPDX-License-Identifier: MIT
#include "renderer/clearance/clearance_derivative.h"
#include "core/parts/parts_contact.h"
#include "core/parts/parts_distance.h"
#include "core/parts/parts_reach.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace minkray {
namespace {

/// All bodies at one moment.
class Moment {
 public:
  Moment(const Model& posed, const std::vector<ClearanceBody>& bodies)
      : links_(link_poses(posed)), bodies_(bodies) {}

  Affine<double> pose(std::size_t index) const {
    const ClearanceBody& body = bodies_[index];
    if (body.link_index < 0) return body.pose();
    const Affine<double>& link = links_[static_cast<std::size_t>(body.link_index)];
    return body.mesh ? link * body.pose() : link;
  }

  SignedDistance distance(const BodyPair& pair, const SignedDistanceOptions& how) const {
    const Affine<double> pose_a = pose(pair.a), pose_b = pose(pair.b);
    const ClearanceBody &a = bodies_[pair.a], &b = bodies_[pair.b];
    if (a.plane) return to_plane(*a.plane, a.link_index, b, pose_b);
    if (b.plane) return turned_round(to_plane(*b.plane, b.link_index, a, pose_a));
    return signed_distance(a.parts(), pose_a, b.parts(), pose_b, how);
  }

  /// Derivative by twists about the links' origins.
  PairDerivative derivative(const BodyPair& pair, const SignedDistance& found,
                            PairDerivativeError* error, const Drift& drift) const {
    PairDerivative derivative = about_bodies(pair, found, error, drift);
    about_link(pair.a, derivative.a, error ? &error->a : nullptr);
    about_link(pair.b, derivative.b, error ? &error->b : nullptr);
    return derivative;
  }

  /// No distance of the pair is less.
  double lower_by_balls(const BodyPair& pair) const {
    const ClearanceBody &a = bodies_[pair.a], &b = bodies_[pair.b];
    if (a.plane || b.plane) return -std::numeric_limits<double>::infinity();
    const double apart = (pose(pair.b)(b.own_middle()) - pose(pair.a)(a.own_middle())).norm();
    constexpr double padding = 1e-9;
    const double sizes = a.ball_radius() + b.ball_radius();
    return apart - sizes - padding * (apart + sizes);
  }

 private:
  PairDerivative about_bodies(const BodyPair& pair, const SignedDistance& found,
                              PairDerivativeError* error, const Drift& drift) const {
    const Affine<double> pose_a = pose(pair.a), pose_b = pose(pair.b);
    const ClearanceBody &a = bodies_[pair.a], &b = bodies_[pair.b];
    if (error) *error = {};
    if (a.plane)
      return derivative_at_half_space(pose_a.translation, b.parts(), pose_b, found, error, drift);
    if (b.plane) {
      PairDerivative derivative = derivative_at_half_space(pose_b.translation, a.parts(), pose_a,
                                                           turned_round(found), error, drift);
      std::swap(derivative.a, derivative.b);
      if (error) std::swap(error->a, error->b);
      return derivative;
    }
    if (a.mesh || b.mesh) return derivative_of(a.parts(), pose_a, b.parts(), pose_b);
    return derivative_of(a.shape, pose_a, b.shape, pose_b, found, error, drift);
  }

  /// A mesh has an origin of its own on its link.
  void about_link(std::size_t index, TwistDerivative& by, TwistError* error) const {
    const ClearanceBody& body = bodies_[index];
    if (!body.mesh || body.link_index < 0) return;
    const Vec3<double> arm =
        pose(index).translation - links_[static_cast<std::size_t>(body.link_index)].translation;
    by.by_turn += arm.cross(by.by_velocity);
    if (error) error->by_turn += arm.norm() * error->by_velocity;
  }

  static SignedDistance turned_round(SignedDistance found) {
    std::swap(found.point_a, found.point_b);
    found.normal = -found.normal;
    return found;
  }

  /// A link's plane moves with it; others are fixed in the world.
  SignedDistance to_plane(PlacedPlane plane, int link, const ClearanceBody& body,
                          const Affine<double>& pose) const {
    if (link >= 0) plane = moved(plane, links_[static_cast<std::size_t>(link)]);
    return distance_to_half_space(plane, body.parts(), pose);
  }

  std::vector<Affine<double>> links_;
  const std::vector<ClearanceBody>& bodies_;
};

}  // namespace

ClearanceDerivative derivative_of(const Closest& closest, const JointPath& path,
                                  const std::vector<ClearanceBody>& bodies,
                                  const std::vector<BodyPair>& pairs, const JointWidths& joints,
                                  bool with_errors) {
  const Model posed = path.posed_at(closest.time);
  ClearanceDerivative result;
  if (!std::isfinite(closest.upper)) {
    result.by_joints = result.errors = derivative_by_joints(posed, joints, {});
    return result;
  }
  const Moment moment(posed, bodies);
  SignedDistanceOptions how;
  how = for_derivatives(how);
  const BodyPair nearest{closest.a, closest.b};
  const SignedDistance found = moment.distance(nearest, how);
  const Drift rounding = rounding_of_links(posed);
  Drift drift = rounding;
  drift.way += drift.turn * (bodies[closest.a].reach() + bodies[closest.b].reach());
  PairDerivativeError error;
  const PairDerivative derivative =
      moment.derivative(nearest, found, with_errors ? &error : nullptr, drift);
  const std::array<LinkDerivative, 2> links = {
      LinkDerivative{bodies[closest.a].link_index, derivative.a, error.a},
      LinkDerivative{bodies[closest.b].link_index, derivative.b, error.b}};
  result.by_joints = derivative_by_joints(posed, joints, links);
  result.is_ridge = derivative.is_ridge;
  how = {};
  how.at_most = found.upper;
  for (std::size_t i = 0; i < pairs.size() && !result.is_ridge; ++i) {
    const BodyPair& pair = pairs[i];
    if (pair.a == nearest.a && pair.b == nearest.b) continue;
    result.is_ridge = moment.lower_by_balls(pair) <= found.upper &&
                      moment.distance(pair, how).lower <= found.upper;
  }
  if (!with_errors) return result;
  if (result.is_ridge)
    result.errors.assign(result.by_joints.size(), std::numeric_limits<double>::infinity());
  else
    result.errors = errors_by_joints(posed, joints, links, rounding);
  return result;
}

}  // namespace minkray
