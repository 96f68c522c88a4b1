// SPDX-License-Identifier: MIT
// The subalgorithms of GJK find the point of a simplex that is nearest to the origin.
#include <gtest/gtest.h>

#include <random>

#include "core/gjk/simplex.h"
#include "renderer/paper/johnson.h"
#include "renderer/paper/signed_volumes.h"
#include "tests/oracle/wolfe.h"

namespace minkray {
namespace {

template <class T>
class Subalgorithms : public ::testing::Test {};
using Kinds = ::testing::Types<JohnsonSubalgorithm<double, 3>, SignedVolumesSubalgorithm<double, 3>,
                               Simplex<double, 3>, JohnsonSubalgorithm<double, 2>,
                               SignedVolumesSubalgorithm<double, 2>, Simplex<double, 2>>;
TYPED_TEST_SUITE(Subalgorithms, Kinds);

TYPED_TEST(Subalgorithms, find_wolfes_point_of_random_simplices_and_after_translations) {
  constexpr int Dim = TypeParam::dimension;
  using V = Vec<double, Dim>;
  std::mt19937 engine(6);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] {
    V p;
    for (int i = 0; i < Dim; ++i) p[i] = coordinate(engine);
    return p;
  };
  int full = 0;
  for (int run = 0; run < 2000; ++run) {
    TypeParam simplex;
    const V first = 0.5 * point();
    simplex.begin(first);
    std::vector<V> vertices;
    const int size = 1 + run % (Dim + 1);
    for (int i = 0; i < size; ++i) {
      vertices.push_back(point());
      simplex.add(vertices.back());
    }
    for (const V& x : {first, V(0.5 * point())}) {
      simplex.move(x);
      std::vector<oracle::Column<Dim>> y;
      for (const V& p : vertices) y.push_back((x - p).template cast<long double>());
      const V expected = oracle::nearest_to_origin<Dim>(y).template cast<double>();
      const ClosestPoint<double, Dim> answer = simplex.closest();
      EXPECT_LT((answer.v - expected).norm(), 1e-10) << run;
      V sum = V::Zero();
      double weights = 0;
      for (int i = 0; i <= Dim; ++i) {
        const double weight = answer.weights[static_cast<std::size_t>(i)];
        EXPECT_EQ(weight > 0, ((answer.kept >> i) & 1u) == 1u);
        if (weight > 0) sum += weight * simplex.y(i);
        weights += weight;
      }
      EXPECT_NEAR(weights, 1, 1e-12);
      EXPECT_LT((sum - expected).norm(), 1e-10) << run;
      full += answer.kept == TypeParam::all_slots;
    }
  }
  EXPECT_GT(full, 40);
}

TYPED_TEST(Subalgorithms, know_nothing_of_what_they_were_asked_before) {
  constexpr int Dim = TypeParam::dimension;
  using V = Vec<double, Dim>;
  TypeParam simplex;
  simplex.begin(V::Zero());
  simplex.add(V::Constant(0.25));
  simplex.add(V::Constant(-0.5));
  const V far = V::Constant(3);
  simplex.begin(V::Zero());
  simplex.add(far);
  EXPECT_EQ(simplex.closest().v, V(-far));
  EXPECT_EQ(simplex.furthest_squared(), far.squaredNorm());
}

TYPED_TEST(Subalgorithms, answer_degenerate_simplices_with_a_point_of_them) {
  constexpr int Dim = TypeParam::dimension;
  using V = Vec<double, Dim>;
  // Collinear and nearly coincident vertices, the origin next to them: the distance is 1.
  for (const double spread : {1.0, 1e-4, 1e-8}) {
    TypeParam simplex;
    simplex.begin(V::Zero());
    for (int i = 0; i <= Dim; ++i) {
      V p = V::Zero();
      p[0] = 1;
      p[1] = spread * (i - 0.75);
      simplex.add(p);
    }
    EXPECT_NEAR(simplex.closest().v.norm(), 1.0, 1e-12) << spread;
  }
}

TEST(Johnson, discarded_vertices_free_their_slots_and_the_cache_forgets_them) {
  JohnsonSubalgorithm<double, 3> kept, fresh;
  const Vec3<double> x(0.1, 0.2, 0.3);
  const std::array<Vec3<double>, 5> p = {
      Vec3<double>(1, 0, 0), {0, 1, 0.5}, {-1, 0.25, 0}, {0.3, -1, 2}, {0.5, 0.5, -1}};
  kept.begin(x);
  for (std::size_t i = 0; i < 4; ++i) kept.add(p[i]);
  kept.keep(0b1010);
  kept.add(p[4]);
  fresh.begin(x);
  for (const std::size_t i : {4u, 1u, 3u}) fresh.add(p[i]);
  EXPECT_EQ((kept.closest().v - fresh.closest().v).norm(), 0.0);
}

}  // namespace
}  // namespace minkray
