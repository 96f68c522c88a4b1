// SPDX-License-Identifier: MIT
// A camera that frames everything, where a file has none. A convex body lies in a half-space if its
// support value along the half-space's normal is at most the offset; so four support values of each
// body say how close the camera can go in a direction for the body to lie in its frustum.
#pragma once

#include "renderer/scene/scene.h"

namespace minkray {

/// What is left free at each edge of the picture, as a fraction of its width or height.
inline constexpr double framing_margin = 0.04;

/// Where a camera stands and looks.
struct View {
  Vec3<double> position, look_at;
};

/// The view of all objects and particles from the front, the right and above, as near as shows all
/// of them within the margin, at every moment if they move. Half-spaces are not framed; where the
/// camera would stand in one, it looks down more steeply, and then from other sides.
View view_of_everything(const Scene& scene, double fov_y_degrees, const Resolution& picture);

/// Gives the scene's camera that view. The picture's width and height become the camera's.
void frame_everything(Scene& scene, const Resolution& picture);

/// Frames a camera that its file does not place: keeps its lens and resolution.
void frame_with_own_lens(Scene& scene);

}  // namespace minkray
