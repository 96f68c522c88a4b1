// SPDX-License-Identifier: MIT
#include "core/mesh/exact_sign.h"

#include <array>
#include <cmath>

#include "core/math/two_fold.h"

namespace minkray {
namespace {

/// A sum of numbers that do not overlap, the largest last: an expansion in Shewchuk's sense.
class ExactSum {
 public:
  void add(double x) {
    if (is_beyond_) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const TwoFold<double> sum = two_sum(x, terms_[i]);
      x = sum.high;
      if (sum.low != 0) terms_[kept++] = sum.low;
    }
    if (x != 0) terms_[kept++] = x;
    // Numbers that are not finite would never cancel, and need more room than there is.
    is_beyond_ = !std::isfinite(x);
    size_ = is_beyond_ ? 0 : kept;
  }
  /// a * b * c, each the sum of two numbers.
  void add_product(const TwoFold<double>& a, const TwoFold<double>& b, const TwoFold<double>& c) {
    for (const double x : {a.high, a.low})
      for (const double y : {b.high, b.low}) {
        if (x == 0 || y == 0) continue;
        const TwoFold<double> xy = two_product(x, y);
        for (const double part : {xy.high, xy.low})
          for (const double z : {c.high, c.low}) {
            if (part == 0 || z == 0) continue;
            const TwoFold<double> xyz = two_product(part, z);
            add(xyz.low);
            add(xyz.high);
          }
      }
  }
  int sign() const { return size_ == 0 ? 0 : terms_[size_ - 1] > 0 ? 1 : -1; }

 private:
  // Six products of three sums of two make 16 numbers each.
  static constexpr std::size_t most_terms = 6 * 16 + 1;
  std::array<double, most_terms> terms_;
  std::size_t size_ = 0;
  bool is_beyond_ = false;
};

using Exact3 = std::array<TwoFold<double>, 3>;

Exact3 difference(const Vec3<double>& a, const Vec3<double>& b) {
  return {two_sum(a.x(), -b.x()), two_sum(a.y(), -b.y()), two_sum(a.z(), -b.z())};
}

TwoFold<double> minus(const TwoFold<double>& x) {
  return {-x.high, -x.low};
}

/// The sign of u . (v x w).
int sign_of_determinant(const Exact3& u, const Exact3& v, const Exact3& w) {
  ExactSum sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    sum.add_product(u[k], v[i], w[j]);
    sum.add_product(u[k], minus(v[j]), w[i]);
  }
  return sum.sign();
}

}  // namespace

int exact_side_of_edge(const Vec3<double>& o, const Vec3<double>& d, const Vec3<double>& a,
                       const Vec3<double>& b) {
  const Exact3 direction = {{{d.x(), 0}, {d.y(), 0}, {d.z(), 0}}};
  return sign_of_determinant(direction, difference(a, o), difference(b, a));
}

int exact_side_of_plane(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c,
                        const Vec3<double>& d) {
  return sign_of_determinant(difference(d, a), difference(b, a), difference(c, a));
}

}  // namespace minkray
