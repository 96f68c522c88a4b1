// SPDX-License-Identifier: MIT
#include "core/pair_motion/swept_boxes.h"

#include <algorithm>

namespace minkray {
namespace {

/// Indices of the axes that define a slab: i of A's face (j < 0), j of B's face (i < 0), or one
/// edge of each.
struct Slab {
  int i, j;
};

class BoxSweep {
 public:
  BoxSweep(const CorePair& pair, const Vec3<double>& velocity, double t_max, double near)
      : pair_(pair), velocity_(velocity), t_max_(t_max), near_(near) {
    speed_ = velocity.norm();
    rounding_ = pair.rounding();
  }

  SweptTime run() {
    if (!(speed_ > 0)) return result_;
    const Vec3<double>&a = pair_.a.size, &b = pair_.b.size, &x = pair_.x;
    const Mat3<double>& R = pair_.turn;
    const Mat3<double> Q = R.cwiseAbs();
    for (int i = 0; i < 3; ++i)
      if (!pass(x[i], velocity_[i], a[i] + Q.row(i).dot(b), 1, i, -1)) return result_;
    for (int j = 0; j < 3; ++j)
      if (!pass(R.col(j).dot(x), R.col(j).dot(velocity_), b[j] + Q.col(j).dot(a), 1, -1, j))
        return result_;
    if (is_passed()) return miss();
    // Products use the axis itself, so that nearly parallel edges lose no digits.
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        const double n1 = -R(i2, j), n2 = R(i1, j), length = std::abs(n1) + std::abs(n2);
        if (!(length > 0)) continue;
        const double reach = a[i1] * std::abs(n1) + a[i2] * std::abs(n2) +
                             b[j1] * std::abs(R(i1, j1) * n1 + R(i2, j1) * n2) +
                             b[j2] * std::abs(R(i1, j2) * n1 + R(i2, j2) * n2);
        if (!pass(x[i1] * n1 + x[i2] * n2, velocity_[i1] * n1 + velocity_[i2] * n2, reach, length,
                  i, j))
          return result_;
      }
    if (is_passed()) return miss();
    return hit();
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// Clips the ray by a slab. At time t the ray is at s + t v, and the slab is from -reach to
  /// reach; these numbers are in units of `length`, the length of the slab's normal or slightly
  /// more. Returns true to continue. The slab that the ray enters last is known only at the end.
  bool pass(double s, double v, double reach, double length, int i, int j) {
    const double allowed = rounding_ * length, sign = std::copysign(1.0, v), speed = sign * v;
    slabs_[count_] = {i, j};
    sides_[count_] = -sign;
    if (speed == 0) {
      // The ray stays outside the slab, stays inside, or is too close to decide.
      if (std::abs(s) < reach - allowed) return true;
      if (std::abs(s) - reach > near_ * length + allowed) {
        sides_[count_] = s < 0 ? -1 : 1;
        result_.axis = normal_of(count_, 1);
        result_.status = SweptStatus::miss;
      }
      return false;
    }
    // Gap to the plane that the ray approaches; the gap decreases by speed * t.
    const double gap = -sign * s - reach, per_speed = 1 / speed;
    in_[count_] = (gap - allowed) * per_speed;
    out_[count_] = (gap + 2 * reach) * per_speed;
    last_in_ = std::max(last_in_, in_[count_]);
    first_out_ = std::min(first_out_, out_[count_]);
    surely_in_ = std::max(surely_in_, (gap + allowed) * per_speed);
    surely_out_ = std::min(surely_out_, (gap + 2 * reach - allowed) * per_speed);
    ++count_;
    return true;
  }

  bool is_passed() const { return last_in_ > first_out_ || last_in_ > t_max_ || first_out_ < 0; }
  int entered() const {
    int n = 0;
    while (n < count_ - 1 && in_[n] != last_in_) ++n;
    return n;
  }
  int left() const {
    int n = 0;
    while (n < count_ - 1 && out_[n] != first_out_) ++n;
    return n;
  }

