// SPDX-License-Identifier: MIT
// Makes a shape of a part of a body: a triangle of a mesh, a part of a compound, or the shape
// itself.
#pragma once

#include <optional>

#include "core/pair/triangle_part.h"
#include "core/parts/parts_body.h"

namespace minkray {

/// Refers to the body, which must outlive the part.
class OnePart {
 public:
  OnePart(const PartsBody& body, std::uint32_t part)
      : shape_(body.compound() ? &body.compound()->contact(part) : body.shape()),
        number_(body.shape() ? no_part : part) {
    if (const TriangleMesh* mesh = body.mesh())
      triangle_.emplace(mesh->corner(part, 0), mesh->corner(part, 1), mesh->corner(part, 2));
  }

  const ContactShape& shape() const { return triangle_ ? triangle_->shape() : *shape_; }
  /// Number of the part; no_part for a shape.
  std::uint32_t number() const { return number_; }

 private:
  const ContactShape* shape_;
  std::optional<TrianglePart> triangle_;
  std::uint32_t number_;
};

}  // namespace minkray
