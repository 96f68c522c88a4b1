// SPDX-License-Identifier: MIT
// Smooth solid noise for textures, the same on every machine.
#pragma once

#include "core/math/vec.h"

namespace minkray {

/// Perlin's gradient noise ("Improving Noise", 2002), in about [-1, 1]; 0 at whole numbers.
double gradient_noise(const Vec3<double>& at);

/// The part of it that comes nearest to its mean over a box of that width: 1 where that is far
/// smaller than the noise, 0 where it is larger (fading: Apodaca and Gritz, "Advanced RenderMan",
/// 1999).
double faded(double width);

/// The sum of six octaves of it, each half as strong as the one before, in about [-1, 1]; about its
/// mean over a box of that width.
double fractal_noise(const Vec3<double>& at, double width = 0);

/// Approximate width of its range within such a box.
double fractal_range(double width);

}  // namespace minkray
