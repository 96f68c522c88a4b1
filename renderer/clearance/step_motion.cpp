// SPDX-License-Identifier: MIT
#include "renderer/clearance/step_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/support/composed_map.h"
#include "renderer/base/errors.h"
#include "renderer/import/model/orientation.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

/// Index of a joint's quaternion w, x, y, z in its values; negative if it has none.
int quaternion_at(JointKind kind) {
  if (kind == JointKind::ball) return 0;
  return kind == JointKind::free ? 3 : -1;
}

using Quaternion = Eigen::Quaterniond;

/// As link_poses takes it: one of any length is its direction, and one of length zero turns
/// nothing.
Quaternion quaternion_of(const std::vector<double>& values, int at) {
  const auto i = static_cast<std::size_t>(at);
  Quaternion q(values[i], values[i + 1], values[i + 2], values[i + 3]);
  const double largest = q.coeffs().cwiseAbs().maxCoeff();
  if (!(largest > 0)) return Quaternion::Identity();
  // The squares of others could leave the range of numbers.
  if (largest > 2 || largest < 0.25) q.coeffs() /= largest;
  return q.normalized();
}

/// True if the joint slides along an axis of its link's frame, which is exact.
bool is_exact(const ModelJoint& joint) {
  return (joint.axis.array() != 0).count() == 1;
}

/// True if the joint has values; at rest it moves nothing.
bool has_values(const ModelJoint& joint) {
  return joint.value.size() == width_of(joint.kind) && !joint.value.empty();
}

Vec3<double> first_three(const std::vector<double>& values) {
  return {values[0], values[1], values[2]};
}

/// Error in a joint's motion from one row to the next; empty if valid. Only a quaternion's
/// direction matters.
std::string mistake_of(const ModelJoint& joint, const std::vector<double>& before) {
  const std::vector<double>& now = joint.value;
  const int quaternion = quaternion_at(joint.kind);
  const auto told = [&](const char* what) {
    return "the joint \"" + printable(joint.name, 60) + "\" " + what;
  };
  if (before.empty() && !now.empty()) return told("must have a value from the first row on");
  for (std::size_t i = 0; i < now.size(); ++i) {
    char text[100] = "";
    if (!std::isfinite(now[i]))
      std::snprintf(text, sizeof text, "must be a finite number (got %g)", now[i]);
    else if (i < before.size() && (quaternion < 0 || i < static_cast<std::size_t>(quaternion)) &&
             !std::isfinite(now[i] - before[i]))
      std::snprintf(text, sizeof text,
                    "must not change by more than the range of double in one step (%g to %g)",
                    before[i], now[i]);
    if (*text) return told(text);
  }
  return "";
}

}  // namespace

JointPath::JointPath(const Model& model, const std::vector<JointRow>& rows) : skeleton(model) {
  skeleton.geoms.clear();
  skeleton.meshes.clear();
  Model posed = skeleton;
  for (const JointRow& row : rows) {
    for (const auto& [name, numbers] : row.values)
      if (ModelJoint* joint = find_joint(posed, name)) joint->value = numbers;
    follow_mimics(posed);
    times.push_back(row.time);
    std::vector<std::vector<double>> of_row;
    for (const ModelLink& link : posed.links)
      for (const ModelJoint& joint : link.joints) {
        const std::string mistake =
            mistake_of(joint, values.empty() ? joint.value : values.back()[of_row.size()]);
        if (!mistake.empty())
          throw BadInput("path: row " + std::to_string(times.size()) + " of " +
                         std::to_string(rows.size()) + ": " + mistake);
        of_row.push_back(joint.value);
      }
    values.push_back(std::move(of_row));
  }
}

bool JointPath::is_curved(std::size_t first, std::size_t last, std::size_t joint) const {
  return first != last && times[last] > times[first] && first < rates.size() &&
         last < rates.size() && !rates[first][joint].empty() && !rates[last][joint].empty();
}

JointPiece JointPath::piece(std::size_t first, std::size_t last, std::size_t joint,
                            std::size_t number) const {
  const double from = values[first][joint][number], to = values[last][joint][number];
  if (!is_curved(first, last, joint)) return {from, to};
  const double length = times[last] - times[first];
  JointEnds ends{from, to};
  ends.rates = {length * rates[first][joint][number], length * rates[last][joint][number]};
  const bool is_quintic = first < accelerations.size() && last < accelerations.size() &&
                          !accelerations[first][joint].empty() &&
                          !accelerations[last][joint].empty();
  if (!is_quintic) return JointPiece::cubic(ends);
  ends.accelerations = {length * length * accelerations[first][joint][number],
                        length * length * accelerations[last][joint][number]};
  return JointPiece::quintic(ends);
}

