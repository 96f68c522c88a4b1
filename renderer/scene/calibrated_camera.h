// SPDX-License-Identifier: MIT
// Cameras as calibration tools describe them, in OpenCV's terms: x right, y down, z ahead, and the
// middle of the first pixel at (0, 0). Distortion after Brown (1971) and OpenCV's rational model,
// or after Kannala and Brandt (2006) for fisheyes.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/math/vec.h"

namespace minkray {

class CalibratedCamera {
 public:
  enum class Model : unsigned char { pinhole, fisheye };
  struct Numbers {
    Model model = Model::pinhole;
    double fx = 1, fy = 1, cx = 0, cy = 0;
    int width = 1, height = 1;
    std::array<double, 6> k = {};  ///< k1 to k6; of fisheyes k1 to k4
    double p1 = 0, p2 = 0;
    double row_time = 0;  ///< seconds from a row's exposure to the next one's
  };

  CalibratedCamera() = default;
  explicit CalibratedCamera(const Numbers& numbers);

  const Numbers& numbers() const { return numbers_; }

  /// The pixel that shows a point; nothing if no ray of the camera passes it.
  std::optional<Eigen::Vector2d> project(const Vec3<double>& point) const;

  /// The direction that a pixel shows: of a pinhole with z = 1, of a fisheye of length 1. Nothing
  /// where the distortion has no inverse on the branch that begins at the middle.
  std::optional<Vec3<double>> direction(double u, double v) const;

  /// The direction of a pixel, or of the last one before it on the way from the middle.
  Vec3<double> direction_or_last(double u, double v) const;

  /// Largest distance from the axis with an inverse: a tangent; for fisheyes the angle.
  double reach() const { return reach_; }

 private:
  bool is_plain() const;  ///< a pinhole without distortion
  Eigen::Vector2d distorted(const Eigen::Vector2d& at) const;
  std::optional<Eigen::Vector2d> undistorted(const Eigen::Vector2d& wanted) const;
  std::optional<double> angle_of(double distorted) const;

  Numbers numbers_;
  double reach_ = 0;
};

/// Reads fx, fy, cx, cy, width and height, in pixels, and if wanted "model" ("pinhole" or
/// "fisheye"), k1 to k6 (k4), p1, p2 and row_time. Throws BadInput with all mistakes.
CalibratedCamera read_calibrated_camera(const std::string& file);
/// Does so with the text of such a file; `file` is what messages call it.
CalibratedCamera parse_calibrated_camera(const std::string& text, const std::string& file);

}  // namespace minkray
