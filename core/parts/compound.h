// SPDX-License-Identifier: MIT
// A body of convex parts at fixed poses, such as a table: solid, and not convex. All objects of one
// compound share its parts and the BVH over them.
#pragma once

#include <memory>
#include <vector>

#include "core/bvh/bvh.h"
#include "core/model/shape_definition.h"
#include "core/pair/contact_shape.h"

namespace minkray {

class Compound {
 public:
  /// A convex shape and its pose in the body's frame, which may be any invertible map.
  struct Part {
    Shape shape;
    Affine<double> pose;
  };

  /// Throws std::invalid_argument if there are no parts.
  explicit Compound(std::vector<Part> parts);

  std::size_t size() const { return parts_.size(); }
  const Part& part(std::size_t i) const { return parts_[i]; }
  /// The part in the body's frame, prepared for pairs.
  const ContactShape& contact(std::size_t i) const { return contacts_[i]; }
  /// The part in the body's frame, prepared for rays.
  const ShapeDefinition& definition(std::size_t i) const { return definitions_[i]; }

  /// Tight boxes in the body's frame, up to rounding.
  const Bounds<double>& bounds_of_part(std::size_t i) const { return boxes_[i]; }
  const Bounds<double>& bounds() const { return bounds_; }
  /// Upper bound of the distance of the body's points from the origin of its frame.
  double reach() const { return reach_; }
  const Bvh& bvh() const { return bvh_; }

  /// Applies an invertible map to all parts.
  std::shared_ptr<const Compound> mapped(const Affine<double>& map) const;

 private:
  std::vector<Part> parts_;
  std::vector<ContactShape> contacts_;
  std::vector<ShapeDefinition> definitions_;
  std::vector<Bounds<double>> boxes_;
  Bounds<double> bounds_;
  double reach_ = 0;
  Bvh bvh_;
};

}  // namespace minkray
