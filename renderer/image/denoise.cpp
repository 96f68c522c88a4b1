// SPDX-License-Identifier: MIT
#include "renderer/image/denoise.h"

#include <algorithm>
#include <cmath>

#include "core/parallel/parallel.h"

namespace minkray {
namespace {

/// Pixels up to so far away count, in rows and columns.
constexpr int reach = 8;

/// Pixels to each side in the squares in which light is compared.
constexpr int patch = 1;

/// Largest difference of light that counts as noise: a part of its standard deviation (the k of
/// non-local means).
constexpr float noise_scale = 0.5F;

/// Differences of features that count as one: of albedo, of unit normals, and of depth beyond its
/// slope, as a part of the depth.
constexpr float albedo_scale = 0.1F, normal_scale = 0.35F, depth_scale = 0.01F;

/// Light is divided by the albedo where that is more than this, so that textures are kept.
constexpr float least_albedo = 0.02F;

/// Below this a pixel's weight is not worth the comparison of its light.
constexpr float least_weight = 1e-3F;

/// Keeps what is relatively this uncertain from being a lone bright speck.
constexpr float speck_error = 0.3F;

bool is_matt(const Vec3<float>& albedo) {
  return albedo.minCoeff() > least_albedo;
}

float squared(float x) {
  return x * x;
}

/// The prepared picture: its light without the albedo.
class Prepared {
 public:
  explicit Prepared(const NoisyPicture& picture)
      : of_(picture),
        width_(picture.light.width),
        height_(picture.light.height),
        light_(picture.light),
        variance_(picture.variance),
        slope_(picture.depth.size()) {
    for (std::size_t i = 0; i < light_.pixels.size(); ++i) {
      const Vec3<float>& albedo = of_.albedo.pixels[i];
      if (!is_matt(albedo)) continue;
      light_.pixels[i] = light_.pixels[i].cwiseQuotient(albedo);
      variance_.pixels[i] = variance_.pixels[i].cwiseQuotient(albedo.cwiseProduct(albedo));
    }
    limit_specks();
    spread_variance();
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) slope_[index(x, y)] = slope_at(x, y);
  }

  Vec3<float> filtered(int x, int y) const {
    Vec3<float> sum = Vec3<float>::Zero();
    float weights = 0;
    for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height_ - 1); ++v)
      for (int u = std::max(x - reach, 0); u <= std::min(x + reach, width_ - 1); ++u) {
        const float alike = likeness(x, y, u, v);
        if (!(alike > least_weight)) continue;
        const float weight = std::min(alike, std::exp(-std::max(light_distance(x, y, u, v), 0.0F)));
        weights += weight;
        sum += weight * light_.at(u, v);
      }
    const Vec3<float>& albedo = of_.albedo.at(x, y);
    const Vec3<float> mean = weights > 0 ? Vec3<float>(sum / weights) : light_.at(x, y);
    return is_matt(albedo) ? Vec3<float>(mean.cwiseProduct(albedo)) : mean;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  bool holds(int x, int y) const { return x >= 0 && x < width_ && y >= 0 && y < height_; }

  /// Calls visit(x, y) for the pixels next to one.
  template <class Visit>
  void for_neighbours(int x, int y, const Visit& visit) const {
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u)
        if ((u != x || v != y) && holds(u, v)) visit(u, v);
  }

  /// Clamps a light that is brighter than all around it and very uncertain to the brightest of
  /// those.
  void limit_specks() {
    const Image before = light_;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const float brightness = before.at(x, y).mean();
        const float error = std::sqrt(variance_.at(x, y).mean());
        if (!(error > speck_error * brightness)) continue;
        float brightest = 0;
        for_neighbours(
            x, y, [&](int u, int v) { brightest = std::max(brightest, before.at(u, v).mean()); });
        if (!(brightness > brightest)) continue;
        const float part = brightest / brightness;
        light_.at(x, y) *= part;
        variance_.at(x, y) *= part * part;
      }
  }

  /// A few samples are a poor estimate of their variance: half of it is that of the pixels around.
  void spread_variance() {
    const Image before = variance_;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        Vec3<float> sum = Vec3<float>::Zero();
        float count = 0;
        for_neighbours(x, y, [&](int u, int v) {
          sum += before.at(u, v);
          ++count;
        });
        if (count > 0) variance_.at(x, y) = 0.5F * (before.at(x, y) + sum / count);
      }
  }

  /// Change of the depth from a pixel to the next one on the same surface: the least change to
  /// either side, along rows and columns.
  float slope_at(int x, int y) const {
    const float here = of_.depth[index(x, y)];
    const auto change = [&](int u, int v) {
      const float other = holds(u, v) ? of_.depth[index(u, v)] : here;
      return std::isfinite(other) && std::isfinite(here) && holds(u, v)
                 ? std::abs(other - here)
                 : std::numeric_limits<float>::infinity();
    };
    const float along = std::min(change(x - 1, y), change(x + 1, y));
    const float down = std::min(change(x, y - 1), change(x, y + 1));
    return (std::isfinite(along) ? along : 0) + (std::isfinite(down) ? down : 0);
  }

  /// Likelihood that two pixels show the same thing, from 0 to 1.
  float likeness(int x, int y, int u, int v) const {
    const float albedo =
        (of_.albedo.at(x, y) - of_.albedo.at(u, v)).squaredNorm() / squared(albedo_scale);
    const float normal =
        (of_.normal.at(x, y) - of_.normal.at(u, v)).squaredNorm() / squared(normal_scale);
    const float here = of_.depth[index(x, y)], there = of_.depth[index(u, v)];
    float depth = 0;
    if (std::isfinite(here) != std::isfinite(there)) return 0;
    if (std::isfinite(here)) {
      const auto steps = static_cast<float>(std::abs(u - x) + std::abs(v - y));
      const float allowed = depth_scale * std::abs(here) + 2 * steps * slope_[index(x, y)];
      depth = allowed > 0 ? squared((there - here) / allowed) : 0;
    }
    return std::exp(-std::max({albedo, normal, depth}));
  }

  /// Difference of the light around two pixels beyond noise.
  float light_distance(int x, int y, int u, int v) const {
    float sum = 0, count = 0;
    for (int dy = -patch; dy <= patch; ++dy)
      for (int dx = -patch; dx <= patch; ++dx) {
        if (!holds(x + dx, y + dy) || !holds(u + dx, v + dy)) continue;
        const Vec3<float>& a = light_.at(x + dx, y + dy);
        const Vec3<float>& b = light_.at(u + dx, v + dy);
        const Vec3<float>& of_a = variance_.at(x + dx, y + dy);
        const Vec3<float>& of_b = variance_.at(u + dx, v + dy);
        for (int channel = 0; channel < 3; ++channel) {
          const float expected = of_a[channel] + std::min(of_a[channel], of_b[channel]);
          constexpr float least = 1e-8F;
          sum += (squared(a[channel] - b[channel]) - expected) /
                 (least + squared(noise_scale) * (of_a[channel] + of_b[channel]));
          ++count;
        }
      }
    return sum / count;
  }

  const NoisyPicture& of_;
  int width_, height_;
  Image light_, variance_;
  std::vector<float> slope_;
};

}  // namespace

Image denoised(const NoisyPicture& picture) {
  const Prepared prepared(picture);
  Image result(picture.light.width, picture.light.height);
  parallel_for(static_cast<std::size_t>(result.height), 4, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < result.width; ++x) result.at(x, y) = prepared.filtered(x, y);
  });
  return result;
}

}  // namespace minkray
