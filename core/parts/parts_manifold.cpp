// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <vector>

#include "core/math/bounds.h"
#include "core/parts/one_part.h"
#include "core/parts/pair_walk.h"
#include "core/parts/parts_contact.h"
#include "core/parts/parts_distance.h"

namespace minkray {
namespace {

/// Numbers of pairs of parts whose points are computed: to find the normal, and for each direction
/// across it. Flat contacts of fine meshes have far more near pairs.
constexpr std::size_t least_pairs = 8, most_pairs = 64, pairs_of_direction = 64;

/// Number of directions across the normal in which the outermost points are found. The first is
/// turned by an angle, since the sides of a region along a direction have no outermost point.
constexpr int directions = 8;
constexpr double first_angle = 0.3;

/// A pair of parts further out than the best one by less than this part of the size is skipped.
constexpr double least_step = 1e-3;

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

/// Collects contact points of near pairs of parts.
class NearParts {
 public:
  NearParts(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
            const Affine<double>& pose_b)
      : a_(a), b_(b), pose_a_(pose_a), pose_b_(pose_b) {}

  const std::vector<PartContact>& contacts() const { return contacts_; }
  void set_limit(double limit) { limit_ = limit; }
  double limit() const { return limit_; }

  /// Returns the points of two parts; null if the parts are not near.
  const PartContact* of(std::uint32_t part_a, std::uint32_t part_b) {
    const std::uint64_t key = std::uint64_t{part_a} << 32 | part_b;
    const auto [at, is_new] = known_.try_emplace(key, none);
    if (is_new) {
      const OnePart one(a_, part_a), other(b_, part_b);
      SignedDistanceOptions how;
      how.at_most = limit_;
      const SignedDistance found =
          signed_distance(one.shape(), pose_a_, other.shape(), pose_b_, how);
      if (!(found.lower > limit_)) {
        PartContact contact(one, pose_a_, other, pose_b_, found);
        if (!contact.points.empty()) {
          at->second = contacts_.size();
          contacts_.push_back(std::move(contact));
        }
      }
    }
    return at->second == none ? nullptr : &contacts_[at->second];
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};
  const PartsBody &a_, &b_;
  const Affine<double>&pose_a_, &pose_b_;
  double limit_ = std::numeric_limits<double>::infinity();
  std::vector<PartContact> contacts_;
  std::unordered_map<std::uint64_t, std::size_t> known_;
};

/// Collects pairs of parts that are furthest along a direction across the normal.
void collect_along(const Vec3<double>& out, const Vec3<double>& normal, double tilt,
                   const BodyTree& tree_a, const BodyTree& tree_b, const Sight& sight,
                   NearParts& near) {
  const Vec3<double> in_a = sight.turn_a.transpose() * out,
                     in_b = sight.b_in_a.turn.transpose() * in_a;
  const double shift = in_a.dot(sight.b_in_a.shift), size = tree_a.radius() + tree_b.radius();
  const double base = 2 * (size + std::abs(shift));  // makes all keys negative
  double best = -base;
  std::size_t visits = 0;
  PairWalk walk(tree_a, tree_b, sight);
  const auto key = [&](double gap, const MiddleBox& box_a, const MiddleBox& box_b) {
    if (gap > near.limit()) return std::numeric_limits<double>::infinity();
    return -base - std::min(reach_along(box_a, in_a), shift + reach_along(box_b, in_b));
  };
  walk.run(
      key, [&] { return -base - best - (best > -base ? least_step * size : 0); },
      [&](std::uint32_t part_a, std::uint32_t part_b) {
        const PartContact* contact = near.of(part_a, part_b);
        if (contact && contact->normal.dot(normal) >= std::cos(tilt))
          for (const ContactPoint& point : contact->points)
            best = std::max(best, out.dot(point.point_a - sight.middle_a));
        return ++visits == pairs_of_direction;
      });
}

}  // namespace

ContactManifold contact_manifold(const PartsBody& a, const Affine<double>& pose_a,
                                 const PartsBody& b, const Affine<double>& pose_b) {
  PartPair parts;
  signed_distance(a, pose_a, b, pose_b, {}, &parts);
  if ((!a.shape() && parts.a == no_part) || (!b.shape() && parts.b == no_part)) return {};
  const ManifoldOptions options;
  const BodyTree tree_a(a), tree_b(b);
  const Sight sight(tree_a, pose_a, tree_b, pose_b);
  const double size = std::min(tree_a.radius(), tree_b.radius());
  NearParts near(a, pose_a, b, pose_b);
  const PartContact* const first = near.of(parts.a, parts.b);
  if (!first) return {};
  const Vec3<double> first_normal = first->normal;
  const double nearest = first->points[0].distance;
  near.set_limit(std::max(0.0, nearest) + options.within * size);

  // Parts that only touch at an edge may have any normal: those that share most decide.
  Vec3<double> normal = first_normal;
  if (!(nearest > 4 * sight.rounding)) {
    double area = first->area;
    PairWalk walk(tree_a, tree_b, sight);
    walk.run([](double gap, const MiddleBox&, const MiddleBox&) { return gap; },
             [&] { return near.limit(); },
             [&](std::uint32_t part_a, std::uint32_t part_b) {
               const PartContact* contact = near.of(part_a, part_b);
               if (contact && contact->area > area) {
                 area = contact->area;
                 normal = contact->normal;
               }
               const std::size_t count = near.contacts().size();
               return count >= most_pairs || (area > 0 && count >= least_pairs);
             });
  }
  const Vec3<double> e0 = normal.isZero(0) ? normal : normal.unitOrthogonal(),
                     e1 = normal.cross(e0);
  for (int k = 0; k < directions; ++k) {
    const double angle = first_angle + 2 * std::numbers::pi / directions * k;
    collect_along(std::cos(angle) * e0 + std::sin(angle) * e1, normal, options.tilt, tree_a, tree_b,
                  sight, near);
  }
  std::vector<ContactPoint> points;
  double least = std::numeric_limits<double>::infinity();
  for (const PartContact& contact : near.contacts()) {
    if (contact.normal.dot(normal) < std::cos(options.tilt)) continue;
    for (ContactPoint point : contact.points) {
      // Along their own normals points are no nearer than the nearest; projected they may be.
      point.point_b = point.point_a + point.distance * normal;
      least = std::min(least, point.distance);
      points.push_back(point);
    }
  }
  std::erase_if(points, [&](const ContactPoint& point) {
    return point.distance > least + options.within * size;
  });
  // The tilt moves support points of curved surfaces by this distance.
  const double apart = (a.mesh() && b.mesh() ? std::tan(options.tilt) : 3 * std::tan(options.tilt));
  return spread_points(normal, outermost(points, least + 4 * sight.rounding), points, apart * size);
}

}  // namespace minkray
