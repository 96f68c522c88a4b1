// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/bounds.h"
#include "core/parts/one_part.h"
#include "core/parts/pair_walk.h"
#include "core/parts/parts_contact.h"
#include "core/parts/parts_distance.h"

namespace minkray {
namespace {

/// Limit of pairs of parts whose points are collected: the bodies may cross in any number.
constexpr std::size_t most_pairs = 256;

/// Contact points of two parts that are near.
struct PartContact {
  Vec3<double> normal = Vec3<double>::Zero();
  std::vector<ContactPoint> points;  ///< the first are the nearest
  double area = 0;                   ///< of the points' box across the normal

  PartContact(const OnePart& a, const Affine<double>& pose_a, const OnePart& b,
              const Affine<double>& pose_b, const SignedDistance& found)
      : normal(found.normal) {
    add_contact_points(a.shape(), pose_a, b.shape(), pose_b, found, points);
    const Vec3<double> e0 = normal.isZero(0) ? normal : normal.unitOrthogonal();
    const Vec3<double> e1 = normal.cross(e0);
    Bounds<double> across;
    for (const ContactPoint& point : points)
      across.extend({e0.dot(point.point_a), e1.dot(point.point_a), 0});
    if (!points.empty())
      area = (across.upper.x() - across.lower.x()) * (across.upper.y() - across.lower.y());
  }
};

/// The point furthest from the middle of those that are as near as the nearest.
ContactPoint outermost(const std::vector<ContactPoint>& points, double least) {
  Vec3<double> middle = Vec3<double>::Zero();
  double count = 0;
  for (const ContactPoint& point : points)
    if (point.distance <= least) {
      middle += point.point_a;
      ++count;
    }
  middle /= count;
  return *std::ranges::max_element(points, {}, [&](const ContactPoint& point) {
    return point.distance <= least ? (point.point_a - middle).norm() : -1.0;
  });
}

}  // namespace

ContactManifold contact_manifold(const PartsBody& a, const Affine<double>& pose_a,
                                 const PartsBody& b, const Affine<double>& pose_b) {
  PartPair parts;
  signed_distance(a, pose_a, b, pose_b, {}, &parts);
  if ((a.mesh() && parts.a == no_part) || (b.mesh() && parts.b == no_part)) return {};
  const ManifoldOptions options;
  const BodyTree tree_a(a), tree_b(b);
  const Sight sight(tree_a, pose_a, tree_b, pose_b);
  const double size = std::min(tree_a.radius(), tree_b.radius());
  double limit = std::numeric_limits<double>::infinity();
  std::vector<PartContact> all;
  const auto visit = [&](std::uint32_t of_a, std::uint32_t of_b) {
    const OnePart part_a(a, of_a), part_b(b, of_b);
    SignedDistanceOptions how;
    how.at_most = limit;
    const SignedDistance found =
        signed_distance(part_a.shape(), pose_a, part_b.shape(), pose_b, how);
    if (found.lower > limit) return false;
    PartContact contact(part_a, pose_a, part_b, pose_b, found);
    if (!contact.points.empty()) all.push_back(std::move(contact));
    return all.size() == most_pairs;
  };
  visit(parts.a, parts.b);
  if (all.empty()) return {};
  const double nearest = all[0].points[0].distance;
  limit = std::max(0.0, nearest) + options.within * size;
  PairWalk walk(tree_a, tree_b, sight);
  walk.run([](double gap, const MiddleBox&, const MiddleBox&) { return gap; },
           [&] { return limit; }, visit);

  // Parts that only touch at an edge may have any normal: those that share most decide.
  const Vec3<double> normal = nearest > 4 * sight.rounding
                                  ? all[0].normal
                                  : std::ranges::max_element(all, {}, &PartContact::area)->normal;
  std::vector<ContactPoint> points;
  double least = std::numeric_limits<double>::infinity();
  for (const PartContact& contact : all) {
    if (contact.normal.dot(normal) < std::cos(options.tilt)) continue;
    for (ContactPoint point : contact.points) {
      point.distance = (point.point_b - point.point_a).dot(normal);
      point.point_b = point.point_a + point.distance * normal;
      least = std::min(least, point.distance);
      points.push_back(point);
    }
  }
  std::erase_if(points, [&](const ContactPoint& point) {
    return point.distance > least + options.within * size;
  });
  // The tilt moves support points of curved surfaces by this distance.
  const double near = (a.mesh() && b.mesh() ? std::tan(options.tilt) : 3 * std::tan(options.tilt));
  return spread_points(normal, outermost(points, least + 4 * sight.rounding), points, near * size);
}

}  // namespace minkray
