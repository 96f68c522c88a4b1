// SPDX-License-Identifier: MIT
#include "renderer/scene/calibrated_camera.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace minkray {
namespace {

using Vector2 = Eigen::Vector2d;

/// Largest distance of a distorted point from the wanted one, in units of the plane z = 1: 1e-6
/// pixels at any focal length below a million pixels.
constexpr double near_enough = 1e-12;
constexpr int most_steps = 100;

/// Radial distortion of a pinhole, and its derivative, as functions of s = r^2.
struct Radial {
  double factor, slope;  ///< slope: d factor / d s
  bool is_regular;       ///< the denominator is positive
};

Radial radial_at(const std::array<double, 6>& k, double s) {
  const double above = 1 + s * (k[0] + s * (k[1] + s * k[2]));
  const double below = 1 + s * (k[3] + s * (k[4] + s * k[5]));
  const double above_slope = k[0] + s * (2 * k[1] + s * 3 * k[2]);
  const double below_slope = k[3] + s * (2 * k[4] + s * 3 * k[5]);
  return {above / below, (above_slope * below - above * below_slope) / (below * below), below > 0};
}

/// True if a pinhole's distorted radius grows at r^2 = s.
bool grows(const std::array<double, 6>& k, double s) {
  const Radial radial = radial_at(k, s);
  return radial.is_regular && radial.factor + 2 * s * radial.slope > 0;
}

/// A fisheye's distorted angle and its derivative.
std::array<double, 2> fisheye_at(const std::array<double, 6>& k, double angle) {
  const double s = angle * angle;
  return {angle * (1 + s * (k[0] + s * (k[1] + s * (k[2] + s * k[3])))),
          1 + s * (3 * k[0] + s * (5 * k[1] + s * (7 * k[2] + s * 9 * k[3])))};
}

/// The end of the interval from 0 on which `holds` is true, at most `most`.
template <class Holds>
double end_of(const Holds& holds, double most) {
  constexpr int parts = 8192;
  for (int i = 1; i <= parts; ++i) {
    if (holds(most * i / parts)) continue;
    double inside = most * (i - 1) / parts, outside = most * i / parts;
    for (int step = 0; step < 60; ++step) {
      const double middle = (inside + outside) / 2;
      (holds(middle) ? inside : outside) = middle;
    }
    return inside;
  }
  return most;
}

}  // namespace

CalibratedCamera::CalibratedCamera(const Numbers& numbers) : numbers_(numbers) {
  if (numbers.model == Model::fisheye) {
    reach_ =
        end_of([&](double angle) { return fisheye_at(numbers.k, angle)[1] > 0; }, std::numbers::pi);
    return;
  }
  constexpr double widest = 1.5697963267948966;  // a milliradian below 90 degrees
  reach_ = std::tan(end_of(
      [&](double angle) { return grows(numbers.k, std::tan(angle) * std::tan(angle)); }, widest));
}

bool CalibratedCamera::is_plain() const {
  return numbers_.k == std::array<double, 6>() && numbers_.p1 == 0 && numbers_.p2 == 0;
}

Vector2 CalibratedCamera::distorted(const Vector2& at) const {
  const double x = at.x(), y = at.y(), s = at.squaredNorm();
  const double factor = radial_at(numbers_.k, s).factor, p1 = numbers_.p1, p2 = numbers_.p2;
  return {x * factor + 2 * p1 * x * y + p2 * (s + 2 * x * x),
          y * factor + p1 * (s + 2 * y * y) + 2 * p2 * x * y};
}

