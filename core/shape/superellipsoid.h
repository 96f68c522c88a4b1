// SPDX-License-Identifier: MIT
// A superellipsoid |x/a|^p + |y/b|^p + |z/c|^p <= 1: an octahedron for p = 1, an ellipsoid for
// p = 2, nearly a box for large p.
#pragma once

#include "core/math/power.h"
#include "core/support/declared.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

struct Superellipsoid {
  Vec3<double> radii = Vec3<double>::Ones();
  double exponent = 2.0;

  static constexpr std::string_view name = "superellipsoid";
  static constexpr std::string_view doc = "All points with |x/a|^p + |y/b|^p + |z/c|^p <= 1.";
  static constexpr Declared declared = {.gauge = true};
  static constexpr auto fields() {
    return std::tuple{Field{"radii", &Superellipsoid::radii, Unit::length, Range::positive,
                            "a, b and c: its radii along x, y and z"},
                      Field{"exponent", &Superellipsoid::exponent, Unit::none, Range::at_least_one,
                            "p: 1 for an octahedron, 2 for an ellipsoid, more for nearly a box"}};
  }

  /// True just above 1, where edges are curved so much more than faces that a model that agrees
  /// with one plane may be far off (observed at 1 + 2^-14). For exactly 1, the corners are known.
  bool is_nearly_sharp() const { return exponent > 1.0 && exponent < 1 + least_above_1; }

