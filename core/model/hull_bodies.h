// SPDX-License-Identifier: MIT
// The bodies that a hull cast supports: a ball and an ellipsoid. Each has its support function, and
// the normals where the ray meets the body alone or swept along an edge. docs/forms.md derives
// them. The frame is that of hull_cast.h.
#pragma once

#include "core/query/ray_frame.h"
#include "core/query/tolerances.h"

namespace minkray {

/// A ball, the body of rounded polytopes.
template <class W>
struct RoundBody {
  W radius;

  /// Support function along m, which has unit length up to rounding.
  W support_function(const Vec3<W>& m) const {
    return radius * (W(Lane<W>(0.5)) * (W(1) + m.squaredNorm()));
  }
  Vec3<W> support_point(const Vec3<W>& m) const { return m * radius; }

  /// Unit normal where the ray meets the body around c. If the ray misses the body: the body's
  /// normal towards the ray, perpendicular to it.
  Vec3<W> alone(const Vec3<W>& c) const {
    using std::max;
    using std::sqrt;
    const W den = radius * radius - (c.x() * c.x() + c.y() * c.y());
    return unit<W>({-c.x(), -c.y(), sqrt(max(den, W(0)))});
  }

  /// Same as `alone`, for the cylinder that the body sweeps along e. `touch` is the point, relative
  /// to the body's centre, where the ray meets the cylinder. If the ray misses the cylinder,
  /// `touch` is the point where the ray would touch a larger one.
  Vec3<W> swept(const Vec3<W>& c, const Vec3<W>& e, const W& length, Vec3<W>& touch) const {
    using std::abs;
    using std::max;
    using std::sqrt;
    const Vec3<W> t(-e.y() / length, e.x() / length, W(0));
    const Vec3<W> w = unit<W>({-e.x() * e.z(), -e.y() * e.z(), length * length});
    const W L = t.x() * c.x() + t.y() * c.y();
    const W den = radius * radius - L * L;
    const Mask<W> crosses = den > W(0);
    const Vec3<W> onto = unit<W>(Vec3<W>(w * sqrt(max(den, W(0))) - t * L));
    const Vec3<W> m = select<W>(crosses, onto, select<W>(L > W(0), Vec3<W>(-t), t));
    touch = m * select(crosses, radius, W(abs(L)));
    return m;
  }

  /// Balls have no flat sides.
  void between_disks(const Vec3<W>&, const Vec3<W>&, const Vec3<W>&, W&, Mask<W>&) const {}
};

/// An ellipsoid { F b : |b| <= 1 }; columns of F may be zero.
template <class W>
struct EllipsoidBody {
  Mat3<W> F;

  W support_function(const Vec3<W>& m) const { return (F.transpose() * m).norm(); }
  /// Uses a unit vector, so that the result is a point of the ellipsoid even if F^T m consists of
  /// rounding only. For a disk and its axis, returns the centre.
  Vec3<W> support_point(const Vec3<W>& m) const {
    const Vec3<W> u = F.transpose() * m;
    const Vec3<W> support_point = F * unit<W>(u);
    const Mask<W> along = is_along_axis(u);
    return any(along) ? select<W>(along, Vec3<W>(Vec3<W>::Zero()), support_point) : support_point;
  }

  /// True if F is a disk and u = F^T m is zero up to rounding.
  Mask<W> is_along_axis(const Vec3<W>& u) const {
    const Mask<W> is_disk = F.col(2).cwiseAbs().sum() == W(0);
    if (!any(is_disk)) return is_disk;
    return is_disk & (u.cwiseAbs().sum() <= F.cwiseAbs().sum() * W(tolerance::flat_disk<Lane<W>>));
  }

  /// For two disks in a plane perpendicular to m: finds a point b + share e between their centres
  /// such that the ray meets the disk around this point. `meets` is true if there is such a point.
  void between_disks(const Vec3<W>& m, const Vec3<W>& b, const Vec3<W>& e, W& share,
                     Mask<W>& meets) const {
    const Mask<W> along = is_along_axis(F.transpose() * m);
    if (!any(along)) return;
    // In units of the disk: x = F y.
    const Vec3<W> f = F.col(0), g = F.col(1);
    const W det = cross_2d(f, g);
    const auto unit_x = [&](const Vec3<W>& v) { return cross_2d(v, g) / det; };
    const auto unit_y = [&](const Vec3<W>& v) { return cross_2d(f, v) / det; };
    const W b_x = unit_x(b), b_y = unit_y(b), e_x = unit_x(e), e_y = unit_y(e);
    const W between = -(b_x * e_x + b_y * e_y) / (e_x * e_x + e_y * e_y);
    const W x = b_x + between * e_x, y = b_y + between * e_y;
    const Mask<W> inside = (between >= W(0)) & (between <= W(1)) & (x * x + y * y <= W(1));
    share = select(along, between, share);
    meets = (along & inside) | ((!along) & meets);
  }

  Vec3<W> alone(const Vec3<W>& c) const {
    using std::abs;
    using std::max;
    using std::sqrt;
    // With N_kl = f_k x f_l, the determinant is the sum of N_kl.z^2. The other minors of A = F F^T,
    // such as adj c, are also sums of products of N_kl. These keep digits that A itself loses for
    // needles.
    W det(0), off(0);
    Vec3<W> across = Vec3<W>::Zero(), adj = Vec3<W>::Zero();
    for (int k = 0; k < 3; ++k) {
      for (int l = k + 1; l < 3; ++l) {
        const Vec3<W> N = F.col(k).cross(F.col(l));
        det += N.z() * N.z();
        across += N * N.z();
      }
      const W moment = F(0, k) * c.y() - F(1, k) * c.x();
      off += moment * moment;
      adj += Vec3<W>(-F(1, k), F(0, k), W(0)) * moment;
    }
    const W volume = abs(F.col(0).dot(F.col(1).cross(F.col(2))));
    const W den = det - off;
    const Vec3<W> onto = across * sqrt(max(den, W(0))) - adj * volume;
    return unit<W>(select<W>(den > W(0), onto, Vec3<W>(-adj)));
  }

  Vec3<W> swept(const Vec3<W>& c, const Vec3<W>& e, const W& length, Vec3<W>& touch) const {
    using std::abs;
    using std::max;
    using std::sqrt;
    const Vec3<W> t(-e.y() / length, e.x() / length, W(0));
    const Vec3<W> w = unit<W>({-e.x() * e.z(), -e.y() * e.z(), length * length});
    const Vec3<W> yw = F.transpose() * w, yt = F.transpose() * t;
    const W ga = yt.squaredNorm(), et = yw.dot(yt), D = yw.cross(yt).norm();
    const W L = -t.dot(c);
    const W den = ga - L * L, root = sqrt(max(den, W(0)));
    const Mask<W> crosses = den > W(0);
    const Vec3<W> onto = w * (ga * root) + t * (L * D - et * root);
    const Vec3<W> m = select<W>(crosses, unit<W>(onto), select<W>(L < W(0), Vec3<W>(-t), t));
    const Vec3<W> grown = F * (F.transpose() * m) * (abs(L) / select(ga > W(0), ga, W(1)));
    touch = select<W>(crosses, support_point(m), grown);
    return m;
  }
};

}  // namespace minkray
