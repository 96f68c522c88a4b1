// SPDX-License-Identifier: MIT
#include "renderer/clearance/joint_derivative.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

namespace minkray {
namespace {

/// Index of a joint's numbers in the result, and the factor of a number there.
struct Leader {
  std::size_t first;
  double factor;
};

class JointNumbers {
 public:
  JointNumbers(const Model& posed, const JointWidths& joints) {
    for (const ModelLink& link : posed.links)
      for (const ModelJoint& joint : link.joints) by_name_.emplace(joint.name, &joint);
    for (const auto& [name, width] : joints) {
      first_[name] = count_;
      count_ += width;
    }
  }

  std::size_t count() const { return count_; }

  /// Nothing for joints that are not among the requested ones and do not follow one.
  std::optional<Leader> leader_of(const ModelJoint& joint) const {
    double factor = 1;
    const ModelJoint* other = &joint;
    for (std::size_t steps = 0; other->mimic && steps < longest_mimicry; ++steps) {
      factor *= other->mimic->multiplier;
      const auto next = by_name_.find(other->mimic->joint);
      if (next == by_name_.end()) return std::nullopt;
      other = next->second;
    }
    const auto known = by_name_.find(other->name);
    const auto first = first_.find(other->name);
    // Values go to the first joint of a name.
    if (first == first_.end() || known->second != other) return std::nullopt;
    if (other != &joint && (width_of(joint.kind) != 1 || width_of(other->kind) != 1))
      return std::nullopt;
    return Leader{first->second, factor};
  }

 private:
  std::unordered_map<std::string, const ModelJoint*> by_name_;
  std::unordered_map<std::string, std::size_t> first_;
  std::size_t count_ = 0;
};

/// The turn per unit of a quaternion's numbers w, x, y, z: twice the vector part of e_i q* / |q|^2.
std::array<Vec3<double>, 4> turns_by_quaternion(const double* numbers) {
  const Vec3<double> v(numbers[1], numbers[2], numbers[3]);
  const double w = numbers[0], squared = w * w + v.squaredNorm();
  std::array<Vec3<double>, 4> turns;
  turns.fill(Vec3<double>::Zero());
  if (!(squared > 0)) return turns;
  turns[0] = -2 / squared * v;
  for (int i = 0; i < 3; ++i) {
    const Vec3<double> axis = Vec3<double>::Unit(i);
    turns[static_cast<std::size_t>(i) + 1] = 2 / squared * (w * axis - axis.cross(v));
  }
  return turns;
}

/// Derivatives of a link by the motions of the links that it hangs on.
class Motions {
 public:
  Motions(const TwistDerivative& by, const Vec3<double>& origin) : by_(by), origin_(origin) {}

  double slide(const Vec3<double>& along) const { return by_.by_velocity.dot(along); }
  double turn(const Vec3<double>& axis, const Vec3<double>& about) const {
    return by_.by_velocity.dot(axis.cross(origin_ - about)) + by_.by_turn.dot(axis);
  }

 private:
  const TwistDerivative& by_;
  Vec3<double> origin_;
};

/// Bounds of their errors.
class MotionErrors {
 public:
  MotionErrors(const LinkDerivative& link, const Vec3<double>& origin, const Drift& drift)
      : link_(link), origin_(origin), drift_(drift) {}

  double slide(const Vec3<double>& along) const {
    const double speed = link_.by.by_velocity.norm();
    return times(along.norm(), link_.error.by_velocity + drift_.turn * speed);
  }
  double turn(const Vec3<double>& axis, const Vec3<double>& about) const {
    const double speed = link_.by.by_velocity.norm(), arm = (origin_ - about).norm();
    return times(axis.cross(origin_ - about).norm(), link_.error.by_velocity) +
           times(axis.norm(), link_.error.by_turn + speed * (2 * drift_.way + drift_.turn * arm) +
                                  drift_.turn * link_.by.by_turn.norm());
  }

 private:
  /// Zero for no speed, even if the error is infinite.
  static double times(double speed, double error) { return speed > 0 ? speed * error : 0; }

