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
template <class T>
struct Wedge {
  Vec3<T> half_extents = Vec3<T>::Ones();

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
template <class T>
struct SaidBox : Box<T> {};

/// Declares something, but not to us.
struct OtherDeclaration {
  static constexpr bool declared = true;
};

template <class T, class MakeModel>
CastResult<T> cast(MakeModel&& make_model, const Ray<T>& ray, T rounding) {
  const Ball<T> ball{Vec3<T>::Zero(), std::sqrt(T(3)) + rounding};
  const Vec3<T> half_extents = Vec3<T>::Constant(T(1) + rounding);
  return result_of(model_cast<T>(make_model, ray_near<T>(ball.centre, ray), ball, half_extents,
                                 true, 64, NoObserver()));
}

template <class T>
CastResult<T> cast_at_wedge(const Ray<T>& ray) {
  const Wedge<T> wedge;
  return cast<T>(
      [&](const Vec3<T>& s, const Vec3<T>& r) {
        return PolytopeModel<T, Wedge<T>>(wedge, Vec3<T>::Zero(), s, r, std::sqrt(T(3)));
      },
      ray, T(0));
}

template <class T>
CastResult<T> cast_at_rounded_wedge(const Ray<T>& ray, T radius) {
  const Wedge<T> wedge;
  return cast<T>(
      [&](const Vec3<T>& s, const Vec3<T>& r) {
        return TranslatesModel<T, RoundedPolytope<T, Wedge<T>>>({wedge, radius}, Vec3<T>::Zero(), s,
                                                                r, std::sqrt(T(3)) + radius);
      },
      ray, radius);
}

template <class T>
class Declarations : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Declarations, Scalars);

TYPED_TEST(Declarations, a_wedge_is_no_box_whatever_its_size_is_called) {
  using T = TypeParam;
  const Ray<T> above{Vec3<T>(T(0.9), T(5), T(0.9)), -Vec3<T>::UnitY(), T(100)};
  EXPECT_EQ(cast_at_wedge(above).status, Status::miss);
  EXPECT_EQ(cast_at_rounded_wedge(above, T(0.125)).status, Status::miss);

  const Ray<T> onto_slope{Vec3<T>(T(5), T(0.25), T(0.5)), -Vec3<T>::UnitX(), T(100)};
  const CastResult<T> hit = cast_at_wedge(onto_slope);
  ASSERT_EQ(hit.status, Status::hit);
  EXPECT_NEAR(hit.t(), T(5.5), 8 * tolerance::epsilon<T>);
  EXPECT_NEAR(hit.normal.x(), std::sqrt(T(0.5)), 8 * tolerance::epsilon<T>);

  const CastResult<T> rounded = cast_at_rounded_wedge(onto_slope, T(0.125));
  ASSERT_EQ(rounded.status, Status::hit);
  EXPECT_NEAR(rounded.t(), T(5.5) - T(0.125) * std::sqrt(T(2)), 16 * tolerance::epsilon<T>);
}

TYPED_TEST(Declarations, only_what_a_header_declares_is_known) {
  using T = TypeParam;
  EXPECT_FALSE(declared_by<Wedge<T>>.slabs);
  EXPECT_FALSE((Facets<T, Wedge<T>>::some));
  EXPECT_FALSE(declared_by<OtherDeclaration>.slabs);
  EXPECT_TRUE(declared_by<Box<T>>.slabs);
  EXPECT_TRUE(declared_by<SaidBox<T>>.slabs);
  EXPECT_TRUE(declared_by<Hull<T>>.facets && declared_by<Hull<T>>.support_where);
  EXPECT_TRUE(declared_by<Superellipsoid<T>>.gauge);
  EXPECT_FALSE(declared_by<Shape<T>>.slabs);  // the list of all shapes is none of them
}

}  // namespace
}  // namespace minkray
