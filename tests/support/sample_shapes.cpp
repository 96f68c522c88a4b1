// SPDX-License-Identifier: MIT
#include "tests/support/sample_shapes.h"

#include <functional>
#include <numbers>

#include "tests/support/random.h"
#include "tests/support/support_of.h"

namespace minkray::testing {
namespace {

using S = Shape<double>;
using P = Vec3<double>;

PointCloud<double> cloud(int count, const Vec3<double>& radii, std::uint64_t seed) {
  Random random(seed);
  std::vector<P> points;
  for (int i = 0; i < count; ++i) points.push_back(random.direction().cwiseProduct(radii));
  return PointCloud<double>(points);
}

PointCloud<double> polygon(int sides) {
  std::vector<P> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    points.emplace_back(1 + std::cos(angle), std::sin(angle), 0.5 * std::cos(angle));
  }
  return PointCloud<double>(points);
}

PointCloud<double> cube_corners() {
  std::vector<P> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  return PointCloud<double>(points);
}

S moved(S shape, const Mat3<double>& linear, const P& translation) {
  return Transform<double>{std::move(shape),
                           AffineMap<double>(Affine<double>{linear, translation})};
}

Mat3<double> shear() {
  Mat3<double> m;
  m << 1, 0.6, -0.3, 0, 1, 0.4, 0, 0, 1;
  return m;
}

}  // namespace

