// SPDX-License-Identifier: MIT
#include "renderer/clearance/clearance_derivative.h"
#include "core/parts/parts_contact.h"
#include "core/parts/parts_distance.h"
#include "core/parts/parts_reach.h"

#include <algorithm>
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

  /// Region of all nearest points of a pair on a ridge; see contact_region().
  ContactRegion region(const BodyPair& pair, const SignedDistance& found) const {
    const Affine<double> pose_a = pose(pair.a), pose_b = pose(pair.b);
    const ClearanceBody &a = bodies_[pair.a], &b = bodies_[pair.b];
    if (a.mesh || b.mesh) return {};
    if (a.plane) return region_at_half_space(b.shape, pose_b, found);
    if (b.plane) return region_at_half_space(a.shape, pose_a, turned_round(found));
    return contact_region(a.shape, pose_a, b.shape, pose_b, found);
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

/// Derivatives by joints, at all nearest points and of all pairs that are as near.
class JointsAt {
 public:
  JointsAt(const Model& posed, const std::vector<ClearanceBody>& bodies, const JointWidths& joints)
      : moment(posed, bodies), posed_(posed), bodies_(bodies), joints_(joints) {}

  using Links = std::array<LinkDerivative, 2>;
  Links links(const BodyPair& pair, const PairDerivative& by,
              const PairDerivativeError& error = {}) const {
    return {LinkDerivative{bodies_[pair.a].link_index, by.a, error.a},
            LinkDerivative{bodies_[pair.b].link_index, by.b, error.b}};
  }
  std::vector<double> by_joints(const Links& links) const {
    return derivative_by_joints(posed_, joints_, links);
  }

  /// True if no joint's derivative changes from one nearest point to another.
  bool are_same_within(const ContactRegion& region, const BodyPair& pair,
                       const Vec3<double>& normal) const {
    const auto are_same_along = [&](const Vec3<double>& way) {
      const Vec3<double> turn = way.cross(normal);
      const PairDerivative change{{Vec3<double>::Zero(), -turn}, {Vec3<double>::Zero(), turn}};
      return std::ranges::all_of(by_joints(links(pair, change)),
                                 [](double by) { return std::abs(by) <= same; });
    };
    if (region.dimension == 1) return are_same_along(region.along);
    const Vec3<double> u = normal.unitOrthogonal();
    return region.dimension == 2 && are_same_along(u) && are_same_along(normal.cross(u));
  }

  bool is_ridge(const BodyPair& pair, const SignedDistance& found, const PairDerivative& by) const {
    return by.is_ridge && !are_same_within(moment.region(pair, found), pair, found.normal);
  }

  /// True if another pair, which is as near, has these derivatives, too.
  bool are_of(const BodyPair& other, const std::vector<double>& expected) const {
    const SignedDistance found = moment.distance(other, for_derivatives());
    const PairDerivative by = moment.derivative(other, found, nullptr, {});
    if (is_ridge(other, found, by)) return false;
    const std::vector<double> values = by_joints(links(other, by));
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!(std::abs(values[i] - expected[i]) <= same * (1 + std::abs(expected[i])))) return false;
    return true;
  }

  const Moment moment;

 private:
  static constexpr double same = 1e-9;

  const Model& posed_;
  const std::vector<ClearanceBody>& bodies_;
  const JointWidths& joints_;
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
  const JointsAt at(posed, bodies, joints);
  const Moment& moment = at.moment;
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
  const JointsAt::Links links = at.links(nearest, derivative, error);
  result.by_joints = at.by_joints(links);
  result.is_ridge = at.is_ridge(nearest, found, derivative);
  how = {};
  how.at_most = found.upper;
  for (std::size_t i = 0; i < pairs.size() && !result.is_ridge; ++i) {
    const BodyPair& pair = pairs[i];
    if (pair.a == nearest.a && pair.b == nearest.b) continue;
    result.is_ridge = moment.lower_by_balls(pair) <= found.upper &&
                      moment.distance(pair, how).lower <= found.upper &&
                      !at.are_of(pair, result.by_joints);
  }
  if (!with_errors) return result;
  if (result.is_ridge)
    result.errors.assign(result.by_joints.size(), std::numeric_limits<double>::infinity());
  else
    result.errors = errors_by_joints(posed, joints, links, rounding);
  return result;
}

}  // namespace minkray
