// SPDX-License-Identifier: MIT
#include "core/pair_derivative/pair_derivative_sharpen.h"

#include <array>
#include <cmath>

namespace minkray {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

CoreContact contact_along(const CoresInWorld& cores, const Vec3<double>& n) {
  const Vec3<double> a = cores.support_a(n);
  return {n, a, cores.support_b(-n) - a};
}

/// The part of c perpendicular to the normal; zero if the points are nearest.
Vec3<double> aside(const CoreContact& contact) {
  return contact.c - contact.normal.dot(contact.c) * contact.normal;
}

/// Newton's method for the normal n for which c is parallel to n, with a finite-difference
/// derivative. Accurate to rounding where both surfaces are smooth and curved.
bool by_newton(const CoresInWorld& cores, CoreContact& contact) {
  constexpr double step = 1e-5, furthest = 1e-3;
  constexpr int most_turns = 8;
  const double enough = 4 * epsilon * (cores.size() + cores.between.x.norm());
  CoreContact now = contact_along(cores, contact.normal);
  const Vec3<double> u = now.normal.unitOrthogonal(), v = now.normal.cross(u);
  const Vec3<double> from = aside(now);
  const auto slope = [&](const Vec3<double>& way) -> Vec3<double> {
    return (aside(contact_along(cores, unit<double>(now.normal + step * way))) - from) / step;
  };
  const Vec3<double> by_u = slope(u), by_v = slope(v);
  const double uu = by_u.dot(u), uv = by_v.dot(u), vu = by_u.dot(v), vv = by_v.dot(v);
  const double determinant = uu * vv - uv * vu;
  // At a least distance or a depth, both eigenvalues are negative.
  if (!(determinant > 0) || !(uu + vv < 0)) return false;
  double least = from.norm();
  const double first = least;
  for (int turn = 0; turn < most_turns && least > enough; ++turn) {
    const Vec3<double> off = aside(now);
    const double x = off.dot(u), y = off.dot(v);
    const Vec3<double> way =
        ((uv * y - vv * x) / determinant) * u + ((vu * x - uu * y) / determinant) * v;
    if (!(way.norm() <= furthest)) return false;
    const CoreContact next = contact_along(cores, unit<double>(now.normal + way));
    const double length = aside(next).norm();
    if (!(length < 0.5 * least)) break;
    least = length;
    now = next;
  }
  constexpr double precise = 1e-12;
  if (!(least <= precise * cores.size()) || !(least <= first)) return false;
  contact = now;
  return true;
}

struct Vertex {
  Vec3<double> c, a;
};

/// A simplex that finds its point nearest to the origin, and keeps the vertices that carry this
/// point. Computes the normals of slim triangles with their shortest side.
class SlimSimplex {
 public:
  void add(const Vertex& vertex) { vertices_[count_++] = vertex; }
  std::size_t count() const { return count_; }
  const Vertex& operator[](std::size_t i) const { return vertices_[i]; }

  Vertex shrink() {
    least_ = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) {
      take({{i, 0, 0}}, 1, {1, 0, 0});
      for (std::size_t j = i + 1; j < count_; ++j) {
        edge(i, j);
        for (std::size_t k = j + 1; k < count_; ++k) triangle(i, j, k);
      }
    }
    std::array<Vertex, 4> all = vertices_;
    for (std::size_t i = 0; i < kept_count_; ++i) vertices_[i] = all[kept_[i]];
    count_ = kept_count_;
    return nearest_;
  }