  const LinkDerivative& link_;
  Vec3<double> origin_;
  const Drift& drift_;
};

/// Derivatives, or their errors, by each number of the joint; `before` and `after` are the poses on
/// both sides of it.
template <class Of>
std::vector<double> by_numbers(const ModelJoint& joint, const Affine<double>& before,
                               const Affine<double>& after, const Of& motions) {
  const std::vector<double>& q = joint.value;
  switch (joint.kind) {
    case JointKind::hinge:
      return {motions.turn(before.linear * joint.axis, before(joint.anchor))};
    case JointKind::slide:
      return {motions.slide(before.linear * joint.axis)};
    case JointKind::ball: {
      std::vector<double> all;
      for (const Vec3<double>& turn : turns_by_quaternion(q.data()))
        all.push_back(motions.turn(before.linear * turn, before(joint.anchor)));
      return all;
    }
    case JointKind::planar: {
      const auto [u, v] = directions_across(joint.axis);
      return {motions.slide(before.linear * u), motions.slide(before.linear * v),
              motions.turn(before.linear * joint.axis, after.translation)};
    }
    case JointKind::free: {
      std::vector<double> all;
      for (int i = 0; i < 3; ++i) all.push_back(motions.slide(Vec3<double>::Unit(i)));
      for (const Vec3<double>& turn : turns_by_quaternion(q.data() + 3))
        all.push_back(motions.turn(turn, after.translation));
      return all;
    }
    case JointKind::fixed:
      break;
  }
  return {};
}

/// The poses before each joint of a link, and after the last one.
std::vector<Affine<double>> poses_between(const ModelLink& link, const Affine<double>& parent) {
  std::vector<Affine<double>> poses = {parent * link.rest};
  for (const ModelJoint& joint : link.joints) {
    const bool has_value = joint.value.size() == width_of(joint.kind) && !joint.value.empty();
    if (!has_value) {
      poses.push_back(poses.back());
    } else if (joint.kind == JointKind::free) {
      Model alone;
      alone.links.push_back({"", -1, {}, {joint}});
      poses.push_back(link_poses(alone)[0]);
    } else {
      poses.push_back(poses.back() * motion_of(joint));
    }
  }
  return poses;
}

/// Calls add(index, factor, numbers of the joint) for each joint between a link and the base.
template <class Of, class Add>
void for_joints_of(const Model& posed, const std::vector<Affine<double>>& poses,
                   const JointNumbers& numbers, int link_index, const Of& motions, const Add& add) {
  for (int at = link_index; at >= 0;) {
    const ModelLink& link = posed.links[static_cast<std::size_t>(at)];
    const Affine<double> parent =
        link.parent < 0 ? Affine<double>() : poses[static_cast<std::size_t>(link.parent)];
    const std::vector<Affine<double>> between = poses_between(link, parent);
    for (std::size_t j = link.joints.size(); j-- > 0;) {
      const ModelJoint& joint = link.joints[j];
      if (joint.value.size() != width_of(joint.kind) || joint.value.empty()) continue;
      if (const auto leader = numbers.leader_of(joint))
        add(*leader, by_numbers(joint, between[j], between[j + 1], motions));
      if (joint.kind == JointKind::free) return;  // places are absolute
    }
    at = link.parent;
  }
}

}  // namespace

std::vector<double> derivative_by_joints(const Model& posed, const JointWidths& joints,
                                         std::span<const LinkDerivative> links) {
  const JointNumbers numbers(posed, joints);
  std::vector<double> sum(numbers.count());
  const std::vector<Affine<double>> poses = link_poses(posed);
  for (const LinkDerivative& one : links) {
    if (one.link < 0) continue;
    const Motions motions(one.by, poses[static_cast<std::size_t>(one.link)].translation);
    for_joints_of(posed, poses, numbers, one.link, motions,
                  [&](const Leader& leader, const std::vector<double>& by) {
                    for (std::size_t i = 0; i < by.size(); ++i)
                      sum[leader.first + i] += leader.factor * by[i];
                  });
  }
  return sum;
}

std::vector<double> errors_by_joints(const Model& posed, const JointWidths& joints,
                                     std::span<const LinkDerivative> links, const Drift& rounding) {
  const JointNumbers numbers(posed, joints);
  std::vector<double> sum(numbers.count());
  const std::vector<Affine<double>> poses = link_poses(posed);
  for (const LinkDerivative& one : links) {
    if (one.link < 0) continue;
    const MotionErrors errors(one, poses[static_cast<std::size_t>(one.link)].translation, rounding);
    for_joints_of(posed, poses, numbers, one.link, errors,
                  [&](const Leader& leader, const std::vector<double>& of) {
                    for (std::size_t i = 0; i < of.size(); ++i)
                      sum[leader.first + i] += std::abs(leader.factor) * of[i];
                  });
  }
  return sum;
}

Drift rounding_of_links(const Model& posed) {
  // A product of two poses rounds each number by at most 4 epsilons of what it adds up, a joint's
  // motion and the normalization of its axis or quaternion by as much again.
  constexpr double of_product = 16 * std::numeric_limits<double>::epsilon();
  double products = 0, length = 0;
  for (const ModelLink& link : posed.links) {
    products += 1 + 2 * static_cast<double>(link.joints.size());
    length += link.rest.translation.norm();
    for (const ModelJoint& joint : link.joints) {
      length += 2 * joint.anchor.norm();
      const bool slides = joint.kind == JointKind::slide || joint.kind == JointKind::planar ||
                          joint.kind == JointKind::free;
      for (std::size_t i = 0; slides && i < std::min<std::size_t>(joint.value.size(), 3); ++i)
        length += std::abs(joint.value[i]);
    }
  }
  return {of_product * products * length, of_product * products};
}

}  // namespace minkray
