// SPDX-License-Identifier: MIT
// One ray cast as a picture and as a table, one row per iteration.
#pragma once

#include <string>

#include "renderer/paper/trace.h"

namespace minkray {

/// A line for each iteration: which case of clipping, where, and what is left of the ray.
std::string trace_table(const CastTrace& trace);

/// The SVG file: the shape's shadow on the plane through the ray and the centre of its ball, the
/// ray, the support points, the clip points of their planes on the ray, and the bounds next to it.
std::string trace_svg(const CastTrace& trace, const PreparedShape& shape);

}  // namespace minkray
