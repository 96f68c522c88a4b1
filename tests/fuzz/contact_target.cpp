// SPDX-License-Identifier: MIT
// Two shapes made of the bytes, at rigid poses: what their signed distance promises.
#include <sstream>

#include "core/pair/searchable.h"
#include "core/pair_distance/signed_distance.h"
#include "core/query/tolerances.h"
#include "renderer/member_json/shape_json.h"
#include "tests/fuzz/shape_from_bytes.h"
#include "tests/fuzz/target.h"

namespace minkray::fuzz {
namespace {

using Long = long double;

/// A shape at a rigid pose.
struct Body {
  Shape shape;
  Affine<double> pose;
  ContactShape ready;

  /// Support function along n, relative to a point, by its own support mapping.
  Long support_function(const Vec3<double>& n, const Vec3<double>& from) const {
    const Vec3<double> s = shape.support(Vec3<double>(pose.linear.transpose() * n));
    return n.cast<Long>().dot(pose.linear.cast<Long>() * s.cast<Long>() +
                              pose.translation.cast<Long>() - from.cast<Long>()) /
           n.cast<Long>().norm();
  }
};

Affine<double> rigid_from(Bytes& bytes) {
  const auto part = [&] { return bytes.below(4) == 0 ? 0.0 : 2 * bytes.fraction() - 1; };
  const double x = part(), y = part(), z = part(), w = part();
  const bool is_small = x * x + y * y + z * z + w * w < 0.01;
  return {is_small ? Mat3<double>(Mat3<double>::Identity()) : rotation_matrix(x, y, z, w),
          bytes.point<double>(false)};
}

std::string as_text(const Body& body) {
  std::ostringstream text;
  text.precision(17);
  text << write_shape(body.shape).dump() << "\nat\n"
       << body.pose.linear << "\n+ " << body.pose.translation.transpose();
  return text.str();
}

class Referee {
 public:
  Referee(const Body& a, const Body& b) : a_(a), b_(b) {
    const Vec3<double> between = b.pose.translation - a.pose.translation;
    const Vec3<double> middles = b.pose(b.ready.middle()) - a.pose(a.ready.middle());
    size_ = a.ready.ball_radius() + b.ready.ball_radius();
    rounding_ = 64 * tolerance::epsilon<double> *
                (size_ + a.ready.middle().norm() + b.ready.middle().norm() + between.norm());
    is_known_ = are_searchable(size_, middles.norm());
  }

  double size() const { return size_; }

  std::string judge(const SignedDistance& found) const {
    if (!(found.lower <= found.value && found.value <= found.upper)) return "value out of bounds";
    if (!std::isfinite(found.lower) || !std::isfinite(found.upper))
      return is_known_ ? "no bounds" : "";
    if (!(std::abs(found.normal.norm() - 1) <= 1e-14)) return "a normal not of unit length";
    if (!(found.lower <= gap(found.normal) + rounding_)) return "a plane nearer than lower";
    // Around the normal, and anywhere.
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const Vec3<double> d(i, j, k);
          if (i == 0 && j == 0 && k == 0) continue;
          for (const double step : {1e-9, 1e-6, 1e-3, 0.1, 1e3})
            if (!(found.upper >= gap(found.normal + step * d) - rounding_))
              return "a plane better than upper";
        }
    const Vec3<double> apart = found.point_b - found.point_a - found.value * found.normal;
    // Between planes `lower` apart, points `upper` apart are no further aside than this.
    const double width = found.upper - found.lower;
    const double aside = std::sqrt(2 * std::abs(found.value) * (width + rounding_));
    if (!(apart.norm() <= 1e-5 * size_ + rounding_ + far() + aside))
      return "points not value along the normal apart";
    return "";
  }

 private:
  Long gap(const Vec3<double>& n) const {
    const Vec3<double> from = a_.pose.translation;
    return -b_.support_function(-n, from) - a_.support_function(n, from);
  }
  double far() const { return 4 * tolerance::epsilon<double> * a_.pose.translation.norm(); }

  const Body &a_, &b_;
  double size_, rounding_;
  bool is_known_;  ///< others may be unknown
};

}  // namespace

std::string check_contact(std::string_view input) {
  Bytes bytes(input);
  const auto body = [&] {
    const Affine<double> pose = rigid_from(bytes);
    const Shape shape = shape_from(bytes, false, 2);
    return Body{shape, pose, ContactShape(shape)};
  };
  const Body a = body();
  Body b = body();
  const Referee referee(a, b);
  if (!std::isfinite(referee.size())) return "";
  const auto wrong = [&](const std::string& what) {
    return what + "\n" + as_text(a) + "\nand\n" + as_text(b);
  };
  const SignedDistance found = signed_distance(a.ready, a.pose, b.ready, b.pose);
  if (const std::string bad = referee.judge(found); !bad.empty()) return wrong(bad);
  // Nearly touching is hardest.
  if (bytes.below(2) == 1) {
    const double left = std::ldexp(bytes.fraction() - 0.5, -bytes.below(50)) * referee.size();
    b.pose.translation -= (found.value - left) * found.normal;
    const Referee nearer(a, b);
    const SignedDistance again = signed_distance(a.ready, a.pose, b.ready, b.pose);
    if (const std::string bad = nearer.judge(again); !bad.empty()) return wrong("near: " + bad);
  }
  const SignedDistance turned = signed_distance(b.ready, b.pose, a.ready, a.pose);
  const SignedDistance straight = signed_distance(a.ready, a.pose, b.ready, b.pose);
  if (!(turned.lower <= straight.upper && straight.lower <= turned.upper))
    return wrong("another distance the other way round");
  return "";
}

}  // namespace minkray::fuzz
