// SPDX-License-Identifier: MIT
#include "core/mesh/perturbed_line.h"

#include <cmath>
#include <vector>

#include "core/math/two_fold.h"
#include "core/mesh/exact_sign.h"

namespace minkray {
namespace {

/// A number as a sum of doubles that do not overlap, the largest last (Shewchuk 1997).
class Exact {
 public:
  Exact() = default;
  Exact(double x) {
    if (x != 0) terms_.push_back(x);
  }
  /// a - b.
  static Exact difference(double a, double b) {
    Exact exact(a);
    exact.add(-b);
    return exact;
  }

  int sign() const { return terms_.empty() ? 0 : terms_.back() > 0 ? 1 : -1; }

  friend Exact operator-(Exact x) {
    for (double& term : x.terms_) term = -term;
    return x;
  }
  friend Exact operator+(Exact a, const Exact& b) {
    for (const double term : b.terms_) a.add(term);
    return a;
  }
  friend Exact operator-(const Exact& a, const Exact& b) { return a + -b; }
  friend Exact operator*(const Exact& a, const Exact& b) {
    Exact product;
    for (const double x : a.terms_)
      for (const double y : b.terms_) {
        const TwoFold<double> both = two_product(x, y);
        product.add(both.low);
        product.add(both.high);
      }
    return product;
  }

 private:
  void add(double x) {
    std::size_t kept = 0;
    for (const double term : terms_) {
      const TwoFold<double> sum = two_sum(x, term);
      x = sum.high;
      if (sum.low != 0) terms_[kept++] = sum.low;
    }
    terms_.resize(kept);
    if (x != 0) terms_.push_back(x);
  }

  std::vector<double> terms_;
};

using ExactVec = std::array<Exact, 3>;

ExactVec exact(const Vec3<double>& v) {
  return {Exact(v.x()), Exact(v.y()), Exact(v.z())};
}
ExactVec difference(const Vec3<double>& a, const Vec3<double>& b) {
  return {Exact::difference(a.x(), b.x()), Exact::difference(a.y(), b.y()),
          Exact::difference(a.z(), b.z())};
}
ExactVec cross(const ExactVec& a, const ExactVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Exact dot(const ExactVec& a, const ExactVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// Sign of the first component that is not zero.
int first_sign(const ExactVec& v) {
  for (const Exact& x : v)
    if (x.sign() != 0) return x.sign();
  return 0;
}

double largest(const Vec3<double>& v) {
  return v.cwiseAbs().maxCoeff();
}

}  // namespace

// The origin moves by (e1, e2, e3), the direction by (1, m, m^2) f, with 1 >> m >> m^2 >> e1 >> e2
// >> e3 >> f > 0. The side is the sign of d . ((a - o) x e), e = b - a: a polynomial in these
// amounts, whose leading coefficients follow in the order of their sizes.
int moved_side_of_edge(const Vec3<double>& o, const Vec3<double>& d, const Vec3<double>& a,
                       const Vec3<double>& b) {
  if (const int side = exact_side_of_edge(o, d, a, b)) return side;
  const ExactVec edge = difference(b, a);
  if (const int side = first_sign(cross(exact(d), edge))) return side;
  // The edge is parallel to the ray: only a change of direction has an effect.
  if (const int side = first_sign(cross(difference(a, o), edge))) return side;
  // The ray contains the edge: the coefficients are those of m e1, m^2 e1 and m^2 e2.
  if (const int side = edge[2].sign()) return side;
  if (const int side = edge[1].sign()) return -side;
  return edge[0].sign();
}

// A plane with the normal n through a is met at t = n . (a - o) / n . d. Moving o by e changes this
// by -(n . e) / n . d.
int order_along(const Ray<double>& ray, const TriangleCorners& first,
                const TriangleCorners& second) {
  // Powers of two scale exactly, and keep products in the range of double.
  int size = 0, length = 0;
  double most = largest(ray.origin);
  for (const TriangleCorners* corners : {&first, &second})
    for (const Vec3<double>& corner : *corners) most = std::max(most, largest(corner));
  std::frexp(most, &size);
  std::frexp(largest(ray.direction), &length);
  const auto scaled = [](Vec3<double> v, int exponent) {
    for (double& x : v) x = std::ldexp(x, -exponent);
    return v;
  };
  const Vec3<double> o = scaled(ray.origin, size);
  const ExactVec d = exact(scaled(ray.direction, length));
  struct Plane {
    ExactVec normal;
    Exact height, slope;
  };
  const auto plane_of = [&](const TriangleCorners& corners) {
    const Vec3<double> a = scaled(corners[0], size), b = scaled(corners[1], size),
                       c = scaled(corners[2], size);
    Plane plane{cross(difference(b, a), difference(c, a)), {}, {}};
    plane.height = dot(plane.normal, difference(a, o));
    plane.slope = dot(plane.normal, d);
    return plane;
  };
  const Plane p = plane_of(first), q = plane_of(second);
  const int slopes = p.slope.sign() * q.slope.sign();
  if (const int order = (p.height * q.slope - q.height * p.slope).sign()) return order * slopes;
  for (std::size_t k = 0; k < 3; ++k)
    if (const int order = (q.normal[k] * p.slope - p.normal[k] * q.slope).sign())
      return order * slopes;
  return 0;
}

}  // namespace minkray
