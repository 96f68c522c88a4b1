// SPDX-License-Identifier: MIT
#include "renderer/library/handles/held_shape.h"

#include <algorithm>

#include "renderer/library/handles/call.h"

namespace minkray {

void wrong_shape(minkray_shape shape, const char* argument) {
  wrong_use(std::string(argument) + ": must be a shape (got " +
            (shape.id == 0 ? "none" : "a released one, or none") + ")");
}

HeldShape::HeldShape(std::shared_ptr<const Compound> compound)
    : compound_(std::move(compound)), shape_(Point()) {
  for (std::size_t i = 0; i < compound_->size(); ++i)
    for (auto& custom : customs_of(compound_->part(i).shape))
      if (std::ranges::find(customs_, custom) == customs_.end())
        customs_.push_back(std::move(custom));
}

void HeldShape::refuse() const {
  wrong_use(std::string("shape: must be convex (got a ") + (mesh_ ? "mesh)" : "compound)"));
}

}  // namespace minkray
