// SPDX-License-Identifier: MIT
// The precision that the renderer casts its rays in: here and nowhere else.
#pragma once

#include "core/world/world.h"

namespace minkray {

using Real = double;
using RenderWorld = World<Real>;

}  // namespace minkray
