// SPDX-License-Identifier: MIT
// A distance field as a picture: colours by distance, blue where the probe overlaps something, with
// lines of equal distance, a white one where it touches, and a scale below. Grey is where the
// distance is unknown.
#pragma once

#include "renderer/field/distance_field.h"
#include "renderer/image/image.h"

namespace minkray {

/// `title` is written above the scale.
Image field_picture(const DistanceField& field, const std::string& title);

/// value, lower and upper in the three channels, for formats that keep floats.
Image field_numbers(const DistanceField& field);

}  // namespace minkray
