// SPDX-License-Identifier: MIT
// The objects' names, each under the picture of its object.
#pragma once

#include "renderer/image.h"
#include "renderer/render.h"

namespace minkray {

/// Draws the names onto `image`, the part of the picture that `options` ask for. Names of objects
/// that are behind the camera, outside the picture, or have none are left out.
void draw_labels(Image& image, const Scene& scene, const RenderWorld& world,
                 const RenderOptions& options);

}  // namespace minkray