std::vector<SampleShape> sample_shapes() {
  const S box = Box<double>{{1, 0.5, 0.25}};
  const S egg = Ellipsoid<double>{{1, 0.5, 0.25}};
  const S flat_triangle = Triangle<double>{{P(0, 0, 0), P(2, 0, 0.5), P(0.3, 1.5, 0)}};
  const Mat3<double> turn = Random(77).rotation();
  return {
      {"point", Point<double>{{1, -2, 0.5}}},
      {"segment", Segment<double>{{P(-1, 0, 0), P(1, 0.5, 0.2)}}},
      {"segment without length", Segment<double>{{P(1, 2, 3), P(1, 2, 3)}}},
      {"triangle", flat_triangle},
      {"triangle, a needle", Triangle<double>{{P(0, 0, 0), P(10, 0, 0), P(5, 0.01, 0)}}},
      {"triangle, collinear", Triangle<double>{{P(0, 0, 0), P(1, 1, 1), P(2, 2, 2)}}},
      {"sphere", Sphere<double>{1}},
      {"ellipsoid", egg},
      {"ellipsoid, a needle", Ellipsoid<double>{{10, 0.01, 0.01}}},
      {"ellipsoid, a pancake", Ellipsoid<double>{{1, 1, 0.001}}},
      {"box", box},
      {"box, a plate", Box<double>{{1, 2, 0.001}}},
      {"box, flat", Box<double>{{1, 2, 0}}},
      {"disk", Disk<double>{1.5}},
      {"cylinder", Cylinder<double>{0.7, 1}},
      {"cylinder, a coin", Cylinder<double>{1, 0.01}},
      {"cylinder, flat", Cylinder<double>{1, 0}},
      {"cut_cylinder", CutCylinder<double>{0.7, {-0.5, 0.6}, {0.2, -0.3}, {-0.5, 0.4}}},
      {"cut_cylinder, a wedge", CutCylinder<double>{1, {0, 0.5}, {0.25, 0}, {-0.25, 0}}},
      {"cut_cylinder, beside its origin", CutCylinder<double>{0.5, {2, 3}, {1, 1}, {1, 1}}},
      {"cone", Cone<double>{1, 1}},
      {"cone, a needle", Cone<double>{0.01, 2}},
      {"cone, shallow", Cone<double>{1, 0.01}},
      {"capsule", Capsule<double>{0.5, 1}},
      {"capsule, long", Capsule<double>{0.01, 5}},
      {"capsule, a ball", Capsule<double>{1, 0}},
      {"tapered_capsule", TaperedCapsule<double>{{0.8, 0.3}, 1}},
      {"tapered_capsule, one ball in the other", TaperedCapsule<double>{{0.2, 2}, 0.5}},
      {"tapered_capsule, a spike", TaperedCapsule<double>{{0.5, 0}, 1}},
      {"frustum", Frustum<double>{{1, 0.5}, 0.7}},
      {"frustum, a cone", Frustum<double>{{0, 1}, 0.7}},
      {"frustum, shallow", Frustum<double>{{1, 0.99}, 0.005}},
      {"superellipsoid", Superellipsoid<double>{{1, 0.7, 0.5}, 4}},
      {"superellipsoid, octahedron", Superellipsoid<double>{{1, 0.7, 0.5}, 1}},
      {"superellipsoid, p = 1.5", Superellipsoid<double>{{1, 1, 1}, 1.5}},
      {"superellipsoid, p = 12", Superellipsoid<double>{{1, 1, 1}, 12}},
      {"hull", Hull<double>{cloud(16, {1, 0.7, 0.5}, 1)}},
      {"hull of many", Hull<double>{cloud(1000, {1, 0.7, 0.5}, 2)}},
      {"hull, a cube", Hull<double>{cube_corners()}},
      {"hull, a needle", Hull<double>{cloud(50, {1, 0.001, 0.001}, 3)}},
      {"hull, a polygon", Hull<double>{polygon(40)}},
      {"hull, a segment", Hull<double>{PointCloud<double>({P(0, 0, 0), P(1, 1, 1), P(3, 3, 3)})}},
      {"hull, a point", Hull<double>{PointCloud<double>({P(1, 1, 1), P(1, 1, 1)})}},
      {"rounded box", Rounded<double>{0.2, box}},
      {"rounded box, hardly", Rounded<double>{1e-4, box}},
      {"rounded segment", Rounded<double>{0.3, S(Segment<double>{{P(-1, 0, 0), P(1, 1, 0)}})}},
      {"rounded triangle", Rounded<double>{0.1, flat_triangle}},
      {"rounded hull", Rounded<double>{0.1, S(Hull<double>{cloud(40, {1, 0.7, 0.5}, 4)})}},
      {"rounded by nothing", Rounded<double>{0, box}},
      {"minkowski_sum of box and ellipsoid", MinkowskiSum<double>{{box, egg}}},
      {"minkowski_sum of ellipsoids",
       MinkowskiSum<double>{{egg, moved(egg, turn, P(0.1, 0.2, 0.3))}}},
      {"minkowski_sum of segments, a parallelogram",
       MinkowskiSum<double>{{S(Segment<double>{{P(0, 0, 0), P(1, 0, 0)}}),
                             S(Segment<double>{{P(0, 0, 0), P(0.3, 1, 0)}})}}},
      {"minkowski_sum of three", MinkowskiSum<double>{{box, S(Disk<double>{0.5}), flat_triangle}}},
      {"minkowski_difference of box and sphere",
       MinkowskiDifference<double>{box, S(Sphere<double>{0.4})}},
      {"minkowski_difference of cone and cylinder",
       MinkowskiDifference<double>{S(Cone<double>{1, 1}),
                                   moved(Cylinder<double>{0.5, 0.3}, turn, P(1, 0, 0))}},
      {"hull_of sphere and box",
       HullOf<double>{{moved(Sphere<double>{0.5}, Mat3<double>::Identity(), P(2, 0, 0)), box}}},
      {"hull_of disks",
       HullOf<double>{{S(Disk<double>{1}), moved(Disk<double>{0.5}, turn, P(0, 0, 1.5))}}},
      {"hull_of one", HullOf<double>{{egg}}},
      {"transform, a sheared box", moved(box, shear(), P(3, 2, 1))},
      {"transform, a mirrored cone",
       moved(Cone<double>{1, 1}, P(1, 1, -1).asDiagonal(), P(0, 0, 5))},
      {"transform, a squashed capsule",
       moved(Capsule<double>{0.5, 1}, turn * P(1, 0.3, 2).asDiagonal() * turn.transpose(),
             P(0, 0, 0))},
      {"transform in a transform", moved(moved(egg, shear(), P(1, 0, 0)), turn, P(-4, 0, 2))},
      {"transform, a turned disk", moved(Disk<double>{1}, turn, P(1, 2, 3))},
      {"custom, a box", as_custom(box)},
      {"custom, an ellipsoid", as_custom(egg)},
      {"custom, a cut cylinder",
       as_custom(CutCylinder<double>{0.7, {-0.5, 0.6}, {0.2, -0.3}, {-0.5, 0.4}})},
      {"custom in a sum", MinkowskiSum<double>{{as_custom(egg), S(Sphere<double>{0.3})}}},
  };
}

