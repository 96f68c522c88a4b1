// SPDX-License-Identifier: MIT
// A small arm of balls and capsules as a URDF, and where its shapes are by kinematics and distances
// of the tests' own, in long double.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "renderer/import/scene_of_model.h"
#include "tests/renderer/import/imports.h"

namespace minkray::testing {

using Long = long double;
using Vector = Vec3<Long>;
using Pose = Affine<Long>;

/// A capsule's segment, or a ball's middle twice.
struct Rod {
  std::array<Vector, 2> ends;
  Long radius;
};

inline Long distance(const Rod& a, const Rod& b) {
  const auto to_segment = [](const Vector& p, const std::array<Vector, 2>& of) {
    const Vector e = of[1] - of[0];
    const Long squared = e.squaredNorm();
    const Long t = squared > 0 ? std::clamp<Long>((p - of[0]).dot(e) / squared, 0, 1) : 0;
    return (p - of[0] - t * e).norm();
  };
  Long best = std::min({to_segment(a.ends[0], b.ends), to_segment(a.ends[1], b.ends),
                        to_segment(b.ends[0], a.ends), to_segment(b.ends[1], a.ends)});
  const Vector u = a.ends[1] - a.ends[0], v = b.ends[1] - b.ends[0], w = b.ends[0] - a.ends[0],
               n = u.cross(v);
  const Long squared = n.squaredNorm();
  if (squared > 0) {
    const Long s = w.cross(v).dot(n) / squared, t = w.cross(u).dot(n) / squared;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
      best = std::min(best, std::abs(w.dot(n)) / std::sqrt(squared));
  }
  return best - a.radius - b.radius;
}

inline const std::string arm = R"(<robot name="arm">
  <link name="base">
    <collision><geometry><sphere radius="0.1"/></geometry></collision>
  </link>
  <link name="upper">
    <collision><origin xyz="0 0 0.5"/><geometry><capsule radius="0.08" length="0.8"/></geometry></collision>
  </link>
  <link name="fore">
    <collision><origin xyz="0 0 0.4"/><geometry><capsule radius="0.06" length="0.6"/></geometry></collision>
  </link>
  <link name="hand">
    <collision><origin xyz="0 0 0.1"/><geometry><sphere radius="0.07"/></geometry></collision>
  </link>
  <joint name="shoulder" type="continuous">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 0.1"/><axis xyz="0 1 0"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="upper"/><child link="fore"/><origin xyz="0 0 1"/><axis xyz="1 0 0"/>
  </joint>
  <joint name="wrist" type="prismatic">
    <parent link="fore"/><child link="hand"/><origin xyz="0 0 0.8"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>)";

inline Model arm_model() {
  Mistakes mistakes("arm.urdf");
  const auto model = parse_model(arm, "arm.urdf", {}, mistakes);
  EXPECT_TRUE(model) << mistakes.text();
  return *model;
}

/// Places of the arm's shapes: base, upper, fore, hand.
inline std::array<Rod, 4> rods_at(Long shoulder, Long elbow, Long wrist) {
  const auto turn = [](Long angle, const Vector& axis, const Vector& at) {
    return Pose{Eigen::AngleAxis<Long>(angle, axis).toRotationMatrix(), at};
  };
  const Pose upper = turn(shoulder, Vector::UnitY(), {0, 0, 0.1L}),
             fore = upper * turn(elbow, Vector::UnitX(), {0, 0, 1}),
             hand = fore * Pose{Mat3<Long>::Identity(), {0, 0, 0.8L + wrist}};
  const Vector zero = Vector::Zero(), z(0, 0, 1);
  return {Rod{{zero, zero}, 0.1L}, Rod{{upper(0.1L * z), upper(0.9L * z)}, 0.08L},
          Rod{{fore(0.1L * z), fore(0.7L * z)}, 0.06L},
          Rod{{hand(0.1L * z), hand(0.1L * z)}, 0.07L}};
}

/// Distance of the three links that move from a ball and from the ground.
inline Long distance_to_arm(const std::array<Rod, 4>& rods, const Rod& ball, Long ground) {
  Long best = 1e30L;
  for (std::size_t i = 1; i < 4; ++i) {
    best = std::min(best, distance(rods[i], ball));
    for (const Vector& end : rods[i].ends) best = std::min(best, end.z() - rods[i].radius - ground);
  }
  return best;
}

struct RandomPath {
  std::vector<std::array<double, 3>> values;
  std::vector<JointRow> rows;

  explicit RandomPath(std::mt19937& engine) {
    std::uniform_real_distribution<double> angle(-2.5, 2.5), length(-0.3, 0.3);
    for (int i = 0; i < 4; ++i) {
      values.push_back({angle(engine), angle(engine), length(engine)});
      rows.push_back({0.5 * i,
                      {{"shoulder", {values.back()[0]}},
                       {"elbow", {values.back()[1]}},
                       {"wrist", {values.back()[2]}}}});
    }
  }
  std::array<Rod, 4> at(Long time) const {
    const auto step = std::min<std::size_t>(2, static_cast<std::size_t>(time / 0.5L));
    const Long s = time / 0.5L - static_cast<Long>(step);
    std::array<Long, 3> q;
    for (std::size_t j = 0; j < 3; ++j)
      q[j] = values[step][j] + s * (Long(values[step + 1][j]) - Long(values[step][j]));
    return rods_at(q[0], q[1], q[2]);
  }
};

}  // namespace minkray::testing
