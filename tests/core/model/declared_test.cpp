// SPDX-License-Identifier: MIT
// Only a shape's declarations in its header count, not the names of its fields.
#include "core/support/declared.h"

#include <gtest/gtest.h>

#include "core/model/model_cast.h"
#include "core/model/polytope_model.h"
#include "core/model/translates_model.h"
#include "core/query/observer.h"
#include "core/shape/shape.h"

namespace minkray {
namespace {

/// The part of a box with x/a + z/c <= 0, which declares nothing.
///
/// Has a field `half_extents` as a box has. When fields counted, rays that pass the wedge above its
/// slope were hits at t = 4.
///
///     z |\ .                A wedge of half extents (1, 1, 1), seen along y: below its slope
///       | \  .  <- ray      x + z = 0. A ray that runs along y through the dotted corner
///       +--\   .            hits the box around it, and not the wedge.
///       |   \    .
///       +----\-----> x
struct Wedge {
  Vec3<double> half_extents = Vec3<double>::Ones();

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    const Vec3<W> h = widen<W>(half_extents);
    const W y = select(n.y() < W(0), W(-h.y()), h.y());
    Vec3<W> best(-h.x(), y, -h.z());
    for (const Vec3<W>& corner : {Vec3<W>(h.x(), y, -h.z()), Vec3<W>(-h.x(), y, h.z())})
      best = select<W>(n.dot(corner) > n.dot(best), corner, best);
    return best;
  }

  template <class W>
  PointJet<W> jet(const Vec3<W>& n) const {
    return {support(n)};
  }
};

/// A box by its declaration, under another name.
struct SaidBox : Box {};

/// Declares something, but not to us.
struct OtherDeclaration {
  static constexpr bool declared = true;
};

template <class MakeModel>
CastResult<double> cast(MakeModel&& make_model, const Ray<double>& ray, double rounding) {
  const Ball<double> ball{Vec3<double>::Zero(), std::sqrt(3.0) + rounding};
  const Vec3<double> half_extents = Vec3<double>::Constant(1.0 + rounding);
  return result_of(model_cast<double>(make_model, ray_near<double>(ball.centre, ray), ball,
                                      half_extents, true, 64, NoObserver()));
}

CastResult<double> cast_at_wedge(const Ray<double>& ray) {
  const Wedge wedge;
  return cast(
      [&](const Vec3<double>& s, const Vec3<double>& r) {
        return PolytopeModel<double, Wedge>(wedge, Vec3<double>::Zero(), s, r, std::sqrt(3.0));
      },
      ray, 0.0);
}

CastResult<double> cast_at_rounded_wedge(const Ray<double>& ray, double radius) {
  const Wedge wedge;
  return cast(
      [&](const Vec3<double>& s, const Vec3<double>& r) {
        return TranslatesModel<double, RoundedPolytope<double, Wedge>>(
            {wedge, radius}, Vec3<double>::Zero(), s, r, std::sqrt(3.0) + radius);
      },
      ray, radius);
}

TEST(Declarations, a_wedge_is_no_box_whatever_its_size_is_called) {
  const Ray<double> above{Vec3<double>(0.9, 5.0, 0.9), -Vec3<double>::UnitY(), 100.0};
  EXPECT_EQ(cast_at_wedge(above).status, Status::miss);
  EXPECT_EQ(cast_at_rounded_wedge(above, 0.125).status, Status::miss);

  const Ray<double> onto_slope{Vec3<double>(5.0, 0.25, 0.5), -Vec3<double>::UnitX(), 100.0};
  const CastResult<double> hit = cast_at_wedge(onto_slope);
  ASSERT_EQ(hit.status, Status::hit);
  EXPECT_NEAR(hit.t(), 5.5, 8 * tolerance::epsilon<double>);
  EXPECT_NEAR(hit.normal.x(), std::sqrt(0.5), 8 * tolerance::epsilon<double>);

  const CastResult<double> rounded = cast_at_rounded_wedge(onto_slope, 0.125);
  ASSERT_EQ(rounded.status, Status::hit);
  EXPECT_NEAR(rounded.t(), 5.5 - 0.125 * std::sqrt(2.0), 16 * tolerance::epsilon<double>);
}

TEST(Declarations, only_what_a_header_declares_is_known) {
  EXPECT_FALSE(declared_by<Wedge>.slabs);
  EXPECT_FALSE((Facets<double, Wedge>::some));
  EXPECT_FALSE(declared_by<OtherDeclaration>.slabs);
  EXPECT_TRUE(declared_by<Box>.slabs);
  EXPECT_TRUE(declared_by<SaidBox>.slabs);
  EXPECT_TRUE(declared_by<Hull>.facets && declared_by<Hull>.support_where);
  EXPECT_TRUE(declared_by<Superellipsoid>.gauge);
  EXPECT_FALSE(declared_by<Shape>.slabs);  // the list of all shapes is none of them
}

}  // namespace
}  // namespace minkray
