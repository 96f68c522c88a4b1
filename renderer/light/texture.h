// SPDX-License-Identifier: MIT
// The colour of a paint at a place.
#pragma once

#include "renderer/scene/textures.h"

namespace minkray {

/// A place on a surface, in the object's frame.
struct TexturePoint {
  Vec3<double> position = Vec3<double>::Zero();
  Vec3<double> normal = Vec3<double>::UnitZ();  ///< outward, of unit length
};

/// Longitude around z as a part of a turn, 0 and 1 being at -x and 0.5 at +x, and latitude from the
/// top down as a part of half a turn; the third number is 0.
Vec3<double> radial_place(const Vec3<double>& direction);

/// Which way pictures of a mapping have right, seen from outside; not along the surface.
Vec3<double> picture_right(const TexturePoint& at, const Mapping& mapping);

/// Pictures are interpolated between pixels, and repeat.
Colour paint_at(const Paint& paint, const TexturePoint& at);

/// Perlin's gradient noise ("Improving Noise", 2002), in about [-1, 1]; 0 at whole numbers.
double gradient_noise(const Vec3<double>& at);

/// The sum of six octaves of it, each half as strong as the one before, in about [-1, 1].
double fractal_noise(const Vec3<double>& at);

}  // namespace minkray
