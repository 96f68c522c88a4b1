// SPDX-License-Identifier: MIT
#include "renderer/scene/motion.h"

#include <algorithm>
#include <cmath>

namespace minkray {
namespace {

using Quaternion = std::array<double, 4>;

/// Below this sine of the angle between two quaternions a line between them is as good as the arc:
/// they differ by the sine's square, and dividing by it would only add noise.
constexpr double small_sine = 1e-6;

/// Maps whose axes differ by more in length or angle are uneven.
constexpr double most_uneven = 1e-9;

struct BetweenKeys {
  const PoseKey *from, *to;
  double fraction;
};

/// The keys around a time; the same one twice beyond the ends.
BetweenKeys between(const std::vector<PoseKey>& keys, double time) {
  const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                      [](double t, const PoseKey& key) { return t < key.time; });
  if (after == keys.begin()) return {&keys.front(), &keys.front(), 0};
  if (after == keys.end()) return {&keys.back(), &keys.back(), 0};
  const PoseKey &from = *(after - 1), &to = *after;
  return {&from, &to, (time - from.time) / (to.time - from.time)};
}

Quaternion slerp(const Quaternion& a, Quaternion b, double fraction) {
  double cosine = 0;
  for (std::size_t i = 0; i < 4; ++i) cosine += a[i] * b[i];
  // A quaternion and its negative are the same rotation; the nearer one is the shorter way.
  if (cosine < 0)
    for (double& entry : b) entry = -entry;
  cosine = std::abs(cosine);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  double of_a = 1 - fraction, of_b = fraction;
  if (sine > small_sine) {
    const double angle = std::atan2(sine, cosine);
    of_a = std::sin((1 - fraction) * angle) / sine;
    of_b = std::sin(fraction * angle) / sine;
  }
  Quaternion q;
  for (std::size_t i = 0; i < 4; ++i) q[i] = of_a * a[i] + of_b * b[i];
  return q;
}

Quaternion slerp(const BetweenKeys& at) {
  return at.fraction == 0 ? at.from->rotate : slerp(at.from->rotate, at.to->rotate, at.fraction);
}

Vec3<double> lerp(const BetweenKeys& at) {
  if (at.fraction == 0) return at.from->translate;
  return at.from->translate + at.fraction * (at.to->translate - at.from->translate);
}

}  // namespace

Vec3<double> Motion::translation_at(double time) const {
  return lerp(between(keys, time));
}

Affine<double> Motion::pose_at(double time) const {
  const BetweenKeys at = between(keys, time);
  const Quaternion q = slerp(at);
  return Affine<double>{rotation_matrix(q[0], q[1], q[2], q[3]), lerp(at)} * rest;
}

std::optional<Motion> Motion::posed(const Affine<double>& frame) const {
  const bool turns = std::ranges::any_of(keys, [](const PoseKey& key) {
    return key.rotate != Quaternion{0, 0, 0, 1} && key.rotate != Quaternion{0, 0, 0, -1};
  });
  Motion made{keys, {frame.linear * rest.linear, frame.linear * rest.translation}};
  // G K rest is (Q K Q^-1 moved) G rest, where the map G is Q and a scale: axes turn with Q.
  const double size = std::cbrt(std::abs(frame.linear.determinant()));
  const Mat3<double> turn = frame.linear / size;
  const double uneven = (turn * turn.transpose() - Mat3<double>::Identity()).norm();
  if (turns && !(uneven < most_uneven)) return std::nullopt;
  const double handed = turn.determinant() < 0 ? -1 : 1;
  for (PoseKey& key : made.keys) {
    key.translate = frame(key.translate);
    if (!turns) continue;
    const Vec3<double> axis =
        handed * (turn * Vec3<double>(key.rotate[0], key.rotate[1], key.rotate[2]));
    key.rotate = {axis.x(), axis.y(), axis.z(), key.rotate[3]};
  }
  return made;
}

Movement<double> Motion::movement(double begin, double end) const {
  const BetweenKeys first = between(keys, begin), last = between(keys, end);
  const Quaternion a = slerp(first), b = slerp(last);
  // b a^-1 is what is turned between; by the shorter way its w is not negative.
  Vec3<double> xyz = a[3] * Vec3<double>(b[0], b[1], b[2]) - b[3] * Vec3<double>(a[0], a[1], a[2]) -
                     Vec3<double>(b[0], b[1], b[2]).cross(Vec3<double>(a[0], a[1], a[2]));
  double w = 0;
  for (std::size_t i = 0; i < 4; ++i) w += a[i] * b[i];
  if (w < 0) xyz = -xyz;

  Movement<double> movement;
  movement.pivot = lerp(first);
  movement.shift = lerp(last) - movement.pivot;
  const double sine = xyz.norm();
  if (a == b || !(sine > 0)) return movement;
  movement.angle = 2 * std::atan2(sine, std::abs(w));
  movement.axis = xyz / sine;
  return movement;
}

}  // namespace minkray
