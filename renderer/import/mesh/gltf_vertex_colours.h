// SPDX-License-Identifier: MIT
// Colours of vertices as a picture: each triangle has a square of 2x2 pixels, between whose middles
// the picture's interpolation is the triangle's own.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/files/mesh_attributes.h"
#include "renderer/image/image.h"

namespace minkray {

/// Linear colours by the numbers that the triangles have. Squares follow a Z-order curve, so
/// smaller versions of the picture mix triangles whose numbers are close.
std::shared_ptr<const Image> picture_of_colours(std::span<const Vec3<float>> colours,
                                                std::span<const MeshAttributes::Numbers> triangles);

/// Adds the coordinates of `triangles` triangles in that picture.
void add_colour_coordinates(std::size_t triangles, MeshAttributes& attributes);

}  // namespace minkray