  /// Returns the support point s. By Hoelder's inequality with 1/p + 1/q = 1, s_i = a_i sign(n_i)
  /// (m_i/|m|_q)^(q-1) with m_i = |a_i n_i|. m is scaled by its largest component, so that no power
  /// overflows and p = 1 (q infinite) gives a vertex, or the mean of the vertices that tie.
  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    using std::abs;
    using std::max;
    using N = Lane<W>;
    const Vec3<W> a = widen<W>(radii);
    const Vec3<W> an = n.cwiseProduct(a);
    const Vec3<W> m(abs(an.x()), abs(an.y()), abs(an.z()));
    const W largest = max(m.x(), max(m.y(), m.z()));
    const W scale = select(largest > W(0), largest, W(1));
    const N p = N(exponent), q_less_1 = N(1) / (p - N(1));
    const Vec3<W> u(m.x() / scale, m.y() / scale, m.z() / scale);
    const Vec3<W> powers(power<W>(u.x(), q_less_1), power<W>(u.y(), q_less_1),
                         power<W>(u.z(), q_less_1));
    const W sum = u.dot(powers);
    const W length = power<W>(select(sum > W(0), sum, W(1)), N(1) / p);
    const Vec3<W> s = powers.cwiseProduct(a) * (W(1) / length);
    return {select(n.x() < W(0), W(-s.x()), s.x()), select(n.y() < W(0), W(-s.y()), s.y()),
            select(n.z() < W(0), W(-s.z()), s.z())};
  }

  /// Returns the osculating ellipsoid. With u = m/|m|_q and g_i = sign(n_i) u_i^(q-1), its shape
  /// matrix is diag(a) ((q-1) diag(u^(q-2)) - (q-2) g g^T) diag(a). On the coordinate planes the
  /// radius of curvature is infinite for p > 2, so g is kept above a small number there. For p < 2
  /// the radius is 0 and must stay 0: a model with a larger radius would extend beyond the shape.
  template <class W>
  Jet<W> jet(const Vec3<W>& n) const {
    using std::abs;
    using std::max;
    using N = Lane<W>;
    if (exponent == 2) return AxialEllipsoidJet<W>{widen<W>(radii)};
    if (!(exponent > 1)) return PointJet<W>{support(n)};
    const Vec3<W> a = widen<W>(radii);
    const Vec3<W> s = support(n);
    const Vec3<W> g = s.cwiseQuotient(a);
    const N p = N(exponent), q = p / (p - N(1));
    const N least = exponent > 2 ? N(least_of_jet) : N(0);
    Mat3<W> A = g * g.transpose() * W(N(2) - q);
    for (int i = 0; i < 3; ++i) {
      // |g_i| = u_i^(q-1), so u_i^(q-2) = |g_i|^((q-2)/(q-1)).
      const W size = max(W(abs(g[i])), W(least));
      A(i, i) += W(q - N(1)) * power<W>(size, (q - N(2)) / (q - N(1)));
    }
    return {Vec3<W>::Zero(), a.asDiagonal() * factor<W>(A), Mask<W>(false), s};
  }

  /// Gauge |x/a|_p of points x(lambda) = (u + lambda v) a on a line: the least factor by which the
  /// shape must be scaled to contain the point. The gauge is convex, and 1 on the surface.
  template <class W>
  struct Gauge {
    W value;
    /// Gradient with respect to x/a, with length 1 in the dual norm. gradient/a is the normal of
    /// the supporting plane at the point where the line from the middle to x meets the surface. The
    /// gauge of any x is at least gradient.(x/a).
    Vec3<W> gradient;
    W slope;      ///< derivative with respect to lambda
    W curvature;  ///< half of the second derivative of the gauge's square
  };

  template <class W>
  Gauge<W> gauge_along(const Vec3<W>& u, const Vec3<W>& v, const W& lambda) const {
    using std::abs;
    using std::copysign;
    using std::max;
    using N = Lane<W>;
    const Vec3<W> x = u + v * lambda;
    const Vec3<W> size(abs(x.x()), abs(x.y()), abs(x.z()));
    const W largest = max(size.x(), max(size.y(), size.z()));
    const Vec3<W> k = size * (W(1) / select(largest > W(0), largest, W(1)));
    const N p = N(exponent);
    const Vec3<W> powers(power<W>(k.x(), p - N(1)), power<W>(k.y(), p - N(1)),
                         power<W>(k.z(), p - N(1)));
    // The largest k is 1 up to rounding.
    const W sum = max(W(1), W(powers.dot(k)));
    const W root = power<W>(sum, N(1) / p), scale = root / sum;
    Gauge<W> gauge;
    gauge.value = largest * root;
    W squares(0);
    for (int i = 0; i < 3; ++i) {
      gauge.gradient[i] = copysign(W(powers[i] * scale), x[i]);
      squares += powers[i] / max(k[i], W(least_curvature)) * (v[i] * v[i]);
    }
    gauge.slope = gauge.gradient.dot(v);
    const W slope_squared = gauge.slope * gauge.slope;
    gauge.curvature =
        slope_squared + W(p - N(1)) * max(W(squares * (root * scale) - slope_squared), W(0));
    return gauge;
  }

  /// About 3^(1/2 - 1/p): the product of the radii of the largest ball inside the shape and the
  /// smallest ball around it, in units of `radii`.
  template <class T>
  T squared_start() const {
    constexpr T box = T(1.7320508), octahedron = T(0.57735027);
    return std::max(octahedron, box - (T(2) * box - T(2)) / exponent);
  }

  /// For p >= 3, the gauge's third derivative is at most about p^2. For smaller p, the derivative
  /// is unbounded where a coordinate changes sign, and the gauge deviates from the parabola like
  /// |x|^p.
  template <class W>
  W parabola_error(const W& step) const {
    using T = Lane<W>;
    const T p = exponent;
    if (p < T(3)) return power<W>(step, p);
    return step * step * step * W(T(1) + p * p * T(0.25));
  }

 private:
  static constexpr double least_above_1 = 0x1p-10;
  /// Lower limit of coordinates that are divisors in the second derivative, which is infinite on
  /// the coordinate planes for p < 2.
  static constexpr double least_curvature = 1.0 / 4096;
  /// Lower limit of |g_i| in jets. For p up to 4, the osculating ellipsoid is at most about
  /// 1/least_of_jet times as long as the shape.
  static constexpr double least_of_jet = 1.0 / 256;
};

}  // namespace minkray