namespace {

/// A joint's numbers between two rows.
std::vector<double> values_between(const JointPath& path, std::size_t first, std::size_t last,
                                   std::size_t joint, JointKind kind, double s) {
  const std::vector<double>&from = path.values[first][joint], &to = path.values[last][joint];
  std::vector<double> values(from.size());
  for (std::size_t i = 0; i < from.size(); ++i)
    values[i] = path.piece(first, last, joint, i).at(s).high;
  if (const int at = quaternion_at(kind); at >= 0 && !values.empty()) {
    const Quaternion q = quaternion_of(from, at).slerp(s, quaternion_of(to, at));
    const double numbers[4] = {q.w(), q.x(), q.y(), q.z()};
    std::copy(numbers, numbers + 4, values.begin() + at);
  }
  return values;
}

}  // namespace

Model JointPath::posed_at(double time) const {
  const auto after =
      static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
  const std::size_t first = after > 0 ? after - 1 : 0, last = std::min(first + 1, times.size() - 1);
  const double length = times[last] - times[first];
  const double s = length > 0 ? (time - times[first]) / length : 0;
  Model posed = skeleton;
  std::size_t at = 0;
  for (ModelLink& link : posed.links)
    for (ModelJoint& joint : link.joints) {
      joint.value =
          s == 0 ? values[first][at] : values_between(*this, first, last, at, joint.kind, s);
      ++at;
    }
  return posed;
}

StepMotion::Rate StepMotion::rate_of(const ModelJoint& joint, std::size_t at) const {
  const std::vector<double>&from = path_.values[first_][at], &to = path_.values[last_][at];
  Rate rate;
  if (from.empty() || from.size() != to.size() || from.size() != width_of(joint.kind)) return rate;
  rate.has_values = true;
  const auto piece = [&](std::size_t number) { return path_.piece(first_, last_, at, number); };
  // Curved pieces are computed in more steps, and each step rounds.
  const auto angle_of = [](const JointPiece& of) {
    return of.largest() + (of.is_straight() ? 0 : 4 * of.way());
  };
  if (const int q = quaternion_at(joint.kind); q >= 0)
    rate.turn = quaternion_of(from, q).angularDistance(quaternion_of(to, q));
  switch (joint.kind) {
    case JointKind::hinge: {
      const JointPiece angle = piece(0);
      rate.angle = angle_of(angle) + std::abs(joint.reference);
      rate.turn = angle.fastest();
      rate.turn_change = angle.most_bent();
      break;
    }
    case JointKind::slide: {
      const JointPiece length = piece(0);
      rate.slide = length.fastest();
      rate.slide_change = length.most_bent();
      if (!length.is_straight()) rate.way = length.way();
      rate.offset = length.is_straight() ? std::max(std::abs(from[0] - joint.reference),
                                                    std::abs(to[0] - joint.reference))
                                         : length.largest() + std::abs(joint.reference);
      break;
    }
    case JointKind::planar: {
      const JointPiece x = piece(0), y = piece(1), angle = piece(2);
      const bool is_straight = x.is_straight() && y.is_straight();
      rate.slide = std::hypot(x.fastest(), y.fastest());
      rate.slide_change = std::hypot(x.most_bent(), y.most_bent());
      if (!is_straight) rate.way = x.way() + y.way();
      rate.offset = is_straight ? std::max(std::hypot(from[0], from[1]), std::hypot(to[0], to[1]))
                                : std::hypot(x.largest(), y.largest());
      rate.angle = angle_of(angle);
      rate.turn = angle.fastest();
      rate.turn_change = angle.most_bent();
      break;
    }
    case JointKind::free:
      rate.slide = (first_three(to) - first_three(from)).norm();
      rate.offset = std::max(first_three(from).norm(), first_three(to).norm());
      rate.is_absolute = true;
      break;
    case JointKind::ball:
    case JointKind::fixed:
      break;
  }
  return rate;
}

StepMotion::StepMotion(const JointPath& path, std::size_t step)
    : path_(path),
      first_(step),
      last_(std::min(step + 1, path.times.size() - 1)),
      begin_(path.times[first_]),
      end_(path.times[last_]),
      model_(path.skeleton) {
  std::size_t at = 0;
  for (const ModelLink& link : model_.links) {
    rates_.emplace_back();
    bool is_absolute = false;
    for (const ModelJoint& joint : link.joints) {
      rates_.back().push_back(rate_of(joint, at++));
      is_absolute |= rates_.back().back().is_absolute;
    }
    parents_.push_back(is_absolute ? -1 : link.parent);
  }
}

/// Translation of the link's origin by the joint's values, along the link's axes at rest, or in the
/// world of a free joint. In twice the digits where lengths may be large.
TwoFoldVec3<double> StepMotion::shift_of(const ModelJoint& joint, std::size_t at, double s) const {
  const auto along = [](const Vec3<double>& axis, const TwoFold<double>& length) {
    return TwoFoldVec3<double>(length.high * axis, length.low * axis);
  };
  const auto number = [&](std::size_t i) { return path_.piece(first_, last_, at, i).at(s); };
  switch (joint.kind) {
    case JointKind::slide:
      return along(joint.axis, number(0) + TwoFold<double>{-joint.reference, 0});
    case JointKind::planar: {
      const auto [u, v] = directions_across(joint.axis);
      return along(u, number(0)) + along(v, number(1));
    }
    case JointKind::free: {
      TwoFoldVec3<double> origin;
      for (int i = 0; i < 3; ++i) origin.set(i, number(static_cast<std::size_t>(i)));
      return origin;
    }
    default:
      return motion_of(joint).translation;
  }
}