 private:
  void take(const std::array<std::size_t, 3>& which, std::size_t count,
            const std::array<double, 3>& weights) {
    Vertex sum{Vec3<double>::Zero(), Vec3<double>::Zero()};
    for (std::size_t i = 0; i < count; ++i) {
      sum.c += weights[i] * vertices_[which[i]].c;
      sum.a += weights[i] * vertices_[which[i]].a;
    }
    take(which, count, sum);
  }
  void take(const std::array<std::size_t, 3>& which, std::size_t count, const Vertex& point) {
    const double squared = point.c.squaredNorm();
    if (!(squared < least_)) return;
    least_ = squared;
    nearest_ = point;
    kept_ = which;
    kept_count_ = count;
  }
  void edge(std::size_t i, std::size_t j) {
    const Vec3<double> e = vertices_[j].c - vertices_[i].c;
    const double t = -vertices_[i].c.dot(e) / e.squaredNorm();
    if (!(t > 0 && t < 1)) return;
    const Vec3<double> along = vertices_[j].a - vertices_[i].a;
    take({i, j, 0}, 2, Vertex{vertices_[i].c + t * e, vertices_[i].a + t * along});
  }
  void triangle(std::size_t i, std::size_t j, std::size_t k) {
    const auto side = [&](std::size_t p, std::size_t q) {
      return (vertices_[p].c - vertices_[q].c).squaredNorm();
    };
    if (side(j, k) < std::min(side(i, j), side(i, k))) std::swap(i, j);
    const Vec3<double>&p = vertices_[i].c, &q = vertices_[j].c, &r = vertices_[k].c;
    const Vec3<double> n = (q - p).cross(r - p);
    const double squared = n.squaredNorm();
    if (!(squared > 0)) return;
    const Vec3<double> foot = (n.dot(p) / squared) * n;
    const Vec3<double> to_p = p - foot, to_q = q - foot, to_r = r - foot;
    const double of_p = n.dot(to_q.cross(to_r)), of_q = n.dot(to_r.cross(to_p)),
                 of_r = n.dot(to_p.cross(to_q));
    if (!(of_p > 0 && of_q > 0 && of_r > 0)) return;
    const double sum = of_p + of_q + of_r;
    const Vec3<double> a =
        (of_p * vertices_[i].a + of_q * vertices_[j].a + of_r * vertices_[k].a) / sum;
    take({i, j, k}, 3, Vertex{foot, a});
  }

  std::array<Vertex, 4> vertices_;
  std::size_t count_ = 0, kept_count_ = 0;
  std::array<std::size_t, 3> kept_ = {};
  double least_ = 0;
  Vertex nearest_;
};

/// Runs GJK from the given normal. Slim triangles determine the last digits of the normal.
void by_gjk(const CoresInWorld& cores, double slack, CoreContact& contact) {
  constexpr int most_turns = 60, most_stalls = 3;
  const double scale = cores.size() + cores.between.x.norm();
  SlimSimplex simplex;
  const CoreContact first = contact_along(cores, contact.normal);
  simplex.add({first.c, first.a});
  double highest = first.normal.dot(first.c) + slack;
  // No direction is better than the length of any c.
  if (contact.c.norm() <= highest) return;
  double nearest = std::numeric_limits<double>::infinity();
  int stalls = 0;
  Vertex v{first.c, first.a};
  for (int turn = 0; turn < most_turns; ++turn) {
    const double length = v.c.norm();
    if (!(length > 1e-10 * scale)) return;
    stalls = length < nearest ? 0 : stalls + 1;
    nearest = std::min(nearest, length);
    if (stalls > most_stalls) return;
    const Vec3<double> n = v.c / length;
    const CoreContact next = contact_along(cores, n);
    const double height = n.dot(next.c);
    if (height > highest) {
      highest = height;
      contact = {n, v.a, v.c};
    }
    if (length - height <= epsilon * scale / 4) return;
    for (std::size_t i = 0; i < simplex.count(); ++i)
      if (simplex[i].c == next.c) return;
    if (simplex.count() == 4) return;
    simplex.add({next.c, next.a});
    v = simplex.shrink();
  }
}

}  // namespace

Vec3<double> CoresInWorld::support_a(const Vec3<double>& n) const {
  return turn_a * support_of_core<CoreKind::other>(a, turn_a.transpose() * n).point;
}

Vec3<double> CoresInWorld::support_b(const Vec3<double>& n) const {
  return between.x + turn_b * support_of_core<CoreKind::other>(b, turn_b.transpose() * n).point;
}

bool sharpen_curved(const CoresInWorld& cores, CoreContact& contact) {
  return by_newton(cores, contact);
}

void sharpen(const CoresInWorld& cores, CoreContact& contact) {
  const bool is_known = cores.a.kind != CoreKind::other && cores.b.kind != CoreKind::other;
  const bool is_curved = !is_known || slides(cores.a.kind) || slides(cores.b.kind);
  if (is_curved && by_newton(cores, contact)) return;
  if (!(contact.normal.dot(contact.c) > 0)) return;
  // Solvers that know a core's kind are better than this, but where they fail.
  by_gjk(cores, is_known ? 8 * epsilon * (cores.size() + cores.between.x.norm()) : 0, contact);
}

}  // namespace minkray
