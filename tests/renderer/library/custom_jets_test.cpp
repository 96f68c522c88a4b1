// SPDX-License-Identifier: MIT
// A shape that is given by its support function and that function's derivative: answers are those
// of our shape, for a fraction of the support points; derivatives that lie cost time, and nothing
// else.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include "tests/renderer/library/ellipsoid_jet.h"
#include "tests/renderer/library/errors.h"
#include "tests/renderer/library/same_answers.h"

namespace {

namespace mk = minkray;
using mk::Vec3;

Vec3 ellipsoid_support(const Vec3& n) {
  return ellipsoid_jet(n).point;
}

mk::Shape ours() {
  return mk::ellipsoid({jet_radii[0], jet_radii[1], jet_radii[2]});
}

TEST(CustomJets, of_an_ellipsoid_are_met_where_the_ellipsoid_is) {
  expect_same_answers(ours(), mk::custom_with_jets(ellipsoid_jet), 1.2, 20000);
}

TEST(CustomJets, may_stand_wherever_a_shape_may) {
  const auto nest = [](const mk::Shape& shape) {
    const mk::Pose turned = mk::pose({0.1, 0.2, 0.3}, {0.1, 0.2, 0.3, 0.9});
    return mk::hull_of({mk::sum(mk::transformed(shape, turned), mk::box({0.1, 0.2, 0.1})),
                        mk::rounded(mk::scaled(shape, Vec3{1, 0.5, 0.5}), 0.05)});
  };
  expect_same_answers(nest(ours()), nest(mk::custom_with_jets(ellipsoid_jet)), 1.8, 4000);
}

/// Number of support points of many rays at a shape of the function.
template <class Make>
std::size_t supports_of(const Make& make) {
  mk::Scene scene;
  scene.add(make());
  scene.commit();
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0}, 1.2, 4000);
  std::vector<mk::Hit> hits(rays.size());
  scene.cast(rays, hits);
  std::size_t sum = 0;
  for (const mk::Hit& hit : hits) sum += hit.supports;
  return sum;
}

TEST(CustomJets, take_a_fraction_of_the_support_points) {
  const std::size_t with = supports_of([] { return mk::custom_with_jets(ellipsoid_jet); });
  const std::size_t without = supports_of([] { return mk::custom(ellipsoid_support); });
  EXPECT_LT(2 * with, without);
}

TEST(CustomJets, that_lie_cost_time_and_nothing_else) {
  const auto lie = [](double size, bool is_symmetric) {
    return [=](const Vec3& n) {
      mk::SupportJet jet = ellipsoid_jet(n);
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          jet.derivative[i][k] =
              size * std::sin(7 * n.x + 3 * n.y + (is_symmetric ? i * k : 2 * i + k));
      return jet;
    };
  };
  for (const double size : {-1.0, 1e-9, 1.0, 1e9, 1e300})
    for (const bool is_symmetric : {false, true})
      expect_same_answers(ours(), mk::custom_with_jets(lie(size, is_symmetric)), 1.2, 1000);
}

TEST(CustomJets, that_are_no_numbers_or_other_points_are_refused) {
  const auto refusal = [](const auto& function) {
    return error_of([&] { mk::custom_with_jets(function); }, MINKRAY_BAD_SUPPORT);
  };
  const std::string no_numbers = refusal([](const Vec3& n) {
    mk::SupportJet jet = ellipsoid_jet(n);
    if (n.x > 0.9) jet.derivative[1][2] = std::numeric_limits<double>::quiet_NaN();
    return jet;
  });
  EXPECT_TRUE(has(no_numbers, "not finite"));
  std::atomic<int> asked = 0;
  const std::string others = refusal([&](const Vec3& n) {
    mk::SupportJet jet = ellipsoid_jet(n);
    if (++asked > 500) jet.point.x = std::nextafter(jet.point.x, 2);
    return jet;
  });
  EXPECT_TRUE(has(others, "answers the direction"));
}

}  // namespace
