// SPDX-License-Identifier: MIT
// First contact of moving boxes, found by the planes that are tested before anything else: each
// result is judged by its plane and its point, and next to none is left open.
#include "core/pair_motion/swept_boxes.h"

#include <gtest/gtest.h>

#include "tests/core/pair_distance/random_bodies.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using testing::RandomShapes;

struct TwoBoxes {
  Vec3<double> half_a, half_b;
  Affine<double> pose_b;  ///< as A sees B
  Vec3<double> velocity;
  double t_max = 2;

  SweptTime swept(double near = 1e-9) const {
    const ContactShape a{Shape(Box{half_a})}, b{Shape(Box{half_b})};
    const Affine<double> pose_a;
    return swept_boxes(pair_of(a, pose_a, pose_a.linear, b, pose_b), velocity, t_max, near);
  }
  /// Between planes with normal n at a time, A behind the one and B before the other.
  double gap(const Vec3<double>& n, double t) const {
    return n.dot(pose_b.translation + t * velocity) - n.cwiseAbs().dot(half_a) -
           (pose_b.linear.transpose() * n).cwiseAbs().dot(half_b);
  }
  /// Distance of a point outside of one of them.
  double outside(const Vec3<double>& p, double t) const {
    const Vec3<double> in_b = pose_b.linear.transpose() * (p - pose_b.translation - t * velocity);
    return std::max((p.cwiseAbs() - half_a).maxCoeff(), (in_b.cwiseAbs() - half_b).maxCoeff());
  }
};

std::string complaint(const TwoBoxes& boxes, const SweptTime& found) {
  if (std::abs(found.axis.norm() - 1) > 1e-15) return "a normal that is none";
  if (found.status == SweptStatus::miss)
    return boxes.gap(found.axis, 0) > 0 && boxes.gap(found.axis, boxes.t_max) > 0
               ? ""
               : "a plane that lets them through";
  if (std::abs(boxes.gap(found.axis, found.t_lo)) > 1e-12) return "a plane that is not touched";
  if (!(found.axis.dot(boxes.velocity) < 0)) return "a plane that is not approached";
  if (!(found.t_lo <= found.t_hi) || found.t_hi - found.t_lo > 1e-9) return "wide";
  return boxes.outside(found.a, found.t_hi) <= 1e-9 ? "" : "a point of only one";
}

TEST(SweptBoxes, are_told_by_a_plane_and_a_point) {
  RandomShapes random(41);
  int hits = 0, misses = 0, open = 0;
  for (int k = 0; k < 4000; ++k) {
    const auto half = [&]() -> Vec3<double> {
      return {random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1)};
    };
    TwoBoxes boxes{half(), half(), {random.turn(), 4 * random.direction().normalized()}, {}};
    // Towards A, or past it, and some too slow to arrive.
    boxes.velocity =
        random.in(0.2, 4) * (random.in(0, 2) * random.direction() - boxes.pose_b.translation / 4);
    const SweptTime found = boxes.swept();
    if (found.status == SweptStatus::open) {
      ++open;
      continue;
    }
    (found.status == SweptStatus::hit ? hits : misses) += 1;
    ASSERT_EQ(complaint(boxes, found), "") << k;
  }
  EXPECT_GT(hits, 400);
  EXPECT_GT(misses, 1500);
  EXPECT_EQ(open, 0);
}

TEST(SweptBoxes, with_parallel_sides_that_pass_beside_or_behind_each_other_miss) {
  const Vec3<double> half{1, 1, 1};
  for (const auto& [place, velocity] :
       {std::pair{Vec3<double>(5, 3, 0), Vec3<double>(-1, 0, 0)},  // off the way
        std::pair{Vec3<double>(5, -3, 0), Vec3<double>(-1, 0, 0)},
        std::pair{Vec3<double>(5, 0, 0), Vec3<double>(1, 0, 0)},         // away
        std::pair{Vec3<double>(9, 0, 0), Vec3<double>(-1, 0, 0)},        // later than that
        std::pair{Vec3<double>(3, 5, 0), Vec3<double>(-1, -0.5, 0)}}) {  // past a corner
    const TwoBoxes boxes{half, half, shifted_by(place), velocity, 5};
    const SweptTime found = boxes.swept();
    EXPECT_EQ(found.status, SweptStatus::miss) << place.transpose();
    EXPECT_EQ(complaint(boxes, found), "") << place.transpose();
  }
}

TEST(SweptBoxes, that_meet_with_a_corner_do_so_where_it_is) {
  // B's diagonal lies along x.
  Mat3<double> turn;
  turn.col(0) = Vec3<double>(1, std::sqrt(2), 0) / std::sqrt(3);
  turn.col(1) = Vec3<double>(1, -1 / std::sqrt(2), std::sqrt(1.5)) / std::sqrt(3);
  turn.col(2) = Vec3<double>(1, -1 / std::sqrt(2), -std::sqrt(1.5)) / std::sqrt(3);
  const TwoBoxes boxes{{1, 1, 1}, {1, 1, 1}, {turn, {5, 0.25, 0.5}}, {-1, 0, 0}, 10};
  const SweptTime found = boxes.swept();
  ASSERT_EQ(found.status, SweptStatus::hit);
  EXPECT_EQ(complaint(boxes, found), "");
  EXPECT_NEAR(found.t_lo, 4 - std::sqrt(3), 1e-13);
  EXPECT_LT((found.a - Vec3<double>(1, 0.25, 0.5)).norm(), 1e-12);
}

