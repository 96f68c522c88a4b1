// SPDX-License-Identifier: MIT
#include "renderer/light/camera.h"

#include <numbers>

namespace minkray {
namespace {

/// The coordinate axis that v has least of.
Vec3<double> axis_across(const Vec3<double>& v) {
  int axis = 0;
  v.cwiseAbs().minCoeff(&axis);
  return Vec3<double>::Unit(axis);
}

}  // namespace

Camera::Camera(const CameraDescription& description, const Resolution& resolution)
    : position_(description.position), centre_(0.5 * resolution.width, 0.5 * resolution.height) {
  // Looking at where it stands, or up along where it looks: any choice will do, but a definite one.
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
}

std::optional<Eigen::Vector2d> Camera::project(const Vec3<double>& point) const {
  const Vec3<double> offset = point - position_;
  const double depth = offset.dot(forward_);
  if (!(depth > 0)) return std::nullopt;
  const double pixel_squared = right_.squaredNorm();
  const Eigen::Vector2d on_plane(offset.dot(right_), offset.dot(down_));
  return Eigen::Vector2d(centre_ + on_plane / (depth * pixel_squared));
}

}  // namespace minkray
