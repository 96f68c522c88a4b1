// SPDX-License-Identifier: MIT
// Rounded cylinders, cones, frustums and disks at the limits of their closed form, compared with
// bisection in long double: any rounding, steep and flat sides, tips, joints of parts, far origins.
#include "core/exact/rounded_frustum.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/filter_judge.h"

namespace minkray::testing {
namespace {

using P = Vec3<double>;
using exact::RoundedFrustumForm;

struct FrustumBody {
  Frustum core;
  double radius;

  Shape shape() const { return Rounded{radius, Shape(core)}; }
  double size() const {
    return std::hypot(std::max(core.radii[0], core.radii[1]), core.half_height) + radius;
  }
  bool has_form() const {
    return PreparedShape(shape()).definition().form().kind == RoundedFrustumForm::kind;
  }
  std::string name() const {
    std::ostringstream name;
    name << core.radii[0] << ", " << core.radii[1] << ", " << core.half_height << " + " << radius;
    return name.str();
  }
};

/// A meridian's point where the torus at one end meets the lid or the side, and the normal there.
struct Joint {
  double q, z, out, up;
};

Joint joint_of(const FrustumBody& body, bool is_above, bool at_lid) {
  const double q = body.core.radii[is_above ? 1 : 0], end = is_above ? 1 : -1;
  const double z = end * body.core.half_height, slant = body.core.radii[0] - body.core.radii[1];
  const double length = std::hypot(slant, 2 * body.core.half_height);
  const double out = at_lid || length == 0 ? 0 : 2 * body.core.half_height / length;
  const double up = at_lid || length == 0 ? end : slant / length;
  return {q + body.radius * out, z + body.radius * up, out, up};
}

/// Rays that touch the surface at a joint, within 1 to 1e-16 of the size, at any angle or nearly
/// tangent.
Ray<double> at_joint(const FrustumBody& body, double distance, Random& random) {
  const Joint joint = joint_of(body, random.below(2), random.below(2));
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const P outward(std::cos(angle), std::sin(angle), 0);
  const auto small = [&](double least) {
    return std::pow(10.0, random.uniform(least, 0)) * (random.below(2) ? 1 : -1);
  };
  const P normal = joint.out * outward + P(0, 0, joint.up),
          at = joint.q * outward + P(0, 0, joint.z);
  P along = unit<double>(P(normal.cross(random.direction())));
  along += normal * (random.below(2) ? small(-14) : 0);
  const double size = body.size();
  const P past = at + normal * (size * (random.below(4) ? small(-16) : 0)) +
                 along * (size * (random.below(2) ? small(-12) : 0));
  return {past - distance * size * along, along * size};
}

/// Rays near the tip of a cone, within 1 to 1e-16 of the rounding radius.
Ray<double> at_tip(const FrustumBody& body, double distance, Random& random) {
  const P tip(0, 0, body.core.half_height);
  const double reach =
      body.radius * (1 + std::pow(10.0, random.uniform(-16, 0)) * (random.below(2) ? 1 : -1));
  const P normal = random.direction(), along = unit<double>(P(normal.cross(random.direction())));
  const P past = tip + normal * reach + along * (random.uniform(-1, 1) * body.radius);
  return {past - distance * body.size() * along, along};
}

/// Judges `count` rays at a body, from near and from afar.
template <class Next>
Counted judge_body(const FrustumBody& body, int count, const Next& next) {
  SCOPED_TRACE(body.name());
  Counted counted;
  const PreparedShape prepared(body.shape());
  EXPECT_EQ(prepared.definition().form().kind, RoundedFrustumForm::kind);
  const LineIn line_in = [inner = prepared.inner_shape()](const Vec3<Long>& at,
                                                          const Vec3<Long>& along) {
    return *line_in_shape(inner, at, along);
  };
  Random random(91);
  for (int i = 0; i < count && !::testing::Test::HasFatalFailure(); ++i)
    judge(line_in, prepared, next(body, i % 2 ? 5.0 : 1e5, random), counted);
  return counted;
}

/// All bodies of some proportions and roundings that have the form.
std::vector<FrustumBody> bodies() {
  std::vector<FrustumBody> all;
  for (const double half_height : {0.0, 0.01, 0.2, 1.0, 4.0, 50.0})
    for (const double upper : {0.0, 1e-9, 0.1, 0.7, 1 - 1e-9, 1.0, 3.0})
      for (const double rounding : {1e-6, 1e-3, 0.05, 1.0, 2.0, 100.0}) {
        const FrustumBody body{{{1, upper}, half_height}, rounding};
        if (body.has_form()) all.push_back(body);
      }
  return all;
}

Counted& operator+=(Counted& sum, const Counted& part) {
  sum.answered += part.answered;
  sum.in_doubt += part.in_doubt;
  sum.hits += part.hits;
  sum.misses += part.misses;
  return sum;
}

/// Most of the rays in doubt are tangent within rounding.
TEST(RoundedFrustum, rays_at_joints_of_any_body_break_no_bound) {
  Counted counted;
  for (const FrustumBody& body : bodies()) counted += judge_body(body, 100, at_joint);
  EXPECT_GT(bodies().size(), 80u);
  EXPECT_LT(counted.in_doubt, 0.35 * counted.answered);
  EXPECT_GT(counted.hits, 0.4 * counted.answered);
  EXPECT_GT(counted.misses, 0.3 * counted.answered);
}

TEST(RoundedFrustum, rays_at_tips_break_no_bound) {
  Counted counted;
  for (const FrustumBody& body : bodies())
    if (body.core.radii[1] == 0) counted += judge_body(body, 300, at_tip);
  EXPECT_LT(counted.in_doubt, 0.1 * counted.answered);
  EXPECT_GT(counted.hits, 0.4 * counted.answered);
  EXPECT_GT(counted.misses, 0.1 * counted.answered);
}

TEST(RoundedFrustum, grazing_rays_are_hardly_ever_in_doubt) {
  for (const FrustumBody& body :
       {FrustumBody{{{1, 1}, 0.7}, 0.2}, FrustumBody{{{1, 0}, 1}, 0.2},
        FrustumBody{{{2, 0}, 0.2}, 0.05}, FrustumBody{{{0.5, 0.5}, 0.2}, 3},
        FrustumBody{{{1, 1}, 0}, 0.1}}) {
    const Shape shape = body.shape();
    FamilyRays rays(shape, RayFamily::grazing, 92);
    const Counted counted =
        judge_body(body, 500, [&](const FrustumBody&, double, Random&) { return rays.next(); });
    EXPECT_LT(counted.in_doubt, 0.002 * counted.answered);
    EXPECT_GT(counted.misses, 0.3 * counted.answered);
  }
}

/// Heights of apexes that are too far away, sides that are too flat.
TEST(RoundedFrustum, bodies_whose_bounds_would_be_wide_have_no_form) {
  for (const double upper : {0.0, 0.5, 0.6, 0.7, 0.75, 0.8, 0.9}) {
    const FrustumBody body{{{1, upper}, 1}, 0.1};
    const double per_height = (1 - upper) / 2, side = std::hypot(1, per_height) / per_height;
    const double apex = 1 + upper / per_height + body.radius * side;
    EXPECT_EQ(body.has_form(), apex < 8 * body.size()) << upper;
  }
  for (const double sine : {0.5, 0.9, 0.985, 0.995}) {
    const double height = std::sqrt(1 - sine * sine) / sine;
    EXPECT_EQ((FrustumBody{{{1, 0}, height / 2}, 0.01}).has_form(), sine < 0.99) << sine;
  }
  EXPECT_EQ(PreparedShape(Shape(Disk{1})).definition().form().kind, FormKind::none);
}

/// E is 2^-51 of the distance from the origin, and must be less than 1/16 of the rounding radius.
TEST(RoundedFrustum, edges_within_rounding_are_in_doubt) {
  const Shape body = FrustumBody{{{1, 1}, 1}, 1e-6}.shape();
  const auto path_at = [&](double x) {
    const PreparedShape moved(body, {Mat3<double>::Identity(), {x, 0, 0}});
    return cast_ray(moved, {{x - 3, 0.1, 0.2}, {1, 0, 0}}).path;
  };
  const double limit = 0x1p51 / 16 * 1e-6;
  EXPECT_EQ(path_at(0.7 * limit), Path::filter);
  EXPECT_NE(path_at(1.5 * limit), Path::filter);
}

}  // namespace
}  // namespace minkray::testing
