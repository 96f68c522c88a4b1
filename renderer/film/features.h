// SPDX-License-Identifier: MIT
// What a picture shows, without its light: the means of albedo, normal and depth over the very rays
// that its samples begin with. On surfaces they have no noise, and at edges and beyond a lens's
// focus they are mixed as the light is.
#pragma once

#include "renderer/film/render.h"
#include "renderer/image/denoise.h"

namespace minkray {

/// The rendering, which must have its variance, made ready for `denoised`.
NoisyPicture noisy_picture(const Scene& scene, const World& world, const RenderOptions& options,
                           const Rendering& rendering, const RenderWatch& watch = {});

}  // namespace minkray
