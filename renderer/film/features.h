// SPDX-License-Identifier: MIT
// Means of albedo, normal and depth over the rays of a picture's samples, without light, for
// denoising. They have no noise on surfaces, and are mixed as the light is at edges and out of
// focus.
#pragma once

#include "renderer/film/render.h"
#include "renderer/image/denoise.h"

namespace minkray {

/// The rendering, which must have its variance, made ready for `denoised`.
NoisyPicture noisy_picture(const Scene& scene, const World& world, const RenderOptions& options,
                           const Rendering& rendering, const RenderWatch& watch = {});

}  // namespace minkray