TEST(SweptBoxes, that_begin_in_contact_or_graze_are_left_to_others) {
  const Mat3<double> I = Mat3<double>::Identity();
  for (const TwoBoxes& boxes :
       {TwoBoxes{{1, 1, 1}, {1, 1, 1}, {I, {1.5, 0.5, 0}}, {0, 0, 0}},   // at rest
        TwoBoxes{{1, 1, 1}, {1, 1, 1}, {I, {5, 2, 0}}, {-1, 0, 0}, 9}})  // along a side
    EXPECT_EQ(boxes.swept().status, SweptStatus::open);
}

/// The least gap between planes with normal n from 0 to t_max, to more digits.
long double gap_of_all_times(const TwoBoxes& boxes, const Vec3<double>& normal) {
  using Long = long double;
  const Vec3<Long> n = normal.cast<Long>(), place = boxes.pose_b.translation.cast<Long>(),
                   in_b = boxes.pose_b.linear.cast<Long>().transpose() * n;
  const Long first = n.dot(place) - n.cwiseAbs().dot(boxes.half_a.cast<Long>()) -
                     in_b.cwiseAbs().dot(boxes.half_b.cast<Long>());
  return (first + std::min<Long>(0, boxes.t_max * n.dot(boxes.velocity.cast<Long>()))) / n.norm();
}

/// The planes' own gap is set as near enough, so that the distance is not more than that.
TEST(SweptBoxes, that_are_no_further_apart_than_is_near_enough_are_no_miss) {
  RandomShapes random(43);
  int misses = 0;
  for (int k = 0; k < 1000; ++k) {
    TwoBoxes boxes{{1, 0.7, 0.4}, {0.6, 0.9, 0.3}, {random.turn(), 4 * random.direction()}, {}};
    boxes.velocity = random.in(0.2, 4) * random.direction();
    const SweptTime found = boxes.swept();
    if (found.status != SweptStatus::miss) continue;
    ++misses;
    const long double gap = gap_of_all_times(boxes, found.axis);
    ASSERT_GT(gap, 1e-9) << k;
    const double near = std::nextafter(static_cast<double>(gap), 1e300);
    const SweptTime again = boxes.swept(near);
    if (again.status == SweptStatus::miss) {
      EXPECT_GT(gap_of_all_times(boxes, again.axis), near) << k;
    }
    // A little less is enough for a miss.
    EXPECT_EQ(boxes.swept(near - 1e-12).status, SweptStatus::miss) << k;
  }
  EXPECT_GT(misses, 800);
}

/// Viewed along the motion, two edges are in one line: what happens if they came so far cannot be
/// decided, but they do not.
TEST(SweptBoxes, that_would_graze_with_two_edges_but_do_not_come_so_far_miss) {
  RandomShapes random(44);
  for (int k = 0; k < 200; ++k) {
    const Mat3<double> turn = random.turn();
    TwoBoxes boxes{{1, 1, 1}, {1, 1, 1}, {turn, {9, 0, 0}}, {-1, 0, 0}};
    const Vec3<double> across = Vec3<double>::UnitX().cross(turn.col(k % 3)).normalized();
    boxes.pose_b.translation -= boxes.gap(across, 0) * across;
    const SweptTime found = boxes.swept();
    EXPECT_EQ(found.status, SweptStatus::miss) << k;
    EXPECT_EQ(complaint(boxes, found), "") << k;
  }
}

/// Offset of the first corner from the other's face.
TEST(SweptBoxes, that_meet_with_faces_are_told_no_point_beside_one_of_them) {
  int hits = 0;
  for (const double beside : {-1e-10, -1e-11, 0.0, 1e-11, 1e-10})
    for (const int side : {1, 2}) {
      TwoBoxes boxes{{1, 1, 1}, {1, 1, 1}, shifted_by(5, 0, 0), {-1, 0, 0}, 9};
      boxes.pose_b.translation[side] = beside;
      const SweptTime found = boxes.swept();
      if (found.status != SweptStatus::hit) continue;
      ++hits;
      EXPECT_LE(boxes.outside(found.a, found.t_hi), 4e-12) << beside;
    }
  EXPECT_GT(hits, 0);
}

/// Rounding moves the crossing along the edges, by 1e-16 over the squared angle, and so across one
/// of them by 1e-16 over the angle, which is a millionth of a millionth here.
TEST(SweptBoxes, with_edges_that_are_nearly_parallel_meet_where_these_cross) {
  RandomShapes random(45);
  const double h = std::sqrt(0.5);
  for (int k = 0; k < 200; ++k) {
    // The edges of both that are along x lead, and B's is turned about the motion.
    const double angle = random.in(2e-4, 3e-4);
    const Vec3<double> up(0, h, h),
        along(std::cos(angle), h * std::sin(angle), -h * std::sin(angle));
    const Vec3<double> aside = up.cross(along);
    Mat3<double> turn;
    turn.col(0) = along;
    turn.col(1) = h * (up + aside);
    turn.col(2) = h * (up - aside);
    if (turn.determinant() < 0) turn.col(2).swap(turn.col(1));
    const double x = random.in(-0.9, 0.9);
    const TwoBoxes boxes{{1, 1, 1}, {1, 1, 1}, {turn, 5 * up + x * along}, -up, 9};
    const SweptTime found = boxes.swept();
    ASSERT_EQ(found.status, SweptStatus::hit) << k;
    EXPECT_LE(boxes.outside(found.a, found.t_hi), 4e-12) << k;
    EXPECT_NEAR(found.t_lo, 5 - 2 * std::sqrt(2), 1e-12) << k;
  }
}

}  // namespace
}  // namespace minkray