// Newton's method; a step that comes no nearer, or leaves the branch, is halved.
std::optional<Vector2> CalibratedCamera::undistorted(const Vector2& wanted) const {
  Vector2 at = wanted;
  if (at.norm() > 0.9 * reach_) at *= 0.9 * reach_ / at.norm();
  Vector2 error = distorted(at) - wanted;
  const double p1 = numbers_.p1, p2 = numbers_.p2;
  const double enough = near_enough * std::max(1.0, wanted.norm());
  for (int step = 0; step < most_steps && !(error.norm() <= 1e-16); ++step) {
    const double x = at.x(), y = at.y();
    const Radial radial = radial_at(numbers_.k, at.squaredNorm());
    const double across = 2 * x * y * radial.slope + 2 * p1 * x + 2 * p2 * y;
    Eigen::Matrix2d jacobian;
    jacobian << radial.factor + 2 * x * x * radial.slope + 2 * p1 * y + 6 * p2 * x, across, across,
        radial.factor + 2 * y * y * radial.slope + 6 * p1 * y + 2 * p2 * x;
    const double determinant = jacobian.determinant();
    if (!(determinant > 0)) return std::nullopt;
    const Vector2 move = Vector2(jacobian(1, 1) * error.x() - jacobian(0, 1) * error.y(),
                                 jacobian(0, 0) * error.y() - jacobian(1, 0) * error.x()) /
                         determinant;
    bool is_better = false;
    for (double part = 1; part > 1e-6 && !is_better; part /= 2) {
      const Vector2 next = at - part * move;
      if (!(next.norm() < reach_)) continue;
      const Vector2 next_error = distorted(next) - wanted;
      is_better = next_error.norm() < error.norm();
      if (is_better) at = next, error = next_error;
    }
    if (!is_better) break;
  }
  if (!(error.norm() <= enough)) return std::nullopt;
  return at;
}

// Newton's method within an interval that holds the solution, which is halved where a step leaves
// it.
std::optional<double> CalibratedCamera::angle_of(double distorted) const {
  double low = 0, high = reach_;
  if (distorted > fisheye_at(numbers_.k, high)[0]) return std::nullopt;
  double angle = std::min(distorted, high);
  for (int step = 0; step < most_steps; ++step) {
    const auto [value, slope] = fisheye_at(numbers_.k, angle);
    if (std::abs(value - distorted) <= 1e-16) return angle;
    (value < distorted ? low : high) = angle;
    double next = angle - (value - distorted) / slope;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (next == angle || high - low <= 4e-16) break;
    angle = next;
  }
  if (std::abs(fisheye_at(numbers_.k, angle)[0] - distorted) <= near_enough) return angle;
  return std::nullopt;
}

std::optional<Vec3<double>> CalibratedCamera::direction(double u, double v) const {
  const Vector2 wanted((u - numbers_.cx) / numbers_.fx, (v - numbers_.cy) / numbers_.fy);
  if (numbers_.model == Model::pinhole) {
    const auto at = is_plain() ? std::optional(wanted) : undistorted(wanted);
    if (!at || !at->allFinite()) return std::nullopt;
    return Vec3<double>(at->x(), at->y(), 1);
  }
  const double radius = wanted.norm();
  const auto angle = angle_of(radius);
  if (!angle) return std::nullopt;
  if (!(radius > 0)) return Vec3<double>(0, 0, 1);
  const double side = std::sin(*angle) / radius;
  return Vec3<double>(side * wanted.x(), side * wanted.y(), std::cos(*angle));
}

Vec3<double> CalibratedCamera::direction_or_last(double u, double v) const {
  if (const auto seen = direction(u, v)) return *seen;
  Vec3<double> last(0, 0, 1);
  double inside = 0, outside = 1;
  for (int step = 0; step < 30; ++step) {
    const double part = (inside + outside) / 2;
    const auto seen =
        direction(numbers_.cx + part * (u - numbers_.cx), numbers_.cy + part * (v - numbers_.cy));
    if (seen) last = *seen;
    (seen ? inside : outside) = part;
  }
  return last;
}

std::optional<Vector2> CalibratedCamera::project(const Vec3<double>& point) const {
  Vector2 at;
  const double across = std::hypot(point.x(), point.y());
  if (numbers_.model == Model::fisheye) {
    const double angle = std::atan2(across, point.z());
    if (!(angle <= reach_) || !(across > 0 || point.z() > 0)) return std::nullopt;
    at = across > 0 ? Vector2(fisheye_at(numbers_.k, angle)[0] / across * point.head<2>())
                    : Vector2::Zero();
  } else {
    if (!(point.z() > 0) || !(is_plain() || across / point.z() <= reach_)) return std::nullopt;
    at = distorted(point.head<2>() / point.z());
  }
  return Vector2(numbers_.fx * at.x() + numbers_.cx, numbers_.fy * at.y() + numbers_.cy);
}

}  // namespace minkray
