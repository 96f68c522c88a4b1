// SPDX-License-Identifier: MIT
#include "core/mesh/exact_sign.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace minkray {
namespace {

using Whole = std::array<std::int64_t, 3>;

Vec3<double> as_vector(const Whole& v) {
  return {double(v[0]), double(v[1]), double(v[2])};
}
Whole minus(const Whole& a, const Whole& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
std::int64_t determinant(const Whole& u, const Whole& v, const Whole& w) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    sum += u[k] * (v[i] * w[j] - v[j] * w[i]);
  }
  return sum;
}
int sign(std::int64_t x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

Whole random_whole(testing::Random& random, int most) {
  return {random.below(2 * most + 1) - most, random.below(2 * most + 1) - most,
          random.below(2 * most + 1) - most};
}

TEST(ExactSign, of_whole_numbers_is_that_of_whole_arithmetic) {
  testing::Random random(1);
  int zeros = 0;
  for (int i = 0; i < 100000; ++i) {
    const int most = i % 2 == 0 ? 3 : 50000;
    const Whole o = random_whole(random, most), d = random_whole(random, most),
                a = random_whole(random, most), b = random_whole(random, most);
    const int edge = sign(determinant(d, minus(a, o), minus(b, a)));
    zeros += edge == 0 ? 1 : 0;
    ASSERT_EQ(exact_side_of_edge(as_vector(o), as_vector(d), as_vector(a), as_vector(b)), edge);
    ASSERT_EQ(exact_side_of_plane(as_vector(o), as_vector(a), as_vector(b), as_vector(d)),
              sign(determinant(minus(d, o), minus(a, o), minus(b, o))));
  }
  EXPECT_GT(zeros, 2000);
}

TEST(ExactSign, tells_what_double_does_not) {
  // The edge lies along (1, 1, 0) but for the last digit of one coordinate.
  const Vec3<double> o(0, 0, 1), down(0, 0, -1);
  const double above = std::nextafter(1e8, 1e9);
  EXPECT_EQ(exact_side_of_edge(o, down, {-1e8, -1e8, 0}, {1e8, 1e8, 0}), 0);
  const int left = exact_side_of_edge(o, down, {-1e8, -1e8, 0}, {1e8, above, 0});
  EXPECT_NE(left, 0);
  EXPECT_EQ(exact_side_of_edge(o, down, {-1e8, -1e8, 0}, {above, 1e8, 0}), -left);
}

TEST(ExactSign, of_an_edge_is_the_opposite_from_the_other_end) {
  testing::Random random(2);
  for (int i = 0; i < 20000; ++i) {
    const Vec3<double> a = random.in_cube(), b = random.in_cube(), o = 3 * random.direction();
    const Vec3<double> d = a + random.uniform() * (b - a) - o;
    ASSERT_EQ(exact_side_of_edge(o, d, a, b), -exact_side_of_edge(o, d, b, a));
  }
}

}  // namespace
}  // namespace minkray
