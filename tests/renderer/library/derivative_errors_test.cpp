// SPDX-License-Identifier: MIT
// Bounds of the errors of rays' and of times of impact's derivatives, through the library.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <cmath>
#include <vector>

namespace {

namespace mk = minkray;

struct DerivedRays {
  std::vector<mk::RayTwist> by_ray;
  std::vector<mk::Twist> by_body;
  std::vector<std::uint8_t> is_ridge;
  std::vector<mk::DerivativeError> error_ray, error_body;
};

DerivedRays derived(const mk::Scene& scene, const std::vector<mk::Ray>& rays) {
  const std::size_t count = rays.size();
  DerivedRays found{std::vector<mk::RayTwist>(count), std::vector<mk::Twist>(count),
                    std::vector<std::uint8_t>(count), std::vector<mk::DerivativeError>(count),
                    std::vector<mk::DerivativeError>(count)};
  std::vector<mk::Hit> hits(count);
  scene.cast(rays, hits);
  mk::ray_derivatives(
      scene, rays, hits,
      {found.by_ray, found.by_body, found.is_ridge, found.error_ray, found.error_body});
  return found;
}

TEST(LibraryDerivativeErrors, of_rays) {
  mk::Scene scene;
  scene.add(mk::sphere(1));
  scene.add(mk::box({1, 1, 1}), mk::translation({0, 10, 0}));
  scene.add(mk::superellipsoid({1, 1, 1}, 4), mk::translation({0, 20, 0}));
  scene.commit();
  const DerivedRays found = derived(scene, {{{-4, 0.6, 0}, {1, 0, 0}},
                                            {{-4, 10, 0}, {2, 0, 0}},
                                            {{-4, 5, 0}, {1, 0, 0}},
                                            {{0, 0, 0}, {1, 0, 0}},
                                            {{-4, 10, 4}, {3, 0, -3}},
                                            {{-4, 20, 0.3}, {1, 0, 0}}});
  // The normal is (-0.8, 0.6, 0), and t 3.2.
  EXPECT_NEAR(found.by_ray[0].origin.y, 0.75, found.error_ray[0].velocity);
  EXPECT_NEAR(found.by_ray[0].direction.y, 3.2 * 0.75, found.error_ray[0].turn);
  EXPECT_NEAR(found.by_body[0].velocity.y, -0.75, found.error_body[0].velocity);
  EXPECT_NEAR(found.by_body[0].turn.z, 0, found.error_body[0].turn);
  EXPECT_LT(found.error_ray[0].turn, 1e-11);
  EXPECT_LT(found.error_body[0].turn, 1e-11);
  EXPECT_NEAR(found.by_ray[1].origin.x, -0.5, found.error_ray[1].velocity);
  EXPECT_LT(found.error_ray[1].velocity, 1e-13);
  EXPECT_TRUE(std::isnan(found.error_ray[2].turn) && std::isnan(found.error_body[2].velocity));
  EXPECT_EQ(found.error_ray[3].velocity, 0);
  EXPECT_EQ(found.error_body[3].turn, 0);
  EXPECT_TRUE(found.is_ridge[4] != 0 && std::isinf(found.error_body[4].velocity));
  EXPECT_TRUE(found.is_ridge[5] == 0 && std::isinf(found.error_ray[5].velocity));
}

TEST(LibraryDerivativeErrors, of_rays_at_meshes) {
  mk::Scene scene;
  const std::vector<mk::Vec3> corners = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  scene.add(mk::mesh(corners, {0, 1, 2}));
  scene.add_half_space({0, 0, 1}, -1);
  scene.commit();
  const DerivedRays found = derived(scene, {{{0.5, 0.25, 4}, {0, 0, -1}}, {{5, 5, 4}, {0, 1, -1}}});
  EXPECT_NEAR(found.by_ray[0].origin.z, 1, found.error_ray[0].velocity);
  EXPECT_LT(found.error_ray[0].turn, 1e-11);
  EXPECT_NEAR(found.by_body[1].velocity.z, -1, found.error_body[1].velocity);
  EXPECT_LT(found.error_body[1].turn, 1e-12);
}

TEST(LibraryDerivativeErrors, of_rays_are_not_written_for_older_programs) {
  mk::Scene scene;
  scene.add(mk::sphere(1));
  scene.commit();
  const mk::Ray ray{{-4, 0, 0}, {1, 0, 0}};
  const mk::Hit hit = scene.cast(ray);
  mk::detail::HitArrays hits({&hit, 1});
  const minkray_hit_arrays from = hits.plain();
  minkray_ray_arrays rays = {};
  rays.size = sizeof rays;
  rays.origins = &ray.origin.x;
  rays.directions = &ray.direction.x;
  rays.origin_stride = rays.direction_stride = sizeof(mk::Ray);
  double jac[6] = {}, untouched[2] = {7, 7};
  minkray_ray_derivatives to = {};
  to.size = offsetof(minkray_ray_derivatives, jac_error_ray);
  to.jac_ray = jac;
  to.jac_error_ray = untouched;
  EXPECT_EQ(minkray_scene_ray_derivatives(scene.handle(), &rays, 1, &from, &to, nullptr),
            MINKRAY_OK);
  EXPECT_EQ(jac[0], -1);
  EXPECT_EQ(untouched[0], 7);
  --to.size;
  EXPECT_EQ(minkray_scene_ray_derivatives(scene.handle(), &rays, 1, &from, &to, nullptr),
            MINKRAY_WRONG_USE);
}

TEST(LibraryDerivativeErrors, of_times_of_impact) {
  const mk::Shape ball = mk::sphere(1), box = mk::box({1, 1, 1});
  const std::vector<mk::Pose> aside = {mk::translation({4, 1.2, 0}), mk::translation({4, 9, 0}),
                                       mk::translation({1, 0, 0})};
  const mk::Twist approach{{-1, 0, 0}, {}};
  const double t_max = 5;
  std::vector<mk::Impact> impacts(3);
  std::vector<mk::Twist> by_b(3);
  std::vector<mk::DerivativeError> error_b(3);
  mk::PairOptions options;
  options.derivatives.by_b = by_b;
  options.derivatives.error_b = error_b;
  mk::times_of_impact({{&ball, 1}, {}, {}}, {{&ball, 1}, aside, {&approach, 1}}, {&t_max, 1},
                      impacts, options);
  // The normal is (0.8, 0.6, 0).
  EXPECT_NEAR(by_b[0].velocity.x, 1, error_b[0].velocity);
  EXPECT_NEAR(by_b[0].velocity.y, 0.75, error_b[0].velocity);
  EXPECT_LT(error_b[0].velocity, 1e-12);
  EXPECT_TRUE(std::isnan(error_b[1].turn));
  EXPECT_EQ(error_b[2].turn, 0);
  mk::times_of_impact({{&box, 1}, {}, {}}, {{&box, 1}, aside, {&approach, 1}}, {&t_max, 1}, impacts,
                      options);
  EXPECT_TRUE(std::isinf(error_b[0].turn));
}

TEST(LibraryDerivativeErrors, of_times_of_impact_in_a_scene) {
  mk::Scene scene;
  scene.add(mk::sphere(1));
  scene.commit();
  const mk::Shape ball = mk::sphere(1);
  const mk::Pose aside = mk::translation({4, 1.2, 0});
  const mk::Twist approach{{-1, 0, 0}, {}};
  const double t_max = 5;
  mk::SceneImpact found;
  mk::DerivativeError error;
  mk::NearOptions options;
  options.derivatives = true;
  options.errors = {&error, 1};
  scene.times_of_impact({{&ball, 1}, {&aside, 1}, {&approach, 1}}, {&t_max, 1}, {&found, 1},
                        options);
  EXPECT_NEAR(found.by_shape.velocity.y, 0.75, error.velocity);
  EXPECT_LT(error.velocity, 1e-12);
  options.errors = {};
  minkray_near_options old = mk::detail::plain(options);
  old.size = offsetof(minkray_near_options, jac_error);
  old.jac_error = &error.velocity;
  error.velocity = 7;
  minkray_bodies shapes = mk::detail::plain(mk::Bodies{{&ball, 1}, {&aside, 1}, {&approach, 1}});
  minkray_scene_impact impact = {};
  EXPECT_EQ(
      minkray_scene_time_of_impact(scene.handle(), &shapes, 1, &t_max, 1, &old, &impact, nullptr),
      MINKRAY_OK);
  EXPECT_EQ(error.velocity, 7);
}

}  // namespace
