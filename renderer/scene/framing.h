// SPDX-License-Identifier: MIT
// Places the camera so that everything is in view, if a file has no camera. A convex body lies in a
// half-space if its support value along the half-space's normal is at most the offset. So four
// support values per body give the shortest distance at which the body lies in the frustum.
#pragma once

#include "renderer/scene/scene.h"

namespace minkray {

/// Free margin at each edge of the picture, as a fraction of its width or height.
inline constexpr double framing_margin = 0.04;

/// Position of a camera and its target.
struct View {
  Vec3<double> position, look_at;
};

/// Returns the closest view of all objects and particles from the front, the right and above, with
/// the margin, for the whole motion. Half-spaces are not framed; if the camera would be inside one,
/// a steeper view is tried, then other sides.
View view_of_everything(const Scene& scene, double fov_y_degrees, const Resolution& picture);

/// Gives the scene's camera that view. The picture's width and height become the camera's.
void frame_everything(Scene& scene, const Resolution& picture);

/// Frames a camera that its file does not place: keeps its lens and resolution.
void frame_with_own_lens(Scene& scene);

}  // namespace minkray
