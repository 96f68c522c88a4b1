// SPDX-License-Identifier: MIT
#include "tests/support/sample_shapes.h"

#include <functional>
#include <numbers>

#include "tests/support/random.h"
#include "tests/support/support_of.h"

namespace minkray::testing {
namespace {

using S = Shape;
using P = Vec3<double>;

PointCloud cloud(int count, const Vec3<double>& radii, std::uint64_t seed) {
  Random random(seed);
  std::vector<P> points;
  for (int i = 0; i < count; ++i) points.push_back(random.direction().cwiseProduct(radii));
  return PointCloud(points);
}

PointCloud polygon(int sides) {
  std::vector<P> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    points.emplace_back(1 + std::cos(angle), std::sin(angle), 0.5 * std::cos(angle));
  }
  return PointCloud(points);
}

PointCloud cube_corners() {
  std::vector<P> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  return PointCloud(points);
}

S moved(S shape, const Mat3<double>& linear, const P& translation) {
  return Transform{std::move(shape), AffineMap(Affine<double>{linear, translation})};
}

Mat3<double> shear() {
  Mat3<double> m;
  m << 1, 0.6, -0.3, 0, 1, 0.4, 0, 0, 1;
  return m;
}

}  // namespace

std::vector<SampleShape> sample_shapes() {
  const S box = Box{{1, 0.5, 0.25}};
  const S egg = Ellipsoid{{1, 0.5, 0.25}};
  const S flat_triangle = Triangle{{P(0, 0, 0), P(2, 0, 0.5), P(0.3, 1.5, 0)}};
  const Mat3<double> turn = Random(77).rotation();
  return {
      {"point", Point{{1, -2, 0.5}}},
      {"segment", Segment{{P(-1, 0, 0), P(1, 0.5, 0.2)}}},
      {"segment without length", Segment{{P(1, 2, 3), P(1, 2, 3)}}},
      {"triangle", flat_triangle},
      {"triangle, a needle", Triangle{{P(0, 0, 0), P(10, 0, 0), P(5, 0.01, 0)}}},
      {"triangle, collinear", Triangle{{P(0, 0, 0), P(1, 1, 1), P(2, 2, 2)}}},
      {"sphere", Sphere{1}},
      {"ellipsoid", egg},
      {"ellipsoid, a needle", Ellipsoid{{10, 0.01, 0.01}}},
      {"ellipsoid, a pancake", Ellipsoid{{1, 1, 0.001}}},
      {"box", box},
      {"box, a plate", Box{{1, 2, 0.001}}},
      {"box, flat", Box{{1, 2, 0}}},
      {"disk", Disk{1.5}},
      {"cylinder", Cylinder{0.7, 1}},
      {"cylinder, a coin", Cylinder{1, 0.01}},
      {"cylinder, flat", Cylinder{1, 0}},
      {"cut_cylinder", CutCylinder{0.7, {-0.5, 0.6}, {0.2, -0.3}, {-0.5, 0.4}}},
      {"cut_cylinder, a wedge", CutCylinder{1, {0, 0.5}, {0.25, 0}, {-0.25, 0}}},
      {"cut_cylinder, beside its origin", CutCylinder{0.5, {2, 3}, {1, 1}, {1, 1}}},
      {"cone", Cone{1, 1}},
      {"cone, a needle", Cone{0.01, 2}},
      {"cone, shallow", Cone{1, 0.01}},
      {"capsule", Capsule{0.5, 1}},
      {"capsule, long", Capsule{0.01, 5}},
      {"capsule, a ball", Capsule{1, 0}},
      {"tapered_capsule", TaperedCapsule{{0.8, 0.3}, 1}},
      {"tapered_capsule, one ball in the other", TaperedCapsule{{0.2, 2}, 0.5}},
      {"tapered_capsule, a spike", TaperedCapsule{{0.5, 0}, 1}},
      {"frustum", Frustum{{1, 0.5}, 0.7}},
      {"frustum, a cone", Frustum{{0, 1}, 0.7}},
      {"frustum, shallow", Frustum{{1, 0.99}, 0.005}},
      {"superellipsoid", Superellipsoid{{1, 0.7, 0.5}, 4}},
      {"superellipsoid, octahedron", Superellipsoid{{1, 0.7, 0.5}, 1}},
      {"superellipsoid, p = 1.5", Superellipsoid{{1, 1, 1}, 1.5}},
      {"superellipsoid, p = 12", Superellipsoid{{1, 1, 1}, 12}},
      {"hull", Hull{cloud(16, {1, 0.7, 0.5}, 1)}},
      {"hull of many", Hull{cloud(1000, {1, 0.7, 0.5}, 2)}},
      {"hull, a cube", Hull{cube_corners()}},
      {"hull, a needle", Hull{cloud(50, {1, 0.001, 0.001}, 3)}},
      {"hull, a polygon", Hull{polygon(40)}},
      {"hull, a segment", Hull{PointCloud({P(0, 0, 0), P(1, 1, 1), P(3, 3, 3)})}},
      {"hull, a point", Hull{PointCloud({P(1, 1, 1), P(1, 1, 1)})}},
      {"rounded box", Rounded{0.2, box}},
      {"rounded box, hardly", Rounded{1e-4, box}},
      {"rounded segment", Rounded{0.3, S(Segment{{P(-1, 0, 0), P(1, 1, 0)}})}},
      {"rounded triangle", Rounded{0.1, flat_triangle}},
      {"rounded hull", Rounded{0.1, S(Hull{cloud(40, {1, 0.7, 0.5}, 4)})}},
      {"rounded by nothing", Rounded{0, box}},
      {"minkowski_sum of box and ellipsoid", MinkowskiSum{{box, egg}}},
      {"minkowski_sum of ellipsoids", MinkowskiSum{{egg, moved(egg, turn, P(0.1, 0.2, 0.3))}}},
      {"minkowski_sum of segments, a parallelogram",
       MinkowskiSum{
           {S(Segment{{P(0, 0, 0), P(1, 0, 0)}}), S(Segment{{P(0, 0, 0), P(0.3, 1, 0)}})}}},
      {"minkowski_sum of three", MinkowskiSum{{box, S(Disk{0.5}), flat_triangle}}},
      {"minkowski_difference of box and sphere", MinkowskiDifference{box, S(Sphere{0.4})}},
      {"minkowski_difference of cone and cylinder",
       MinkowskiDifference{S(Cone{1, 1}), moved(Cylinder{0.5, 0.3}, turn, P(1, 0, 0))}},
      {"hull_of sphere and box",
       HullOf{{moved(Sphere{0.5}, Mat3<double>::Identity(), P(2, 0, 0)), box}}},
      {"hull_of disks", HullOf{{S(Disk{1}), moved(Disk{0.5}, turn, P(0, 0, 1.5))}}},
      {"hull_of one", HullOf{{egg}}},
      {"transform, a sheared box", moved(box, shear(), P(3, 2, 1))},
      {"transform, a mirrored cone", moved(Cone{1, 1}, P(1, 1, -1).asDiagonal(), P(0, 0, 5))},
      {"transform, a squashed capsule",
       moved(Capsule{0.5, 1}, turn * P(1, 0.3, 2).asDiagonal() * turn.transpose(), P(0, 0, 0))},
      {"transform in a transform", moved(moved(egg, shear(), P(1, 0, 0)), turn, P(-4, 0, 2))},
      {"transform, a turned disk", moved(Disk{1}, turn, P(1, 2, 3))},
      {"custom, a box", as_custom(box)},
      {"custom, an ellipsoid", as_custom(egg)},
      {"custom, a cut cylinder",
       as_custom(CutCylinder{0.7, {-0.5, 0.6}, {0.2, -0.3}, {-0.5, 0.4}})},
      {"custom in a sum", MinkowskiSum{{as_custom(egg), S(Sphere{0.3})}}},
  };
}

