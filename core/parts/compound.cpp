// SPDX-License-Identifier: MIT
#include "core/parts/compound.h"

#include <stdexcept>

#include "core/parts/parts_body.h"

namespace minkray {

Compound::Compound(std::vector<Part> parts) : parts_(std::move(parts)) {
  if (parts_.empty()) throw std::invalid_argument("compound: must have a part");
  contacts_.reserve(size());
  definitions_.reserve(size());
  std::vector<Bounds<float>> boxes;
  for (const Part& part : parts_) {
    contacts_.emplace_back(part.shape, part.pose);
    definitions_.emplace_back(
        part.pose == Affine<double>() ? part.shape : Shape(Transform{part.shape, part.pose}));
    boxes_.push_back(bounds_of(PartsBody(contacts_.back()), {}));
    boxes.push_back(rounded_outwards(boxes_.back()));
    bounds_.extend(boxes_.back());
    reach_ = std::max(reach_, reach_of(PartsBody(contacts_.back())));
  }
  bvh_ = build_bvh(boxes);
}

std::shared_ptr<const Compound> Compound::mapped(const Affine<double>& map) const {
  std::vector<Part> parts = parts_;
  for (Part& part : parts) part.pose = map * part.pose;
  return std::make_shared<const Compound>(std::move(parts));
}

}  // namespace minkray
