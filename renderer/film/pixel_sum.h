// SPDX-License-Identifier: MIT
// Sum of a pixel's samples in their order: the same additions for any batch size and any number of
// intermediate reads.
#pragma once

#include <cmath>

#include "renderer/film/share.h"
#include "renderer/rays/traced_ray.h"

namespace minkray {

/// Light that is summed in blocks of samples (SampleBlocks).
class LightSum {
 public:
  void add(const Colour& light) { block_ += light; }
  /// The sum of the block, which is added to the total.
  Vec3<float> end_block() {
    const Vec3<float> sum(block_.cast<float>());
    block_.setZero();
    total_.add(sum);
    return sum;
  }
  /// With what is there of the last block.
  Vec3<float> mean(int samples) const {
    LightSum whole = *this;
    if (!block_.isZero(0)) whole.end_block();
    return whole.total_.mean(samples);
  }

 private:
  Colour block_ = Colour::Zero();
  BlockTotal total_;
};

/// The spread of numbers, as they come in (Welford, "Note on a Method for Calculating Corrected
/// Sums of Squares and Products", 1962).
template <class T>
struct Spread {
  T mean, deviations;

  void add(const T& value, int count) {
    const T off = value - mean;
    mean += off / count;
    deviations += off * (value - mean);
  }
};

/// Darker values count as noisy as this one: a part of white.
inline constexpr double least_brightness = 0.02;

struct PixelSum {
  LightSum light, direct;
  std::uint32_t met = 0;
  int samples = 0;
  bool is_done = false;  ///< quiet enough to take no more samples
  Spread<double> brightness = {0, 0};
  Spread<Eigen::Array3d> colour = {Eigen::Array3d::Zero(), Eigen::Array3d::Zero()};

  void add(const TracedRay& ray, bool with_channels) {
    light.add(ray.radiance);
    met += ray.met ? 1 : 0;
    ++samples;
    brightness.add(ray.radiance.mean(), samples);
    if (!with_channels) return;
    direct.add(ray.direct);
    colour.add(ray.radiance.array(), samples);
  }
  /// The standard error of its mean brightness, by the spread of its samples; 0 for a single one.
  double standard_error() const {
    const double n = samples;
    return samples < 2 ? 0 : std::sqrt(brightness.deviations / (n * (n - 1)));
  }
  /// Reference for the relative standard error.
  double least_mean() const { return std::max(brightness.mean, least_brightness); }
  /// True if the standard error of the mean is small enough.
  bool is_quiet(double noise) const { return standard_error() <= noise * least_mean(); }
  /// The squared standard error of its colour, by the spread of its samples; 0 of a single one.
  Vec3<float> variance() const {
    const double n = samples;
    if (samples < 2) return Vec3<float>::Zero();
    return (colour.deviations / (n * (n - 1))).matrix().cast<float>();
  }
};

}  // namespace minkray
