// SPDX-License-Identifier: MIT
// A superellipsoid |x/a|^p + |y/b|^p + |z/c|^p <= 1: the octahedron at p = 1, the ellipsoid at
// p = 2, towards the box as p grows.
#pragma once

#include "core/math/vec.h"
#include "core/shape/field.h"

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
};

}  // namespace minkray
