// SPDX-License-Identifier: MIT
// Shapes from named parameters, by their described fields. No kind of shape is named here.
#pragma once

#include <span>
#include <string_view>

#include "core/shape/shape.h"
#include "renderer/library/c_header.h"

namespace minkray {

/// Throws CallError with all mistakes: an unknown kind or parameter, one that is missing or cannot
/// be.
Shape<double> make_shape(std::string_view kind, std::span<const minkray_parameter> parameters);

}  // namespace minkray