Shape random_nesting(std::uint64_t seed, int depth) {
  Random random(seed * 2654435761u + static_cast<std::uint64_t>(depth));
  const std::function<S()> leaf = [&]() -> S {
    const auto size = [&] { return random.uniform(0.2, 1); };
    switch (random.below(15)) {
      case 0:
        return Point{random.in_cube()};
      case 1:
        return Segment{{random.in_cube(), random.in_cube()}};
      case 2:
        return Triangle{{random.in_cube(), random.in_cube(), random.in_cube()}};
      case 3:
        return Sphere{size()};
      case 4:
        return Ellipsoid{{size(), size(), size()}};
      case 5:
        return Box{{size(), size(), size()}};
      case 6:
        return Disk{size()};
      case 7:
        return Cylinder{size(), size()};
      case 8:
        return Cone{size(), size()};
      case 9:
        return Capsule{size(), size()};
      case 10:
        return TaperedCapsule{{size(), size()}, size()};
      case 11:
        return Frustum{{size(), size()}, size()};
      case 12:
        return Superellipsoid{{size(), size(), size()}, random.uniform(1.2, 6)};
      case 13:
        return CutCylinder{size(), {-1, 0.5 + size()}, {0.3 * size(), -0.2}, {-0.3, size()}};
      default:
        return Hull{cloud(4 + random.below(60), {size(), size(), size()}, seed + 1000)};
    }
  };
  const std::function<S(int)> nest = [&](int left) -> S {
    if (left == 0) return leaf();
    const auto inner = [&] { return nest(random.below(left)); };
    switch (random.below(5)) {
      case 0:
        return Rounded{random.uniform(0.01, 0.5), nest(left - 1)};
      case 1:
        return MinkowskiSum{{nest(left - 1), inner()}};
      case 2:
        return MinkowskiDifference{nest(left - 1), inner()};
      case 3:
        return HullOf{{nest(left - 1), inner(), inner()}};
      default: {
        // Singular values between 0.4 and 1.6, and a mirror for half of them.
        P scale(random.uniform(0.4, 1.6), random.uniform(0.4, 1.6), random.uniform(0.4, 1.6));
        if (random.below(2) == 0) scale.x() = -scale.x();
        const Mat3<double> first = random.rotation(), second = random.rotation();
        return moved(nest(left - 1), first * scale.asDiagonal() * second, random.in_cube());
      }
    }
  };
  return nest(depth);
}

std::vector<SampleShape> sample_shapes_and_nestings(std::uint64_t first, std::uint64_t last) {
  std::vector<SampleShape> all = sample_shapes();
  for (std::uint64_t seed = first; seed < last; ++seed) {
    const Shape shape = random_nesting(seed);
    all.push_back({"seed " + std::to_string(seed) + " " + name_of_nesting(shape), shape});
  }
  return all;
}

std::string name_of_nesting(const Shape& shape) {
  return std::visit(
      [](const auto& kind) {
        using Kind = std::decay_t<decltype(kind)>;
        std::string operands;
        const auto add = [&](const Nested& operand) {
          operands += (operands.empty() ? "" : ", ") + name_of_nesting(*operand);
        };
        for_each_field<Kind>([&](const auto& field) {
          const auto& member = kind.*(field.member);
          using Member = std::decay_t<decltype(member)>;
          if constexpr (std::is_same_v<Member, Nested>) add(member);
          if constexpr (std::is_same_v<Member, ShapeList>)
            for (const auto& operand : member) add(operand);
        });
        const std::string name(Kind::name);
        return operands.empty() ? name : name + "(" + operands + ")";
      },
      shape.kind);
}

}  // namespace minkray::testing
