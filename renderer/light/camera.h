// SPDX-License-Identifier: MIT
// The perspective camera: pixels to rays, and points of the world back to pixels.
#pragma once

#include <optional>

#include "core/math/ray.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Pixel coordinates are continuous: (0, 0) is the upper left corner of the image, (width, height)
/// the lower right one, pixel centres lie at halves. Pixels are square; fov_y spans the height.
class Camera {
 public:
  Camera(const CameraDescription& description, const Resolution& resolution);

  /// The ray of unit direction through a point of the image.
  Ray<double> ray(double x, double y) const {
    return {position_,
            unit<double>(forward_ + (x - centre_.x()) * right_ + (y - centre_.y()) * down_)};
  }

  /// Where a point is seen; nothing if it lies behind the camera.
  std::optional<Eigen::Vector2d> project(const Vec3<double>& point) const;

 private:
  Vec3<double> position_;
  Vec3<double> forward_;  ///< of unit length
  Vec3<double> right_;    ///< a step of one pixel on the plane at distance 1
  Vec3<double> down_;
  Eigen::Vector2d centre_;
};

}  // namespace minkray
