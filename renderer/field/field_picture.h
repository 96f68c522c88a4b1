// SPDX-License-Identifier: MIT
// Draws a distance field: colours by distance, blue where the probe overlaps an object, lines of
// equal distance, a white line at contact, grey where unknown, and a scale below.
#pragma once

#include "renderer/field/distance_field.h"
#include "renderer/image/image.h"

namespace minkray {

/// `title` is written above the scale.
Image field_picture(const DistanceField& field, const std::string& title);

/// value, lower and upper in the three channels, for formats that keep floats.
Image field_numbers(const DistanceField& field);

}  // namespace minkray
