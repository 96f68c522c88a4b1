// SPDX-License-Identifier: MIT
// Camera that frames everything, for files without one. A convex body lies in a half-space if its
// support value along the normal is at most the offset, so four support values per body give the
// camera's least distance in a direction.
#pragma once

#include "renderer/scene/scene.h"

namespace minkray {

/// Margin at each edge of the picture, as a fraction of its width or height.
inline constexpr double framing_margin = 0.04;

/// Points the scene's camera at its objects, from the front, the right and above, as near as shows
/// all of them within the margin, at every moment if they move. The picture's width and height
/// become the camera's. Half-spaces are not framed; if the camera would be in one, it looks down
/// more steeply, and then from other sides.
void frame_everything(Scene& scene, const Resolution& picture);

}  // namespace minkray
