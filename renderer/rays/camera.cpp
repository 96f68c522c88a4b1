// SPDX-License-Identifier: MIT
#include "renderer/rays/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/scene/calibrated_camera.h"

namespace minkray {
namespace {

/// The coordinate axis that v has least of.
Vec3<double> axis_across(const Vec3<double>& v) {
  int axis = 0;
  v.cwiseAbs().minCoeff(&axis);
  return Vec3<double>::Unit(axis);
}

/// A place of the regular polygon whose corners lie on the unit circle, one of them upwards, drawn
/// evenly: one of its triangles around the middle, and a place of that.
Eigen::Vector2d between_blades(int blades, const std::array<double, 2>& u) {
  const double which = std::min(std::floor(u[0] * blades), blades - 1.0);
  const double from_middle = std::sqrt(u[0] * blades - which);
  const auto corner = [&](double i) {
    const double angle = 2 * std::numbers::pi * i / blades;
    return Eigen::Vector2d(std::sin(angle), -std::cos(angle));
  };
  return from_middle * ((1 - u[1]) * corner(which) + u[1] * corner(which + 1));
}

}  // namespace

Camera::Camera(const CameraDescription& description, const Resolution& resolution)
    : position_(description.position), centre_(0.5 * resolution.width, 0.5 * resolution.height) {
  // Looking at its own position, or up along its view direction: any choice will do, but a
  // definite one.
  forward_ = unit<double>(description.look_at - description.position);
  if (forward_.isZero(0)) forward_ = Vec3<double>::UnitY();
  const auto sideways = [&](const Vec3<double>& up) {
    return Vec3<double>(forward_.cross(unit(up)));
  };
  // Below a few ulps the cross product is rounding, and so would be the camera's roll.
  constexpr double parallel = 16 * std::numeric_limits<double>::epsilon();
  Vec3<double> right = sideways(description.up);
  if (!(right.norm() > parallel)) right = sideways(axis_across(forward_));
  right = unit(right);
  const Vec3<double> down = forward_.cross(right);

  const double half_height = std::tan(description.fov_y_degrees * std::numbers::pi / 360);
  const double pixel = 2 * half_height / resolution.height;
  right_ = pixel * right;
  down_ = pixel * down;

  for (std::size_t i = 0; i < CameraTypes::names.size(); ++i)
    if (CameraTypes::names[i] == description.type.name) type_ = static_cast<Type>(i);
  if (description.calibration) {
    type_ = Type::calibrated;
    calibration_ = description.calibration;
    const CalibratedCamera::Numbers& numbers = calibration_->numbers();
    calibrated_pixels_ = {double(numbers.width) / resolution.width,
                          double(numbers.height) / resolution.height};
  }
  unit_right_ = right;
  unit_down_ = down;
  const double to_look_at = (description.look_at - description.position).norm();
  lens_radius_ = description.aperture / 2;
  blades_ = static_cast<int>(description.blades);
  focus_ = description.focus > 0 ? description.focus : to_look_at;
  const double field = description.fov_y_degrees * std::numbers::pi / 180;
  if (type_ == Type::orthographic) scale_ = pixel * to_look_at;
  if (type_ == Type::fisheye) scale_ = field / resolution.height;
  if (type_ == Type::equisolid) scale_ = 2 * std::sin(field / 4) / resolution.height;
}

// Fisheyes: the angle to the axis is proportional to the distance from the middle (equidistant), or
// twice its sine of half is (equisolid angle). Beyond all directions the last one is seen.
Ray<double> Camera::other_ray(double x, double y) const {
  if (type_ == Type::calibrated) return calibrated_ray(x, y);
  constexpr double pi = std::numbers::pi;
  const double right = x - centre_.x(), down = y - centre_.y();
  if (type_ == Type::orthographic)
    return {position_ + scale_ * (right * unit_right_ + down * unit_down_), forward_};
  if (type_ == Type::panorama) {
    const double longitude = pi * right / centre_.x(), latitude = pi / 2 * down / centre_.y();
    const Vec3<double> level = std::cos(longitude) * forward_ + std::sin(longitude) * unit_right_;
    return {position_, unit<double>(std::cos(latitude) * level + std::sin(latitude) * unit_down_)};
  }
  const double distance = std::hypot(right, down);
  if (!(distance > 0)) return {position_, forward_};
  const double angle = type_ == Type::fisheye ? std::min(scale_ * distance, pi)
                                              : 2 * std::asin(std::min(scale_ * distance, 1.0));
  const Vec3<double> outwards = (right * unit_right_ + down * unit_down_) / distance;
  return {position_, unit<double>(std::cos(angle) * forward_ + std::sin(angle) * outwards)};
}

Ray<double> Camera::calibrated_ray(double x, double y) const {
  // Calibrations count from the middle of the first pixel.
  const Vec3<double> seen = calibration_->direction_or_last(calibrated_pixels_.x() * x - 0.5,
                                                            calibrated_pixels_.y() * y - 0.5);
  return {position_,
          unit<double>(seen.x() * unit_right_ + seen.y() * unit_down_ + seen.z() * forward_)};
}

// Derived from the rays through the pixels on the right and below.
RayCone Camera::cone(double x, double y) const {
  const Ray<double> middle = ray(x, y), right = ray(x + 1, y), down = ray(x, y + 1);
  const auto side = [](const Vec3<double>& to_right, const Vec3<double>& to_below) {
    return std::sqrt(to_right.cross(to_below).norm());
  };
  return {side(right.origin - middle.origin, down.origin - middle.origin),
          side(right.direction - middle.direction, down.direction - middle.direction)};
}

Ray<double> Camera::through_lens(const Ray<double>& ray, const std::array<double, 2>& u) const {
  const double radius = lens_radius_ * std::sqrt(u[0]), angle = 2 * std::numbers::pi * u[1];
  Eigen::Vector2d on_lens(std::cos(angle), std::sin(angle));
  if (blades_ > 0) on_lens = between_blades(blades_, u);
  const Vec3<double> sharp = ray.at(focus_ / ray.direction.dot(forward_));
  const Vec3<double> origin =
      ray.origin + (blades_ > 0 ? lens_radius_ : radius) *
                       (on_lens.x() * unit_right_ + on_lens.y() * unit_down_);
  return {origin, unit<double>(sharp - origin)};
}

std::optional<Eigen::Vector2d> Camera::seen_at(const Vec3<double>& point) const {
  if (type_ == Type::perspective || type_ == Type::orthographic || type_ == Type::calibrated)
    return project(point);
  const Vec3<double> towards = unit<double>(point - position_);
  if (towards.isZero(0)) return std::nullopt;
  const double right = towards.dot(unit_right_), down = towards.dot(unit_down_);
  const double along = towards.dot(forward_);
  if (type_ == Type::panorama) {
    const double longitude = std::atan2(right, along),
                 latitude = std::asin(std::clamp(down, -1.0, 1.0));
    return Eigen::Vector2d(centre_.x() * (1 + longitude / std::numbers::pi),
                           centre_.y() * (1 + 2 * latitude / std::numbers::pi));
  }
  const double sine = std::hypot(right, down), angle = std::atan2(sine, along);
  if (!(sine > 0)) return along > 0 ? std::optional(centre_) : std::nullopt;
  const double distance = (type_ == Type::fisheye ? angle : std::sin(angle / 2)) / scale_;
  return Eigen::Vector2d(centre_ + distance / sine * Eigen::Vector2d(right, down));
}

std::optional<Eigen::Vector2d> Camera::project(const Vec3<double>& point) const {
  const Vec3<double> offset = point - position_;
  if (type_ == Type::orthographic)
    return Eigen::Vector2d(
        centre_ + Eigen::Vector2d(offset.dot(unit_right_), offset.dot(unit_down_)) / scale_);
  if (type_ == Type::calibrated) {
    const auto pixel = calibration_->project(
        {offset.dot(unit_right_), offset.dot(unit_down_), offset.dot(forward_)});
    if (!pixel) return std::nullopt;
    return Eigen::Vector2d((pixel->array() + 0.5) / calibrated_pixels_.array());
  }
  if (type_ != Type::perspective) return std::nullopt;
  const double depth = offset.dot(forward_);
  if (!(depth > 0)) return std::nullopt;
  const double pixel_squared = right_.squaredNorm();
  const Eigen::Vector2d on_plane(offset.dot(right_), offset.dot(down_));
  return Eigen::Vector2d(centre_ + on_plane / (depth * pixel_squared));
}

}  // namespace minkray