  /// Returns the unit normal of slab n, from A to B.
  Vec3<double> normal_of(int n, double side) const {
    const auto [i, j] = slabs_[n];
    const Vec3<double> normal =
        j < 0 ? Vec3<double>(Vec3<double>::Unit(i))
              : (i < 0 ? Vec3<double>(pair_.turn.col(j))
                       : Vec3<double>(Vec3<double>::Unit(i).cross(pair_.turn.col(j))));
    return normal * (side * sides_[n] / normal.norm());
  }
  double gap_along(const Vec3<double>& n) const {
    return n.dot(nearest_along<CoreKind::box, CoreKind::box>(pair_, n).c) - rounding_;
  }

  /// Sets a plane that separates the boxes at all times: that of the slab entered last, that of the
  /// slab left first, or a plane between the two that is parallel to the motion.
  SweptTime miss() {
    if (count_ == 0) return result_;
    const Vec3<double> n_in = normal_of(entered(), 1), n_out = normal_of(left(), -1);
    double gap = 0;
    if (last_in_ > t_max_) {
      result_.axis = n_in;
      gap = gap_along(n_in) + t_max_ * n_in.dot(velocity_);
    } else if (first_out_ < 0) {
      result_.axis = n_out;
      gap = gap_along(n_out);
    } else {
      result_.axis = unit<double>(n_out / n_out.dot(velocity_) - n_in / n_in.dot(velocity_));
      gap = gap_along(result_.axis);
    }
    if (gap > near_ + rounding_) result_.status = SweptStatus::miss;
    return result_;
  }

  SweptTime hit() {
    if (count_ == 0) return result_;
    result_.t_lo = last_in_;
    result_.t_hi = surely_in_;
    result_.axis = normal_of(entered(), 1);
    const bool is_near = have_met(surely_in_ - last_in_, speed_, near_, rounding_,
                                  [&] { return -result_.axis.dot(velocity_); });
    if (surely_in_ <= surely_out_ && is_near && find_point()) result_.status = SweptStatus::hit;
    return result_;
  }

  /// Finds the point of A that touches B. Returns false if an edge or a face lies in the contact
  /// plane.
  bool find_point() {
    const Vec3<double>& n = result_.axis;
    const Vec3<double> x = pair_.x + result_.t_hi * velocity_;
    const auto corner = [](const Vec3<double>& half, const Vec3<double>& d) -> Vec3<double> {
      return {std::copysign(half.x(), d.x()), std::copysign(half.y(), d.y()),
              std::copysign(half.z(), d.z())};
    };
    const Vec3<double> of_a = corner(pair_.a.size, n),
                       of_b = x + pair_.turn * corner(pair_.b.size, pair_.to_b(-n));
    const auto [i, j] = slabs_[entered()];
    if (j < 0) {
      result_.a = of_b;
    } else if (i < 0) {
      result_.a = of_a;
    } else {
      const Vec3<double> e = Vec3<double>::Unit(i), f = pair_.turn.col(j);
      const Vec3<double> between = of_b - of_a;
      const double cosine = e.dot(f), squared = 1 - cosine * cosine;
      result_.a = of_a + ((between.dot(e) - between.dot(f) * cosine) / squared) * e;
    }
    constexpr double outside = 1e-12;
    const double most = outside * pair_.size();
    const Vec3<double> on_b = pair_.to_b(result_.a - x);
    return (result_.a.cwiseAbs() - pair_.a.size).maxCoeff() <= most &&
           (on_b.cwiseAbs() - pair_.b.size).maxCoeff() <= most;
  }

  const CorePair& pair_;
  const Vec3<double>& velocity_;
  double t_max_, near_, speed_, rounding_;
  int count_ = 0;
  Slab slabs_[15];
  double sides_[15], in_[15], out_[15];
  double last_in_ = -infinity, surely_in_ = -infinity, first_out_ = infinity,
         surely_out_ = infinity;
  SweptTime result_;
};

}  // namespace

SweptTime swept_boxes(const CorePair& pair, const Vec3<double>& velocity, double t_max,
                      double near) {
  return BoxSweep(pair, velocity, t_max, near).run();
}

}  // namespace minkray
