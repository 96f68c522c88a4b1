// SPDX-License-Identifier: MIT
// Means of albedo, normal and depth over the rays of a picture's samples, without light, for
// denoising: without noise on surfaces, and mixed as the light is at edges and out of focus.
#pragma once

#include "renderer/film/render.h"
#include "renderer/image/denoise.h"

namespace minkray {

/// Prepares the rendering, which must have its variance, for `denoised`.
NoisyPicture noisy_picture(const Scene& scene, const World& world, const RenderOptions& options,
                           const Rendering& rendering, const RenderWatch& watch = {});

}  // namespace minkray
