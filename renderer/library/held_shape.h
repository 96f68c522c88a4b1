// SPDX-License-Identifier: MIT
// A shape as programs in other languages hold it.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "core/contact/contact_shape.h"
#include "core/model/shape_definition.h"
#include "renderer/library/custom_support.h"
#include "renderer/library/handles.h"

namespace minkray {

/// It never changes; what is prepared of it is made when it is first asked for.
class HeldShape {
 public:
  explicit HeldShape(Shape<double> shape)
      : shape_(std::move(shape)), customs_(customs_of(*shape_)) {}

  const Nested<double>& shape() const { return shape_; }
  const std::vector<std::shared_ptr<const CustomSupport>>& customs() const { return customs_; }

  /// For queries on pairs.
  const ContactShape& contact() const {
    std::call_once(has_contact_, [&] { contact_.emplace(*shape_); });
    return *contact_;
  }
  /// For rays.
  const std::shared_ptr<const ShapeDefinition<double>>& definition() const {
    std::call_once(has_definition_,
                   [&] { definition_ = std::make_shared<const ShapeDefinition<double>>(*shape_); });
    return definition_;
  }

 private:
  Nested<double> shape_;
  std::vector<std::shared_ptr<const CustomSupport>> customs_;
  mutable std::once_flag has_contact_, has_definition_;
  mutable std::optional<ContactShape> contact_;
  mutable std::shared_ptr<const ShapeDefinition<double>> definition_;
};

/// All that there are.
Handles<HeldShape>& held_shapes();

/// Throws CallError, which begins with the argument's name, if there is none of that number.
const HeldShape& shape_of(minkray_shape shape, const char* argument);

}  // namespace minkray
