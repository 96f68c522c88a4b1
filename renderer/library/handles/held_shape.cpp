// SPDX-License-Identifier: MIT
#include "renderer/library/handles/held_shape.h"

#include "renderer/library/handles/call.h"

namespace minkray {

void wrong_shape(minkray_shape shape, const char* argument) {
  wrong_use(std::string(argument) + ": must be a shape (got " +
            (shape.id == 0 ? "none" : "a released one, or none") + ")");
}

void HeldShape::refuse_mesh() {
  wrong_use("shape: must be convex (got a mesh)");
}

}  // namespace minkray
