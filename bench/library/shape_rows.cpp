// SPDX-License-Identifier: MIT
// Rays one by one at one shape, compared with Bullet's ray and, at hulls, with Embree's triangles.
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "bullet.h"
#include "embree.h"
#include "random.h"
#include "sections.h"

namespace bench {
namespace {

/// Rays from a distance of five radii at points of a ball of 0.6 radii, so that most hit; they end
/// ten radii from where they begin.
std::vector<mk::Ray> rays_at(const Body& body, const Vec& middle, std::size_t count) {
  Random random(3);
  std::vector<mk::Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const double reach = 0.6 * body.radius * std::cbrt(random.within(0, 1));
    const Vec target = reach * random.direction();
    const Vec origin = 5 * body.radius * random.direction();
    const Vec direction = normalized(target - origin);
    const auto as_floats = [](const Vec& v) {
      return Vec(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
    };
    rays.push_back({as_floats(middle + origin), as_floats(direction), 10 * body.radius});
  }
  return rays;
}

/// Casts a point at the shape, as btCollisionWorld::rayTestSingle does.
class BulletRays : public Caster {
 public:
  BulletRays(const char* name_, std::shared_ptr<btConvexShape> shape, const mk::Pose& pose,
             const std::vector<mk::Ray>& rays)
      : Caster(name_), shape_(std::move(shape)), pose_(to_bullet(pose)), found_(rays.size()) {
    for (const mk::Ray& ray : rays) {
      btTransform from, to;
      from.setIdentity();
      to.setIdentity();
      from.setOrigin(to_bullet(ray.origin));
      to.setOrigin(to_bullet(Vec(ray.origin) + ray.t_max * Vec(ray.direction)));
      rays_.push_back({from, to});
      ends_.push_back(ray.t_max);
    }
  }

  void cast() override {
    btSphereShape point(0);
    point.setMargin(0);
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      btVoronoiSimplexSolver simplex;
      btSubsimplexConvexCast caster(&point, shape_.get(), &simplex);
      btConvexCast::CastResult result;
      result.m_fraction = 1;
      const bool met =
          caster.calcTimeOfImpact(rays_[i].first, rays_[i].second, pose_, pose_, result);
      found_[i] = met ? Answer{ends_[i] * result.m_fraction, 0} : Answer{};
    }
  }
  std::vector<Answer> answers() const override { return found_; }

 private:
  std::shared_ptr<btConvexShape> shape_;
  btTransform pose_;
  std::vector<std::pair<btTransform, btTransform>> rays_;
  std::vector<double> ends_;
  std::vector<Answer> found_;
};

constexpr std::size_t ray_count = 4096;

void against_bullet(Table& table, const Options& options, const BulletBody& body, double goal) {
  Random random(5);
  const Vec place = random.in_cube(3);
  const mk::Pose pose = mk::pose(place, random.rotation());
  const std::vector<mk::Ray> rays = rays_at(body.ours, place, ray_count);
  Casters ours, peers;
  ours.push_back(minkray_shape(body.ours.shape, rays, pose));
  peers.push_back(std::make_unique<BulletRays>("no margin", body.without_margin, pose, rays));
  if (body.with_margin)
    peers.push_back(std::make_unique<BulletRays>("usual margin", body.with_margin, pose, rays));
  race({&ours, &peers}, options.rounds);
  // The tolerance is so coarse that rays a hundredth of a radius off the shape count as hits.
  const Trust trust = {5e-3 * body.ours.radius, 0.05};
  const auto right = [&](const Caster& peer) {
    return compare(ours[0]->answers(), peer.answers(), trust).holds;
  };
  table.add(Duel{"ray at a " + body.ours.name, "aimed", *ours[0], fastest(peers, right),
                 "Bullet's subsimplex, ", rays.size(), goal, trust});
}

void against_embree(Table& table, const Options& options, int points, double goal) {
  const Body body = hull(random_points(points, {0.75, 0.5, 0.35}, 7));
  const EmbreeScene triangles = EmbreeScene::triangles(body.mesh(1e-4));
  const std::vector<mk::Ray> rays = rays_at(body, {}, ray_count);
  Casters ours, peers;
  ours.push_back(minkray_shape(body.shape, rays));
  peers.push_back(triangles.single(rays));
  race({&ours, &peers}, options.rounds);
  table.add(Duel{"ray at a " + body.name,
                 "aimed",
                 *ours[0],
                 *peers[0],
                 "Embree's triangles, ",
                 rays.size(),
                 goal,
                 {1e-4 * body.radius}});
}

}  // namespace

std::vector<Section> shape_sections() {
  std::vector<Section> sections;
  const auto add = [&](BulletBody body, double goal) {
    sections.push_back({"ray at a " + body.ours.name + ", Bullet",
                        [body = std::move(body), goal](Table& table, const Options& options) {
                          against_bullet(table, options, body, goal);
                        }});
  };
  add(bullet_sphere(0.5), 4);
  add(bullet_box({1, 0.5, 0.25}), 10);
  add(bullet_capsule(0.25, 0.75), 10);
  add(bullet_hull(random_points(64, {1, 1, 1}, 7)), 12);
  add(bullet_cylinder(0.5, 0.75), 6);
  for (const auto& [points, goal] : {std::pair(16, 1.5), {64, 1.5}, {256, 1.2}})
    sections.push_back({"ray at a hull " + std::to_string(points) + ", Embree",
                        [points = points, goal = goal](Table& table, const Options& options) {
                          against_embree(table, options, points, goal);
                        }});
  return sections;
}

}  // namespace bench
