// SPDX-License-Identifier: MIT
// Rays and motions in the plane of flat shapes, which are met there as any figure in the plane is:
// compared with clipping by the sides of the figure's hull.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "core/cast/packet_cast.h"
#include "renderer/paper/shape_cast.h"
#include "tests/support/random.h"
#include "tests/support/shifted.h"

namespace minkray::testing {
namespace {

using Long = long double;
using P = Eigen::Matrix<Long, 2, 1>;

/// x times y, as seen from above.
Long cross(const P& x, const P& y) {
  return x.x() * y.y() - x.y() * y.x();
}

/// Counterclockwise (Andrew's chain); two points stay two.
std::vector<P> hull_of(std::vector<P> points) {
  std::sort(points.begin(), points.end(), [](const P& a, const P& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<P> chain;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = chain.size();
    for (const P& p : points) {
      while (chain.size() >= begin + 2 &&
             cross(chain.back() - chain[chain.size() - 2], p - chain.back()) <= 0)
        chain.pop_back();
      chain.push_back(p);
    }
    chain.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return chain;
}

struct Inside {
  Long from = -1e30L, to = 1e30L;
  bool is_empty() const { return from > to; }
};

Inside clip(const std::vector<P>& hull, const P& o, const P& d, Long grown) {
  Inside inside;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const P& a = hull[i];
    const P along = hull[(i + 1) % hull.size()] - a;
    const P out = P(along.y(), -along.x()).normalized();
    const Long room = out.dot(a - o) + grown, slope = out.dot(d);
    if (slope < 0) inside.from = std::max(inside.from, room / slope);
    if (slope > 0) inside.to = std::min(inside.to, room / slope);
    if (slope == 0 && room < 0) inside.to = -1e31L;
  }
  return inside;
}

/// Result for the figure's hull; nothing where the ray passes too near to its silhouette.
std::optional<Status> status_of(const std::vector<P>& points, const P& o, const P& d, Long band,
                                Long& t) {
  const std::vector<P> hull = hull_of(points);
  const Inside grown = clip(hull, o, d, band);
  if (hull.size() > 2) {
    const Inside shrunk = clip(hull, o, d, -band);
    if (grown.is_empty() != shrunk.is_empty()) return std::nullopt;
  } else if (!grown.is_empty()) {  // a segment's ends
    const P along = hull[1] - hull[0];
    const Long at = cross(o - hull[0], d) / cross(along, d);
    if (std::min(std::abs(at), std::abs(at - 1)) < band) return std::nullopt;
    if (at < 0 || at > 1) return Status::miss;
    t = cross(along, hull[0] - o) / cross(along, d);
    if (std::abs(t) < band) return std::nullopt;
    return t < 0 ? Status::miss : Status::hit;
  }
  if (grown.is_empty() || grown.to < 0) return Status::miss;
  t = clip(hull, o, d, 0).from;
  if (std::min(std::abs(grown.from), std::abs(grown.to)) < 4 * band) return std::nullopt;
  return grown.from > 0 ? Status::hit : Status::inside;
}

/// A number that float holds exactly.
double coarse(Random& random) {
  return static_cast<double>(random.below(4097) - 2048) / 1024;
}

/// A point in the plane that `axis` is at right angles to.
Vec3<double> in_space(int axis, double x, double y) {
  Vec3<double> p = Vec3<double>::Zero();
  p[(axis + 1) % 3] = x;
  p[(axis + 2) % 3] = y;
  return p;
}
P in_plane(int axis, const Vec3<double>& p) {
  return {Long(p[(axis + 1) % 3]), Long(p[(axis + 2) % 3])};
}

Shape figure(const std::vector<Vec3<double>>& points, int kind) {
  if (points.size() == 2) return Segment{{points[0], points[1]}};
  if (points.size() == 3 && kind == 0) return Triangle{{points[0], points[1], points[2]}};
  return Hull{PointCloud(points)};
}

std::vector<Vec3<double>> some_points(Random& random, int axis, int count) {
  std::vector<Vec3<double>> points;
  while (static_cast<int>(points.size()) < count)
    points.push_back(in_space(axis, coarse(random), coarse(random)));
  return points;
}

TEST(FlatShapes, are_met_in_their_planes) {
  Random random(11);
  int hits = 0, insides = 0, misses = 0;
  for (int i = 0; i < 5000; ++i) {
    const int axis = random.below(3), count = 2 + random.below(5);
    const std::vector<Vec3<double>> points = some_points(random, axis, count);
    std::vector<P> flat;
    for (const Vec3<double>& p : points) flat.push_back(in_plane(axis, p));
    if (std::abs(cross(flat[1] - flat[0], flat.back() - flat[0])) < 0.05L && count > 2) continue;
    const Vec3<double> origin = in_space(axis, 2 * coarse(random), 2 * coarse(random));
    const Vec3<double> direction = in_space(axis, coarse(random), coarse(random));
    if (direction.isZero(0)) continue;
    if (count == 2 && std::abs(cross(flat[1] - flat[0], in_plane(axis, direction))) < 0.01L)
      continue;
    Long t = 0;
    const auto exact = status_of(flat, in_plane(axis, origin), in_plane(axis, direction), 1e-4L, t);
    if (!exact) continue;
    const PreparedShape shape(figure(points, random.below(2)));
    const Ray<double> ray{origin, direction};
    const CastResult<double> answer = cast_ray(shape, ray);
    ASSERT_EQ(name_of(answer.status), name_of(*exact)) << i;
    RayPacket packet;
    for (int lane = 0; lane < packet_lanes; ++lane) packet.set(lane, ray);
    CastPacket together;
    cast_packet(shape, packet, LaneBits(1), together);
    const CastResult<double> lane = together.result(0);
    ASSERT_EQ(name_of(lane.status), name_of(*exact)) << i;
    ASSERT_EQ(lane.normal, answer.normal) << i;
    ++(*exact == Status::hit ? hits : *exact == Status::inside ? insides : misses);
    if (*exact != Status::hit) continue;
    const double tolerance = 300 * std::numeric_limits<double>::epsilon();
    const double slope = std::abs(double(answer.normal.dot(ray.direction)));
    ASSERT_LE(std::abs(double(answer.t()) - double(t)) * std::max(slope, 1e-3), tolerance) << i;
    const Vec3<double> n = answer.normal;
    ASSERT_NEAR(double(n.norm()), 1, 1e-5);
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(insides, 100);
  EXPECT_GT(misses, 500);
}

TEST(FlatShapes, meet_others_in_the_same_plane) {
  Random random(12);
  int hits = 0, insides = 0, misses = 0;
  for (int i = 0; i < 1500; ++i) {
    const int axis = random.below(3);
    const std::vector<Vec3<double>> a = some_points(random, axis, 2 + random.below(3)),
                                    b = some_points(random, axis, 2 + random.below(3));
    const Vec3<double> shift = in_space(axis, 4 * coarse(random), 4 * coarse(random));
    const Vec3<double> direction = in_space(axis, coarse(random), coarse(random));
    std::vector<P> differences;
    for (const Vec3<double>& p : a)
      for (const Vec3<double>& q : b) differences.push_back(in_plane(axis, p - q - shift));
    // Two segments must not be parallel.
    const std::vector<P> hull = hull_of(differences);
    if (hull.size() < 3 || direction.isZero(0)) continue;
    Long area = 0;
    for (std::size_t k = 2; k < hull.size(); ++k)
      area += cross(hull[k - 1] - hull[0], hull[k] - hull[0]);
    if (area < 0.3L) continue;
    Long t = 0;
    const auto exact = status_of(differences, P::Zero(), in_plane(axis, direction), 1e-4L, t);
    if (!exact) continue;
    const PreparedPair pair(centred(figure(a, 0)), centred(figure(b, 0), shifted_by(shift)));
    const ShapeCastResult answer =
        cast_shape(pair, direction, std::numeric_limits<double>::infinity());
    ASSERT_EQ(name_of(answer.cast.status), name_of(*exact)) << i;
    ++(*exact == Status::hit ? hits : *exact == Status::inside ? insides : misses);
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(insides, 30);
  EXPECT_GT(misses, 200);
}

TEST(FlatShapes, that_are_thinner_than_rounding_as_well) {
  const double thin = 4.0 * std::numeric_limits<double>::epsilon();
  const PreparedShape wedge(
      Shape(Hull{PointCloud({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0.25, thin}})}));
  const CastResult<double> answer = cast_ray(wedge, Ray<double>{{0.125, -4, 0}, {0, 1, 0}});
  EXPECT_EQ(name_of(answer.status), name_of(Status::hit));
  EXPECT_EQ(answer.t(), 4.0);
}

}  // namespace
}  // namespace minkray::testing
