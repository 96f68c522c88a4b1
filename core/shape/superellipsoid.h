// SPDX-License-Identifier: MIT
// A superellipsoid |x/a|^p + |y/b|^p + |z/c|^p <= 1: the octahedron at p = 1, the ellipsoid at
// p = 2, towards the box as p grows.
#pragma once

#include "core/math/vec.h"
#include "core/shape/field.h"
#include "core/shape/jet.h"

namespace minkray {

template <class T>
struct Superellipsoid {
  Vec3<T> radii = Vec3<T>::Ones();
  T exponent = T(2);

  static constexpr std::string_view name = "superellipsoid";
  static constexpr std::string_view doc = "All points with |x/a|^p + |y/b|^p + |z/c|^p <= 1.";
  static constexpr auto fields() {
    return std::tuple{Field{"radii", &Superellipsoid::radii, Unit::length, Range::positive,
                            "a, b and c: its radii along x, y and z"},
                      Field{"exponent", &Superellipsoid::exponent, Unit::none, Range::at_least_one,
                            "p: 1 an octahedron, 2 an ellipsoid, the larger the boxier"}};
  }

  /// By Hoelder's inequality with 1/p + 1/q = 1, s_i = a_i sign(n_i) (m_i/|m|_q)^(q-1) with
  /// m_i = |a_i n_i|. m is scaled by its largest component, so that no power overflows and p = 1
  /// (q infinite) comes out as a vertex, or the mean of the vertices that tie.
  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    using std::abs;
    using std::max;
    const Vec3<W> a = widen<W>(radii);
    const Vec3<W> an = n.cwiseProduct(a);
    const Vec3<W> m(abs(an.x()), abs(an.y()), abs(an.z()));
    const W largest = max(m.x(), max(m.y(), m.z()));
    const W scale = select(largest > W(0), largest, W(1));
    const W q_less_1 = W(T(1) / (exponent - T(1)));
    const Vec3<W> u(m.x() / scale, m.y() / scale, m.z() / scale);
    const Vec3<W> powers(power(u.x(), q_less_1), power(u.y(), q_less_1), power(u.z(), q_less_1));
    const W sum = u.dot(powers);
    const W length = power(select(sum > W(0), sum, W(1)), W(T(1) / exponent));
    const Vec3<W> s = powers.cwiseProduct(a) * (W(1) / length);
    return {select(n.x() < W(0), W(-s.x()), s.x()), select(n.y() < W(0), W(-s.y()), s.y()),
            select(n.z() < W(0), W(-s.z()), s.z())};
  }

  /// With u = m/|m|_q and g_i = sign(n_i) u_i^(q-1), the osculating ellipsoid has the shape matrix
  /// diag(a) ((q-1) diag(u^(q-2)) - (q-2) g g^T) diag(a). Where p > 2 the radius of curvature is
  /// infinite on the coordinate planes; u is kept above a small number there.
  template <class W>
  Jet<W> jet(const Vec3<W>& n) const {
    using std::abs;
    using std::max;
    if (exponent == T(2)) return AxialEllipsoidJet<W>{widen<W>(radii)};
    if (!(exponent > T(1))) return PointJet<W>{support(n)};
    const Vec3<W> a = widen<W>(radii);
    const Vec3<W> s = support(n);
    const Vec3<W> g = s.cwiseQuotient(a);
    const W q = W(exponent / (exponent - T(1)));
    Mat3<W> A = g * g.transpose() * (W(2) - q);
    for (int i = 0; i < 3; ++i) {
      // |g_i| = u_i^(q-1), so u_i^(q-2) = |g_i|^((q-2)/(q-1)).
      const W size = max(W(abs(g[i])), W(least_of_jet));
      A(i, i) += (q - W(1)) * power(size, W((q - W(2)) / (q - W(1))));
    }
    return {Vec3<W>::Zero(), a.asDiagonal() * factor<W>(A), Mask<W>(false), s};
  }

 private:
  /// For p up to 4, the osculating ellipsoid is at most about 1/this times as long as the shape.
  static constexpr T least_of_jet = T(1) / T(256);
};

}  // namespace minkray