const StepMotion::Places& StepMotion::places_at(double s) {
  if (const auto known = kept_.find(s); known != kept_.end()) return known->second;
  Places places;
  std::size_t at = 0;
  for (ModelLink& link : model_.links) {
    Mat3<double> linear = Mat3<double>::Identity();
    TwoFoldVec3<double> origin;
    if (link.parent >= 0) {
      const auto parent = static_cast<std::size_t>(link.parent);
      linear = places.poses[parent].linear;
      origin = places.origin(parent);
    }
    const auto go_on = [&](const TwoFoldVec3<double>& shift, const Mat3<double>& turn) {
      origin = origin + TwoFoldVec3<double>(linear * shift.high, linear * shift.low);
      linear = linear * turn;
    };
    go_on(link.rest.translation, link.rest.linear);
    for (ModelJoint& joint : link.joints) {
      const std::size_t index = at++;
      joint.value = values_between(path_, first_, last_, index, joint.kind, s);
      if (!has_values(joint)) continue;
      if (joint.kind == JointKind::free) {
        linear.setIdentity();
        origin = {};
        const std::vector<double>& q = joint.value;
        go_on(shift_of(joint, index, s), rotation_of_quaternion(q[4], q[5], q[6], q[3]));
      } else {
        go_on(shift_of(joint, index, s), motion_of(joint).linear);
      }
    }
    places.poses.push_back({linear, origin.high});
    places.lows.push_back(origin.low);
  }
  return kept_.emplace(s, std::move(places)).first->second;
}

MotionBound StepMotion::bound(int link, int ancestor, double reach) const {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  // A turn's numbers, and those of its product with others, are rounded by no more.
  constexpr double of_turns = 8 * epsilon, of_slides = 8 * epsilon;
  MotionBound bound{reach, 0, 0};
  bool is_in_world = false;
  for (int at = link; at != ancestor && at >= 0 && !is_in_world;) {
    const auto index = static_cast<std::size_t>(at);
    const ModelLink& of = model_.links[index];
    for (std::size_t j = of.joints.size(); j-- > 0 && !is_in_world;) {
      const ModelJoint& joint = of.joints[j];
      const Rate& rate = rates_[index][j];
      const bool has_anchor = joint.kind == JointKind::hinge || joint.kind == JointKind::ball;
      const double arm = has_anchor ? joint.anchor.norm() : 0;
      bound.reach += arm;
      if (rate.has_values) {
        if (joint.kind != JointKind::slide)
          bound.rounding += (of_turns + 2 * epsilon * rate.angle) * bound.reach;
        bound.rounding += of_slides * (arm + rate.slide + rate.way);
        const bool is_rounded = joint.kind != JointKind::free && !is_exact(joint);
        if (is_rounded) bound.rounding += of_slides * rate.offset;
      }
      if (rate.turn > 0) {  // zero times a bound that is infinite is no number
        bound.acceleration += rate.turn * (rate.turn * bound.reach + 2 * bound.speed);
        if (rate.turn_change > 0) bound.acceleration += rate.turn_change * bound.reach;
        bound.speed += rate.turn * bound.reach;
      }
      bound.speed += rate.slide;
      bound.acceleration += rate.slide_change;
      bound.reach += arm + rate.offset;
      is_in_world = rate.is_absolute;
    }
    if (!is_in_world) {
      if (!is_along_axes(of.rest.linear)) bound.rounding += of_turns * bound.reach;
      bound.reach += of.rest.translation.norm();
    }
    at = parents_[index];
  }
  // Padding for the poses' own roundings.
  constexpr double padding = 1 + 1e-12;
  bound.reach *= padding;
  bound.speed *= padding;
  bound.acceleration *= padding;
  return bound;
}

double StepMotion::turn_error(int link) const {
  constexpr double of_turns = 8 * std::numeric_limits<double>::epsilon();
  double error = 0;
  for (int at = link; at >= 0; at = parents_[static_cast<std::size_t>(at)]) {
    const auto index = static_cast<std::size_t>(at);
    if (!is_along_axes(model_.links[index].rest.linear)) error += of_turns;
    for (const Rate& rate : rates_[index])
      if (rate.has_values) error += of_turns;
  }
  return error;
}

int StepMotion::common_ancestor(int a, int b) const {
  // A link's index is larger than its parent's.
  while (a != b) {
    int& further = a > b ? a : b;
    further = parents_[static_cast<std::size_t>(further)];
  }
  return a;
}

}  // namespace minkray