Shape<double> random_nesting(std::uint64_t seed, int depth) {
  Random random(seed * 2654435761u + static_cast<std::uint64_t>(depth));
  const std::function<S()> leaf = [&]() -> S {
    const auto size = [&] { return random.uniform(0.2, 1); };
    switch (random.below(15)) {
      case 0:
        return Point<double>{random.in_cube()};
      case 1:
        return Segment<double>{{random.in_cube(), random.in_cube()}};
      case 2:
        return Triangle<double>{{random.in_cube(), random.in_cube(), random.in_cube()}};
      case 3:
        return Sphere<double>{size()};
      case 4:
        return Ellipsoid<double>{{size(), size(), size()}};
      case 5:
        return Box<double>{{size(), size(), size()}};
      case 6:
        return Disk<double>{size()};
      case 7:
        return Cylinder<double>{size(), size()};
      case 8:
        return Cone<double>{size(), size()};
      case 9:
        return Capsule<double>{size(), size()};
      case 10:
        return TaperedCapsule<double>{{size(), size()}, size()};
      case 11:
        return Frustum<double>{{size(), size()}, size()};
      case 12:
        return Superellipsoid<double>{{size(), size(), size()}, random.uniform(1.2, 6)};
      case 13:
        return CutCylinder<double>{
            size(), {-1, 0.5 + size()}, {0.3 * size(), -0.2}, {-0.3, size()}};
      default:
        return Hull<double>{cloud(4 + random.below(60), {size(), size(), size()}, seed + 1000)};
    }
  };
  const std::function<S(int)> nest = [&](int left) -> S {
    if (left == 0) return leaf();
    const auto inner = [&] { return nest(random.below(left)); };
    switch (random.below(5)) {
      case 0:
        return Rounded<double>{random.uniform(0.01, 0.5), nest(left - 1)};
      case 1:
        return MinkowskiSum<double>{{nest(left - 1), inner()}};
      case 2:
        return MinkowskiDifference<double>{nest(left - 1), inner()};
      case 3:
        return HullOf<double>{{nest(left - 1), inner(), inner()}};
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

std::string name_of_nesting(const Shape<double>& shape) {
  return std::visit(
      [](const auto& kind) {
        using Kind = std::decay_t<decltype(kind)>;
        std::string operands;
        const auto add = [&](const Nested<double>& operand) {
          operands += (operands.empty() ? "" : ", ") + name_of_nesting(*operand);
        };
        for_each_field<Kind>([&](const auto& field) {
          const auto& member = kind.*(field.member);
          using Member = std::decay_t<decltype(member)>;
          if constexpr (std::is_same_v<Member, Nested<double>>) add(member);
          if constexpr (std::is_same_v<Member, ShapeList<double>>)
            for (const auto& operand : member) add(operand);
        });
        const std::string name(Kind::name);
        return operands.empty() ? name : name + "(" + operands + ")";
      },
      shape.kind);
}

}  // namespace minkray::testing
