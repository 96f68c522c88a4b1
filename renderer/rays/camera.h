// SPDX-License-Identifier: MIT
// Cameras: pixels to rays, and points in world space to pixels.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "core/math/ray.h"
#include "renderer/rays/ray_cone.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Pixel coordinates are continuous: (0, 0) is the upper left corner of the image, (width, height)
/// the lower right one, pixel centres lie at halves. Pixels are square; fov_y spans the height.
class Camera {
 public:
  Camera(const CameraDescription& description, const Resolution& resolution);

  /// The ray of unit direction through a point of the image, and the middle of the lens.
  Ray<double> ray(double x, double y) const {
    if (type_ == Type::perspective)
      return {position_,
              unit<double>(forward_ + (x - centre_.x()) * right_ + (y - centre_.y()) * down_)};
    return other_ray(x, y);
  }

  /// The cone of a pixel around that ray: as large as the pixel, seen from the middle of the lens.
  RayCone cone(double x, double y) const;

  /// True if the lens has a size, so rays differ by their place on it.
  bool has_lens() const { return lens_radius_ > 0; }
  /// The ray to where a ray through the lens's middle is in focus, through a place of the lens
  /// drawn by two numbers.
  Ray<double> through_lens(const Ray<double>& ray, const std::array<double, 2>& u) const;

  /// Pixel position of a point; nothing if it lies behind the camera, or for cameras that are
  /// neither perspective, orthographic nor calibrated.
  std::optional<Eigen::Vector2d> project(const Vec3<double>& point) const;

  /// Pixel position of a point, for a camera of any type; nothing if it is not visible. Around a
  /// panorama's back edge it is seen on either side.
  std::optional<Eigen::Vector2d> seen_at(const Vec3<double>& point) const;

 private:
  enum class Type : unsigned char {
    perspective,
    orthographic,
    fisheye,
    equisolid,
    panorama,
    calibrated
  };

  Ray<double> other_ray(double x, double y) const;
  Ray<double> calibrated_ray(double x, double y) const;

  Type type_ = Type::perspective;
  double lens_radius_ = 0, focus_ = 1;
  int blades_ = 0;    ///< of the aperture; 0: it is round
  double scale_ = 1;  ///< a pixel: orthographic, in lengths; fisheyes, in radians
  Vec3<double> unit_right_, unit_down_;
  Vec3<double> position_;
  Vec3<double> forward_;  ///< of unit length
  Vec3<double> right_;    ///< a step of one pixel on the plane at distance 1
  Vec3<double> down_;
  Eigen::Vector2d centre_;
  std::shared_ptr<const CalibratedCamera> calibration_;
  Eigen::Vector2d calibrated_pixels_;  ///< pixels of the calibration per pixel
};

}  // namespace minkray
