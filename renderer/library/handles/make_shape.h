// SPDX-License-Identifier: MIT
// Makes shapes from named parameters via their described fields. Names no kind of shape.
#pragma once

#include <span>
#include <string_view>

#include "core/shape/shape.h"
#include "renderer/library/handles/c_header.h"

namespace minkray {

/// Throws CallError with all mistakes: an unknown kind or parameter, one that is missing or cannot
/// be.
Shape make_shape(std::string_view kind, std::span<const minkray_parameter> parameters);

}  // namespace minkray
